#include "analysis/statistics/sequential_test.h"

#include <algorithm>
#include <cmath>

#include "core/require.h"

namespace jnd::analysis {

SequentialBoundaries boundaries_of(const SequentialRule& rule) {
  const bool two_sided = rule.tail == Tail::kTwoSided;
  SequentialBoundaries found{
      .rule = rule, .z = spending_boundaries(rule.looks, rule.spending, rule.alpha, two_sided)};
  for (const double z : found.z) {
    const double above = 0.5 * std::erfc(z / std::sqrt(2.0));
    found.nominal_level.push_back(two_sided ? 2.0 * above : above);
  }
  return found;
}

bool crosses(const SequentialBoundaries& boundaries, std::size_t look,
             const std::optional<EffectEstimate>& estimate) {
  return estimate &&
         p_value_of(*estimate, boundaries.rule.tail) < boundaries.nominal_level.at(look);
}

std::optional<EffectEstimate> estimate_of_first(
    const std::vector<std::optional<PersonScore>>& people, std::size_t num_people,
    std::size_t num_groups) {
  std::vector<std::vector<double>> by_group(num_groups);
  for (std::size_t person = 0; person < std::min(num_people, people.size()); ++person) {
    if (people[person]) by_group.at(people[person]->group).push_back(people[person]->score);
  }
  return contrast_estimate(by_group);
}

SequentialOutcome sequential_outcome(
    const SequentialBoundaries& boundaries,
    const std::vector<std::optional<EffectEstimate>>& estimates) {
  SequentialOutcome outcome;
  const std::size_t num_looks = boundaries.rule.looks.size();
  for (std::size_t look = 0; look < std::min(num_looks, estimates.size()); ++look) {
    outcome.estimates.push_back(estimates[look]);
    outcome.significant = crosses(boundaries, look, estimates[look]);
    outcome.ended = outcome.significant || look + 1 == num_looks;
    if (outcome.ended) break;
  }
  return outcome;
}

}  // namespace jnd::analysis
