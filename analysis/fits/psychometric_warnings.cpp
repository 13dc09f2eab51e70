#include "analysis/fits/psychometric_warnings.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "analysis/fits/answer_scatter.h"
#include "analysis/fits/bootstrap_ends.h"
#include "analysis/fits/psychometric_goodness.h"
#include "analysis/fits/psychometric_search.h"

namespace jnd::analysis {
namespace {

using enum PsychometricMethod;

/// Whether the p value exists and is below `kScatterBelow`, one in a hundred.
bool is_far_off(const std::optional<double>& p_value) {
  return p_value && *p_value < kScatterBelow;
}

std::string rounded(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

/// Advice to free the lapse rate if the answers are close to a curve with a free one; ""
/// otherwise.
std::string advice_of_lapses(const PsychometricFit& fit, const PsychometricLevels& levels,
                             const PsychometricOptions& options, bool free_pse) {
  if (options.free_lapse || !fit.deviance) return "";
  PsychometricLevels with_lapses = levels;
  with_lapses.ends.known_lapse = 0.0;
  with_lapses.ends.symmetric = options.guess_rate == 0.0;
  const PsychometricSearch search(with_lapses, kMaximumLikelihood, free_pse, true);
  const PsychometricSearchResult found = search.find(with_lapses, minimised_by_newton);
  if (found.supremum != PsychometricSupremum::kAttained) return "";
  const PsychometricCurve& curve = found.optimum.curve;
  const double deviance = deviance_of(with_lapses, -found.optimum.cost.value);
  if (!(curve.lapse > 0.0) || is_far_off(misfit_p_value(with_lapses, search.free(), curve))) {
    return "";
  }
  return std::string("; lapses explain them (deviance ") + rounded(*fit.deviance) +
         ", with a lapse rate " + rounded(deviance) +
         "): " + (with_lapses.ends.symmetric ? "--free lapse" : "--lapse free");
}

/// Advice on answers that lie far from the curve.
std::string advice_of_scatter(const PsychometricFit& fit, const PsychometricLevels& levels,
                              const PsychometricOptions& options, bool free_pse) {
  if (!options.advice) return "";
  std::string lapses = advice_of_lapses(fit, levels, options, free_pse);
  if (!lapses.empty() || options.method != kMaximumLikelihood) return lapses;
  return "; --overdispersion scaled or --overdispersion beta-binomial have intervals as wide "
         "as "
         "the answers scatter";
}

/// A curve with lapses that is compatible with the answers.
struct WithLapses {
  double lapse_rate = 0.0, weber_fraction = 0.0;
};

/// The curve with the most likely lapse rate if the answers speak for one (2.71: one-sided,
/// 5 %). Otherwise the curve with a lapse rate of 3 % if the answers do not speak against it
/// (1.92: 95 %). Answers are assumed to be independent.
std::optional<WithLapses> with_lapses(const PsychometricFit& fit,
                                      const PsychometricLevels& levels, bool free_pse) {
  constexpr double kForLapses = 2.71, kNotAgainst = 1.92, kSomeLapses = 0.03;
  PsychometricLevels its = levels;
  its.ends.symmetric = fit.guess_rate == 0.0;
  const auto found_with = [&](double known_lapse, bool is_free) {
    its.ends.known_lapse = known_lapse;
    return PsychometricSearch(its, kMaximumLikelihood, free_pse, is_free)
        .find(its, minimised_by_newton);
  };
  const PsychometricSearchResult without = found_with(0.0, false);
  if (without.supremum != PsychometricSupremum::kAttained) return std::nullopt;
  for (const bool is_free : {true, false}) {
    const PsychometricSearchResult found = found_with(is_free ? 0.0 : kSomeLapses, is_free);
    if (found.supremum != PsychometricSupremum::kAttained) continue;
    const PsychometricCurve& curve = found.optimum.curve;
    const double gain = without.optimum.cost.value - found.optimum.cost.value;
    if (is_free ? 2.0 * gain < kForLapses : gain < -kNotAgainst) continue;
    return WithLapses{is_free ? curve.lapse : kSomeLapses, curve.weber_fraction(its)};
  }
  return std::nullopt;
}

/// If the model has no lapses, warns how strongly the Weber fraction depends on that.
void add_doubt_of_lapses(PsychometricFit& fit, const PsychometricLevels& levels,
                         const PsychometricOptions& options, bool free_pse) {
  constexpr double kMuch = 0.2;
  if (!options.advice || options.method != kMaximumLikelihood || !fit.weber_fraction) return;
  if (options.free_lapse) {
    constexpr double kManyLapses = 0.2;  // The share of answers that are random.
    if (fit.lapse_rate.value_or(0.0) * (fit.symmetric_lapse ? 2.0 : 1.0) > kManyLapses) {
      fit.warnings.emplace_back(
          "more than one answer in five looks like a lapse: the answers hardly rise, and the "
          "Weber fraction says little");
    }
    return;
  }
  if (options.lapse_rate > 0.0) return;
  const std::optional<WithLapses> other = with_lapses(fit, levels, free_pse);
  if (!other || std::fabs(other->weber_fraction / *fit.weber_fraction - 1.0) < kMuch) return;
  fit.warnings.push_back(
      "the Weber fraction hangs on there being no lapses: with a lapse rate of " +
      rounded(other->lapse_rate) + ", which the answers bear, it would be " +
      rounded(other->weber_fraction) + " instead of " + rounded(*fit.weber_fraction) + "; " +
      (fit.guess_rate > 0.0 ? "--lapse free" : "--free lapse") + " fits one");
}

bool takes_calibration(const PsychometricOptions& options) {
  return options.family == PsychometricFamily::kWeber && options.method == kMaximumLikelihood &&
         options.guess_rate == 0.0 && !options.free_lapse && options.lapse_rate == 0.0 &&
         options.overdispersion == Overdispersion::kNone;
}

void add_doubts(PsychometricFit& fit, const std::vector<AnswerCount>& data,
                const PsychometricLevels& levels) {
  if (all_alike(data)) {
    fit.warnings.emplace_back(kAllAlike);
  }
  const double at_jnd = fit.weber_fraction ? *fit.pse * (1.0 + *fit.weber_fraction)
                                           : *fit.pse + fit.parameters.back().value;
  if (at_jnd > levels.intensity.back()) {
    fit.warnings.emplace_back(
        std::string(fit.weber_fraction ? "the Weber fraction" : "the standard deviation") +
        (fit.weber_fraction ? " lies" : " reaches") +
        " beyond the stimuli: no level is as high as where the curve is 84.13 %" +
        (fit.guess_rate > 0.0 ? ", guesses aside" : ""));
  }
}

/// Warns about scatter between rows. It moves the curve itself, and a wider interval does not
/// mend that.
void add_scatter_of_rows(PsychometricFit& fit, const std::vector<AnswerCount>& data,
                         const PsychometricOptions& options) {
  if (!options.advice) return;
  const bool binomial = options.overdispersion == Overdispersion::kNone;
  const bool are_single =
      std::ranges::none_of(data, [](const AnswerCount& row) { return row.num_trials > 1; });
  if (!binomial && are_single) {
    fit.warnings.emplace_back(
        "every row is a single answer: --overdispersion goes by the levels, and sees nothing "
        "of "
        "what scatters from session to session, or where no level has two answers; add up the "
        "answers of each session to a row a level");
  }
  if (!row_scatter(data).is_significant()) return;
  fit.warnings.emplace_back(
      std::string("rows of the same level scatter more than independent answers do "
                  "(chi-squared, p < 0.01), as those of several people or sessions may: ") +
      (binomial ? "the intervals are too narrow, and " : "") +
      "where their pse moves, the Weber fraction itself is too large; --group-by fits each of "
      "them" +
      (binomial && !are_single
           ? ", --overdispersion scaled or --overdispersion beta-binomial have intervals as "
             "wide as the rows scatter"
           : ""));
}

}  // namespace

bool have_fewer_answers(const PsychometricLevels& levels, double num_trials) {
  return levels.zero_trials < num_trials &&
         std::ranges::all_of(levels.num_trials, [&](double num) { return num < num_trials; });
}

bool all_alike(const std::vector<AnswerCount>& data) {
  const auto none = [](const AnswerCount& row) { return row.num_yes == 0; };
  const auto every = [](const AnswerCount& row) { return row.num_yes == row.num_trials; };
  return std::ranges::all_of(data, none) || std::ranges::all_of(data, every);
}

void add_psychometric_warnings(PsychometricFit& fit, const std::vector<AnswerCount>& data,
                               const PsychometricLevels& levels,
                               const PsychometricOptions& options, bool falls) {
  const bool are_few = have_fewer_answers(levels, kFewAnswers);
  if (fit.bootstrap.n > 0 && fit.bootstrap.n < kFewestRefits) {
    fit.warnings.push_back(too_few_refits());
  }
  if (fit.bootstrap.n > 0 && are_few) {
    fit.warnings.emplace_back(
        "bootstrap intervals cover less than 95 % at so few answers a level (74 to 95 % at "
        "five): rather use the likelihood ratio's");
  }
  const bool free_pse = options.free_pse || traits_of(options.family).always_free_pse;
  const bool binomial = options.overdispersion == Overdispersion::kNone;
  if (free_pse && options.intervals && options.method == kMaximumLikelihood && binomial &&
      are_few && options.num_calibration == 0) {
    fit.warnings.push_back(
        std::string("with a free pse and so few answers a level, likelihood-ratio intervals "
                    "hold the truth somewhat too rarely (91 to 93 % at five answers a level, "
                    "not 95 %)") +
        (options.advice && takes_calibration(options) ? "; --calibration 1000 widens them"
                                                      : ""));
  }
  if (options.method == PsychometricMethod::kLeastSquares) {
    fit.warnings.emplace_back(
        "least squares takes every level's proportion as equally precise, which they are not: "
        "rather use maximum likelihood's interval");
  }
  const auto advice = [&] {
    return falls ? "" : advice_of_scatter(fit, levels, options, free_pse);
  };
  if (fit.goodness.p_value && *fit.goodness.p_value < 0.05) {
    fit.warnings.push_back(
        "the answers lie farther from the curve than chance has them (p < 0.05)" +
        (binomial ? ": the intervals are too narrow" + advice()
                  : std::string(", as independent answers do; the intervals allow for it")));
  }
  add_doubts(fit, data, levels);
  add_doubt_of_lapses(fit, levels, options, free_pse);
  // Least squares does not minimise the deviance, and a simulated p value takes precedence.
  const bool other =
      fit.method == PsychometricMethod::kLeastSquares || fit.goodness.p_value.has_value();
  if (!other && binomial && is_far_off(fit.misfit_p_value)) {
    fit.warnings.push_back(
        "the answers lie farther from the curve than chance has them (by their deviance, "
        "p < 0.01): the curve is not theirs, and the intervals are too narrow" +
        advice());
  }
  add_scatter_of_rows(fit, data, options);
  if (!fit.overdispersion.note.empty()) fit.warnings.push_back(fit.overdispersion.note);
}

}  // namespace jnd::analysis
