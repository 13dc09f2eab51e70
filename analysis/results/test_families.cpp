#include "analysis/results/test_families.h"

#include <map>
#include <string>
#include <string_view>

#include "analysis/statistics/multiplicity.h"
#include "analysis/words/said.h"

namespace jnd::analysis {

void mark_movement_family(std::vector<ResultsSection>& sections) {
  for (ResultsSection& section : sections) {
    if (section.name != "movement") continue;
    for (NamedComparison& named : section.comparisons) {
      if (named.comparison.kind == Comparison::Kind::kPaired) {
        named.family = kMovementFamily;
      } else {
        named.name += said(", sensitivity");
      }
    }
  }
}

void mark_pairs_family(std::vector<ResultsSection>& sections, bool were_asked_for) {
  for (ResultsSection& section : sections) {
    for (NamedComparison& named : section.comparisons) {
      if (named.primary) named.family = were_asked_for ? kAskedFamily : kPairsFamily;
    }
  }
}

void mark_pairs_beside_plan(std::vector<ResultsSection>& sections) {
  const std::string_view primary = said(" (primary)");
  for (ResultsSection& section : sections) {
    for (NamedComparison& named : section.comparisons) {
      if (!named.primary) continue;
      named.primary = false;
      named.family = kBesidePlanFamily;
      const std::size_t at = named.name.find(primary);
      if (at != std::string::npos) named.name.erase(at, primary.size());
    }
  }
}

std::string family_note(const NamedComparison& named) {
  if (named.family == kBesidePlanFamily) return said(kBesidePlanNote);
  if (named.family == kPairsFamily) return said(kPairsNote);
  return named.family == kAskedFamily ? said(kAskedNote) : "";
}

void adjust_by_family(std::vector<ResultsSection>& sections) {
  std::map<std::string, std::vector<NamedComparison*>> families;
  for (ResultsSection& section : sections) {
    for (NamedComparison& named : section.comparisons) {
      if (!named.family.empty()) families[named.family].push_back(&named);
    }
  }
  for (const auto& [family, tests] : families) {
    std::vector<std::optional<double>> p_values;
    for (const NamedComparison* test : tests) p_values.push_back(test->comparison.p_value);
    const std::vector<std::optional<double>> adjusted = holm_adjusted(p_values);
    for (std::size_t i = 0; i < tests.size(); ++i) tests[i]->p_value_holm = adjusted[i];
  }
}

}  // namespace jnd::analysis
