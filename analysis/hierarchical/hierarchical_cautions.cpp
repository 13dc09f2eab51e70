#include "analysis/hierarchical/hierarchical_cautions.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "analysis/fits/answer_scatter.h"

namespace jnd::analysis {
namespace {

/// Whether the search ended at a step. It stops somewhere between two levels; then every level
/// lies where the curve is flat, and no answer determines the slope. Often its error is
/// rounding alone.
bool is_step(const HierarchicalCondition& condition) {
  constexpr double kFlat = 5.0;      // At this z, F is 3e-7 from its end.
  constexpr double kNoError = 1e-6;  // This is the error of 1e12 answers.
  if (condition.least_level_z > kFlat) return true;
  return !(condition.slope_standard_error.value_or(1.0) > kNoError &&
           condition.place_standard_error.value_or(1.0) > kNoError);
}

/// Why a condition's answers do not support a value; "" if they do.
std::string why_not_told(const HierarchicalCondition& condition) {
  if (condition.num_participants < 2) {
    return "one participant says nothing of how people differ";
  }
  if (is_step(condition)) {
    return "lapses aside, the answers are one step between two levels, which every steep curve "
           "suits; levels between those two would tell";
  }
  return "";
}

/// Removes the condition's values under other models as well.
void leave_out_elsewhere(HierarchicalFit& fit, std::size_t condition) {
  const auto leave_out = [&](std::vector<std::optional<double>>& fractions) {
    if (condition < fractions.size()) fractions[condition].reset();
  };
  if (fit.scatter) leave_out(fit.scatter->weber_fractions_without);
  if (fit.own_lapses) leave_out(fit.own_lapses->weber_fractions_common);
  for (HierarchicalPriorEffect& one : fit.prior_effects) leave_out(one.weber_fractions);
}

}  // namespace

void add_note(HierarchicalFit& fit, const std::string& sentence) {
  fit.note += (fit.note.empty() ? "" : "; ") + sentence;
}

void note_spreads_at_bounds(HierarchicalFit& fit, bool has_own_places) {
  constexpr double kOne = 0.999;
  if (fit.correlation && std::fabs(*fit.correlation) > kOne) {
    add_note(fit,
             "the correlation of the slopes is at its bound (a singular fit): the answers tell "
             "no difference of people's own in the one condition from that in the other");
  }
  const auto has_no = [&](double HierarchicalCondition::*spread) {
    return std::ranges::any_of(fit.conditions, [&](const HierarchicalCondition& one) {
      return one.*spread <= kNoSpread;
    });
  };
  const bool no_slopes = has_no(&HierarchicalCondition::slope_sd);
  const bool no_places = has_own_places && has_no(&HierarchicalCondition::place_sd);
  if (!no_slopes && !no_places) return;
  add_note(fit, std::string("the spread of the ") +
                    (no_slopes && no_places ? "slopes and that of the places"
                     : no_slopes            ? "slopes"
                                            : "places") +
                    " between people " + (no_slopes && no_places ? "are" : "is") +
                    " at its bound 0: the answers show none beyond chance, which with few "
                    "answers a person does not mean that there is none");
}

void note_alike_people(HierarchicalFit& fit) {
  const bool any = std::ranges::any_of(
      fit.differences, [](const HierarchicalDifference& one) { return !one.standard_error; });
  if (any) add_note(fit, "no interval of a difference: people's answers are all alike");
}

void leave_out_what_is_not_told(HierarchicalFit& fit) {
  std::string reasons;
  for (HierarchicalCondition& one : fit.conditions) {
    const std::string why = why_not_told(one);
    if (why.empty()) continue;
    one.weber_fraction.reset();
    one.weber_fraction_ci95 = Interval{};
    one.weber_fraction_without_prior.reset();
    one.pse.reset();
    if (one.pse_ci95) one.pse_ci95 = Interval{};
    leave_out_elsewhere(fit, static_cast<std::size_t>(&one - fit.conditions.data()));
    reasons += (reasons.empty() ? "" : "; ") +
               (one.condition.empty() ? "" : one.condition + ": no value, for ") + why;
    std::erase_if(fit.differences, [&](const HierarchicalDifference& difference) {
      return difference.first == one.condition || difference.second == one.condition;
    });
  }
  if (reasons.empty()) return;
  const bool is_any_left = std::ranges::any_of(
      fit.conditions,
      [](const HierarchicalCondition& one) { return one.weber_fraction.has_value(); });
  if (is_any_left) {
    add_note(fit, reasons);
    return;
  }
  fit.status = FitStatus::kDegenerate;
  fit.reason = reasons;
}

void caution_of_misfit(HierarchicalFit& fit, std::optional<double> p_value) {
  if (!p_value || !(*p_value < kScatterBelow)) return;
  for (HierarchicalCondition& one : fit.conditions) {
    if (!one.weber_fraction) continue;
    one.is_rejected_by_fit = true;
    one.cautions.emplace_back(
        "the answers lie farther from people's curves than chance has them (deviance, p < "
        "0.01): the curve is not theirs, or a person changed from session to session, and the "
        "interval is too narrow");
  }
}

}  // namespace jnd::analysis
