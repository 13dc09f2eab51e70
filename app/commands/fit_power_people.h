#pragma once

#include <string>
#include <vector>

#include "analysis/fits/power_fit.h"
#include "app/commands/fit_tables.h"

namespace jnd::app {

/// "left out line 4: ...", or all lines with one reason at once. `lines`: of each row.
void print_excluded(const std::vector<analysis::PowerFit::Excluded>& excluded,
                    const std::vector<int>& lines);

/// `jnd fit power --participant COLUMN`: the power law of a group of people, and everybody's.
int fit_power_people(const TableOptions& options, const std::string& participant);

}  // namespace jnd::app
