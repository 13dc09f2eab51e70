#pragma once

#include <functional>
#include <string>
#include <vector>

#include "analysis/results/study_results.h"

namespace jnd::analysis {

/// How the tests that a study has, and their effect sizes, come about, for its methods:
/// `comparisons` are those with a result, `compares` says whether a block asked for
/// comparisons, `add` takes a topic with its text, `cite` a work that then stands in the list
/// of references.
void add_test_methods(const std::vector<const NamedComparison*>& comparisons, bool compares,
                      const std::function<std::string(const std::string&)>& cite,
                      const std::function<void(const std::string&, const std::string&)>& add);

}  // namespace jnd::analysis
