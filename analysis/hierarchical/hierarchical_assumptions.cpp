#include "analysis/hierarchical/hierarchical_assumptions.h"

#include <cmath>
#include <cstdio>
#include <string>

namespace jnd::analysis {
namespace {

/// What the options assume that the answers can be asked about.
struct Assumptions {
  bool lapses = false, pse = false;

  [[nodiscard]] bool any() const noexcept { return lapses || pse; }
};

Assumptions assumptions_of(const HierarchicalOptions& options, std::size_t num_conditions) {
  constexpr std::size_t kMostWithOwnPses = 2;
  const bool has_pse =
      options.pse == HierarchicalPse::kReference || options.pse == HierarchicalPse::kCommon;
  return {.lapses = options.lapses != HierarchicalLapses::kCommon,
          .pse = has_pse && num_conditions <= kMostWithOwnPses};
}

std::string rounded(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

/// "that everybody's pse is the reference: with a pse of each person's own"
std::string words_of(const Assumptions& assumed, const HierarchicalFit& without,
                     const HierarchicalOptions& options) {
  const std::string and_word = assumed.pse && assumed.lapses ? " and " : "";
  std::string all, freed;
  if (assumed.pse) {
    all = options.pse == HierarchicalPse::kReference ? "that everybody's pse is the reference"
                                                     : "that everybody has the same pse";
    freed = "a pse of each person's own";
  }
  if (assumed.lapses) {
    all += and_word + "the lapse rate that was given";
    freed += and_word + "a free lapse rate, here " + rounded(without.lapse_rate.value_or(0.0));
  }
  return all + ": with " + freed;
}

}  // namespace

void caution_of_assumptions(HierarchicalFit& fit,
                            const std::vector<ParticipantAnswers>& answers,
                            const HierarchicalOptions& options) {
  constexpr double kMuch = 1.0 / 12.0;
  const Assumptions assumed = assumptions_of(options, fit.conditions.size());
  if (fit.status != FitStatus::kOk || !assumed.any()) return;
  HierarchicalOptions freed = options;
  freed.lapses = HierarchicalLapses::kCommon;
  freed.lapse_profile = false;
  if (assumed.pse) freed.pse = HierarchicalPse::kPersonal;
  const HierarchicalFit without = fit_hierarchical(answers, freed);
  if (without.status != FitStatus::kOk) return;
  for (std::size_t i = 0; i < fit.conditions.size(); ++i) {
    HierarchicalCondition& one = fit.conditions[i];
    const std::optional<double> other = without.conditions[i].weber_fraction;
    if (!one.weber_fraction || !other) continue;
    if (std::fabs(std::log(*other / *one.weber_fraction)) < kMuch) continue;
    one.cautions.push_back("the value hangs on " + words_of(assumed, without, options) +
                           ", it would be " + rounded(*other) + " instead of " +
                           rounded(*one.weber_fraction));
  }
}

}  // namespace jnd::analysis
