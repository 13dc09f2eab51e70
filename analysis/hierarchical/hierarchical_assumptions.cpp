#include "analysis/hierarchical/hierarchical_assumptions.h"

#include <cmath>
#include <cstdio>
#include <string>

#include "analysis/hierarchical/hierarchical_cautions.h"

namespace jnd::analysis {
namespace {

/// Whether the options assume something about lapses and about the pse.
struct Assumptions {
  bool lapses = false, pse = false;

  [[nodiscard]] bool any() const noexcept { return lapses || pse; }
};

Assumptions assumptions_of(const HierarchicalOptions& options) {
  return {.lapses = options.lapses == HierarchicalLapses::kNone ||
                    options.lapses == HierarchicalLapses::kKnown,
          .pse = options.pse == HierarchicalPse::kReference ||
                 options.pse == HierarchicalPse::kCommon};
}

std::string rounded(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

/// For example "the lapse rate is 0 and everybody's pse is the reference".
std::string assumption_words(const Assumptions& assumed, const HierarchicalOptions& options) {
  std::string words;
  if (assumed.lapses) {
    words = "the lapse rate is " +
            rounded(options.lapses == HierarchicalLapses::kKnown ? options.lapse_rate : 0.0);
  }
  if (assumed.pse) {
    words += (words.empty() ? "" : " and ") + std::string("everybody's pse is the ") +
             (options.pse == HierarchicalPse::kReference ? "reference" : "same");
  }
  return words;
}

/// For example "a pse of each person's own and a free lapse rate, here 0.03".
std::string freed_words(const Assumptions& freed, const HierarchicalFit& without) {
  std::string words = freed.pse ? "a pse of each person's own" : "";
  if (freed.lapses) {
    words += (words.empty() ? "" : " and ") + std::string("a free lapse rate, here ") +
             rounded(without.lapse_rate.value_or(0.0));
  }
  return words;
}

void caution_where_values_move(HierarchicalFit& fit, const HierarchicalFit& without,
                               const std::string& assumed, const std::string& freed) {
  constexpr double kMuch = 1.0 / 12.0;
  for (std::size_t i = 0; i < fit.conditions.size(); ++i) {
    HierarchicalCondition& one = fit.conditions[i];
    const std::optional<double> other = without.conditions[i].weber_fraction;
    if (!one.weber_fraction || !other) continue;
    if (std::fabs(std::log(*other / *one.weber_fraction)) < kMuch) continue;
    one.cautions.push_back("the value hangs on the assumption that " + assumed + ": with " +
                           freed + ", it would be " + rounded(*other) + " instead of " +
                           rounded(*one.weber_fraction));
  }
}

}  // namespace

void tell_assumptions(HierarchicalFit& fit, const std::vector<ParticipantAnswers>& answers,
                      const HierarchicalOptions& options) {
  constexpr std::size_t kMostWithOwnPses = 2;
  const Assumptions assumed = assumptions_of(options);
  if (fit.status != FitStatus::kOk || !assumed.any()) return;
  const std::string words = assumption_words(assumed, options);
  add_note(fit, "the intervals hold if " + words + ", as was told");
  const Assumptions freed{.lapses = assumed.lapses,
                          .pse = assumed.pse && fit.conditions.size() <= kMostWithOwnPses};
  if (!freed.any()) return;
  HierarchicalOptions without_them = options;
  if (freed.lapses) without_them.lapses = HierarchicalLapses::kCommon;
  without_them.lapse_profile = false;
  without_them.prior_sensitivity = false;
  without_them.correlation_interval = false;
  if (freed.pse) without_them.pse = HierarchicalPse::kPersonal;
  const HierarchicalFit without = fit_hierarchical(answers, without_them);
  if (without.status != FitStatus::kOk) return;
  caution_where_values_move(fit, without, words, freed_words(freed, without));
}

}  // namespace jnd::analysis
