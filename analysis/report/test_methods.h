#pragma once

#include <functional>
#include <string>
#include <vector>

#include "analysis/results/study_results.h"

namespace jnd::analysis {

/// Adds to the methods how the tests of a study and their effect sizes are computed.
/// `comparisons` holds the tests with a result. `compares` says whether a block asked for
/// comparisons. `add` takes a topic and its text. `cite` takes a work and adds it to the list
/// of references.
void add_test_methods(const std::vector<const NamedComparison*>& comparisons, bool compares,
                      const std::function<std::string(const std::string&)>& cite,
                      const std::function<void(const std::string&, const std::string&)>& add);

}  // namespace jnd::analysis
