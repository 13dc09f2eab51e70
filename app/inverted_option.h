#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "analysis/study_data.h"

namespace jnd::app {

/// Adds `--inverted in|out`: what becomes of people who answer the wrong way round.
void add_inverted_option(CLI::App& command, std::string& given);

/// Carries it out: with "out" their trials are set aside before anything is computed.
void apply_inverted_option(const std::string& given, analysis::StudyData& data);

}  // namespace jnd::app
