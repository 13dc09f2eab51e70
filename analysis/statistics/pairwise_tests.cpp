#include "analysis/statistics/pairwise_tests.h"

#include <cstddef>

#include "analysis/statistics/multiplicity.h"

namespace jnd::analysis {
namespace {

/// What every person did under one condition, in the order of the people.
std::vector<double> condition_values(const RepeatedMeasures& data, std::size_t condition) {
  std::vector<double> values;
  values.reserve(data.values.size());
  for (const std::vector<double>& person : data.values) values.push_back(person[condition]);
  return values;
}

}  // namespace

std::vector<PairwiseTest> pairwise_tests(const RepeatedMeasures& data, PairwiseMethod method) {
  std::vector<PairwiseTest> tests;
  std::vector<std::optional<double>> p_values;
  for (std::size_t i = 0; i < data.conditions.size(); ++i) {
    const std::vector<double> a = condition_values(data, i);
    for (std::size_t j = i + 1; j < data.conditions.size(); ++j) {
      const std::vector<double> b = condition_values(data, j);
      tests.push_back({.a = data.conditions[i],
                       .b = data.conditions[j],
                       .comparison = method == PairwiseMethod::kPairedT ? paired_t_test(a, b)
                                                                        : wilcoxon_test(a, b),
                       .p_value_holm = {}});
      p_values.push_back(tests.back().comparison.p_value);
    }
  }
  const std::vector<std::optional<double>> adjusted = holm_adjusted(p_values);
  for (std::size_t i = 0; i < tests.size(); ++i) tests[i].p_value_holm = adjusted[i];
  return tests;
}

}  // namespace jnd::analysis
