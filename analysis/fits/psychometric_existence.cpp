#include "analysis/fits/psychometric_existence.h"
#include "core/require.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace jnd::analysis {
namespace {

using core::kInfinity;

constexpr std::string_view kNoTrials = "too few rows: no level has an answer";
constexpr std::string_view kTooFewForLapse =
    "too few rows: slope, pse and lapse rate cannot be told apart with so few levels";
constexpr std::string_view kTooFewForGuess =
    "too few rows: slope, pse, guess rate and lapse rate cannot be told apart with so few "
    "levels";
constexpr std::string_view kTooFewForSlopeAndLapse =
    "too few rows: slope and lapse rate cannot be told apart with so few levels";
constexpr std::string_view kNoOther =
    "one intensity: beside 0 and the reference, where every slope gives the same, there is "
    "none, so nothing tells how fine the discrimination is";
constexpr std::string_view kOneIntensity =
    "one intensity: a slope and a pse need answers at two intensities > 0 or more";
constexpr std::string_view kAllAnswersAlike =
    "all alike: every answer is the same, so the pse lies beyond all levels";
constexpr std::string_view kAllAlikeAtReference =
    "all alike: every answer is the same, so nothing tells how fine the discrimination is";
constexpr std::string_view kSeparated =
    "separated: one threshold splits the answers without overlap, so the Weber fraction falls "
    "to 0";
constexpr std::string_view kStep =
    "separated: a step explains the answers at least as well as any slope, so the Weber "
    "fraction falls to 0";
constexpr std::string_view kFlat =
    "flat: the answers do not rise with the intensity, so the Weber fraction grows without "
    "bound";
constexpr std::string_view kAtChance =
    "flat: the answers do not rise above the guess rate with the intensity, so the Weber "
    "fraction "
    "grows without bound";
constexpr std::string_view kInverted =
    "inverted: yes becomes rarer as the intensity rises, so no Weber fraction > 0 fits";

/// The smallest and largest log ratio with a yes, and with a no. They are infinite if there is
/// none.
struct Reach {
  double first_yes = kInfinity, last_yes = -kInfinity;
  double first_no = kInfinity, last_no = -kInfinity;

  [[nodiscard]] bool all_alike() const noexcept {
    return last_yes == -kInfinity || last_no == -kInfinity;
  }
};

Reach reach_of(const PsychometricLevels& levels) noexcept {
  Reach reach;
  for (std::size_t level = 0; level < levels.size(); ++level) {
    const double u = levels.abscissa[level];
    if (levels.num_yes[level] > 0.0) {
      reach.first_yes = std::min(reach.first_yes, u);
      reach.last_yes = std::max(reach.last_yes, u);
    }
    if (levels.num_yes[level] < levels.num_trials[level]) {
      reach.first_no = std::min(reach.first_no, u);
      reach.last_no = std::max(reach.last_no, u);
    }
  }
  return reach;
}

PsychometricExistence flat_or_inverted(const PsychometricLevels& levels, bool free_pse) {
  // Answers that are all alike do not fall, even if the levels lie more on one side.
  if (!free_pse && reach_of(levels).all_alike()) {
    return {PsychometricSupremum::kFlat, kAllAlikeAtReference};
  }
  const double rise = rise_of_answers(levels, free_pse);
  if ((levels.ends.guess > 0.0 || levels.ends.free_guess) && !(rise < 0.0))
    return {PsychometricSupremum::kFlat, kAtChance};
  return {PsychometricSupremum::kFlat, rise < 0.0 ? kInverted : kFlat};
}

}  // namespace

double rise_of_answers(const PsychometricLevels& levels, bool free_pse) noexcept {
  double yes = 0.0, trials = 0.0;
  for (std::size_t level = 0; level < levels.size(); ++level) {
    yes += levels.num_yes[level];
    trials += levels.num_trials[level];
  }
  const double expected = free_pse ? yes / trials : levels.ends.middle(levels.ends.known_lapse);
  double sum = 0.0, size = 0.0;
  for (std::size_t level = 0; level < levels.size(); ++level) {
    const double u = levels.abscissa[level];
    sum += (levels.num_yes[level] - expected * levels.num_trials[level]) * u;
    size += levels.num_trials[level] * std::fabs(u);
  }
  return std::fabs(sum) <= 1e-14 * size ? 0.0 : sum;
}

std::string_view why_unidentified(const PsychometricLevels& levels, bool free_pse,
                                  bool free_lapse) {
  if (levels.size() == 0 && !(levels.zero_trials > 0.0)) return kNoTrials;
  // Intensity 0 measures the lower end, which is fixed if it depends on a known guess rate
  // alone.
  const bool has_free_low = levels.ends.symmetric || levels.ends.free_guess;
  const int at_zero = levels.zero_trials > 0.0 && has_free_low ? 1 : 0;
  if (free_pse) {
    if (levels.size() < 2) return kOneIntensity;
    const int num_levels = static_cast<int>(levels.size()) + at_zero;
    if (levels.ends.free_guess && num_levels < (free_lapse ? 4 : 3)) return kTooFewForGuess;
    return free_lapse && num_levels < 3 ? kTooFewForLapse : std::string_view();
  }
  std::vector<double> distances;
  bool at_reference = false;
  for (const double u : levels.abscissa) {
    // If lapses affect both ends equally, a curve through the reference is symmetric about it.
    if (u != 0.0) distances.push_back(levels.ends.symmetric ? std::fabs(u) : u);
    at_reference = at_reference || u == 0.0;
  }
  std::sort(distances.begin(), distances.end());
  const auto last = std::unique(distances.begin(), distances.end(), [](double a, double b) {
    return b - a <= 1e-12 * std::fabs(b);
  });
  const int num_distances = static_cast<int>(last - distances.begin());
  if (num_distances == 0) return kNoOther;
  const int at_middle = at_reference && !levels.ends.symmetric ? 1 : 0;
  return free_lapse && num_distances + at_zero + at_middle < 2 ? kTooFewForSlopeAndLapse
                                                               : std::string_view();
}

PsychometricExistence existence_from_counts(const PsychometricLevels& levels, bool free_pse) {
  if (levels.zero_yes > 0.0) return {PsychometricSupremum::kImpossible, kYesAtZero};
  const Reach reach = reach_of(levels);
  if (free_pse) {
    if (reach.all_alike()) return {PsychometricSupremum::kStep, kAllAnswersAlike};
    if (reach.last_no <= reach.first_yes) return {PsychometricSupremum::kStep, kSeparated};
  } else if (!(reach.first_yes < 0.0) && !(reach.last_no > 0.0)) {
    return {PsychometricSupremum::kStep, kSeparated};
  }
  if (!(rise_of_answers(levels, free_pse) > 0.0)) return flat_or_inverted(levels, free_pse);
  return {PsychometricSupremum::kAttained, ""};
}

PsychometricExistence lower_limit(const PsychometricLevels& levels, bool free_pse,
                                  double step_cost, double flat_cost) {
  if (free_pse && reach_of(levels).all_alike())
    return {PsychometricSupremum::kStep, kAllAnswersAlike};
  if (step_cost < flat_cost * (1.0 - 1e-13)) return {PsychometricSupremum::kStep, kStep};
  return flat_or_inverted(levels, free_pse);
}

}  // namespace jnd::analysis
