#pragma once

#include <functional>
#include <string>

#include "analysis/data/study_data.h"

namespace jnd::analysis {

/// Adds to the methods how thresholds of yes-no, same-different and adaptive blocks are
/// computed, as far as a study has them. `add` takes a topic and its text. `cite` takes a work
/// and adds it to the list of references.
void add_threshold_methods(
    const StudyData& data, const std::function<std::string(const std::string&)>& cite,
    const std::function<void(const std::string&, const std::string&)>& add);

}  // namespace jnd::analysis
