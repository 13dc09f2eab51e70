#pragma once

#include <functional>
#include <string>

#include "analysis/data/study_data.h"

namespace jnd::analysis {

/// How thresholds of yes-no, same-different and adaptive blocks come about, as far as a study
/// has them, for its methods: `add` takes a topic with its text, `cite` a work that then stands
/// in the list of references.
void add_threshold_methods(
    const StudyData& data, const std::function<std::string(const std::string&)>& cite,
    const std::function<void(const std::string&, const std::string&)>& add);

}  // namespace jnd::analysis
