#pragma once

#include <string>
#include <vector>

#include "analysis/fits/power_fit.h"
#include "app/commands/fit_tables.h"

namespace jnd::app {

/// Prints "left out line 4: ...", with all lines of the same reason together. `lines` are the
/// lines of the rows.
void print_excluded(const std::vector<analysis::PowerFit::Excluded>& excluded,
                    const std::vector<int>& lines);

/// Runs `jnd fit power --participant COLUMN`: the power law of a group of people, and of
/// everybody in it.
int fit_power_people(const TableOptions& options, const std::string& participant);

}  // namespace jnd::app
