#include "analysis/planning/power_run.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "analysis/hierarchical/hierarchical_fit.h"
#include "analysis/results/discrimination_answers.h"
#include "analysis/results/magnitude_fits.h"
#include "analysis/statistics/comparison.h"
#include "analysis/statistics/effect_test.h"
#include "analysis/statistics/multiplicity.h"
#include "analysis/statistics/summary.h"

namespace jnd::analysis {
namespace {

/// A participant's number in a block, on a scale on which it is normally distributed over
/// people: ln ln(1 + w), the exponent, 1 / exponent for a production, ln(match), or the mean
/// step.
struct OwnNumber {
  bool answered = false;
  std::optional<double> plain;      ///< Absent for a degenerate participant.
  std::optional<double> corrected;  ///< For Weber fractions: with half an answer added.
};

std::optional<double> log_log(const std::optional<double>& weber_fraction) {
  if (!weber_fraction) return std::nullopt;
  const double value = std::log(std::log1p(*weber_fraction));
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

bool frees_pse(const PlannedAnalysis& analysis, const PlannedBlock& block) {
  return analysis.free_pse && !block.either_interval;
}

std::string pse_words(bool free_pse) { return free_pse ? "pse free" : "pse at the reference"; }

std::optional<double> mean_over_stimuli(const Means& means) {
  std::vector<double> values;
  for (const auto& [x, mean] : means) values.push_back(mean);
  return summary_of(values).mean;
}

OwnNumber own_number(const PlannedAnalysis& analysis, const PlannedBlock& block,
                     const PlannedAnswers& answers) {
  OwnNumber own{.answered = !answers.counts.empty() || !answers.magnitudes.empty()};
  if (!own.answered) return own;
  if (block.quantity == PlannedQuantity::kWeberFraction) {
    const auto fit = [&](bool corrected) {
      return log_log(
          fit_psychometric(corrected ? with_half_an_answer(answers.counts) : answers.counts,
                           {.reference = block.reference,
                            .free_pse = frees_pse(analysis, block),
                            .by_order = true,
                            .intervals = false,
                            .solver = Solver::kNewton})
              .weber_fraction);
    };
    own.plain = fit(false);
    own.corrected = fit(true);
    return own;
  }
  if (block.quantity == PlannedQuantity::kRating) {
    own.plain = mean_over_stimuli(means_of(answers.magnitudes));
    return own;
  }
  // A match of 0 is left out, as in the results.
  const ZeroRule rule =
      block.quantity == PlannedQuantity::kMatch ? ZeroRule::kLeaveOut : ZeroRule::kHalfSmallest;
  const Means logs = means_of(log_answers(answers.magnitudes, rule).logs);
  if (block.quantity == PlannedQuantity::kMatch) {
    own.plain = mean_over_stimuli(logs);
    return own;
  }
  // A production is answered with an intensity, so the slope of ln I over ln S is 1 / exponent.
  own.plain = fit_log_estimation(logs).a;
  return own;
}

/// The answers in several blocks, pooled as if they were one block.
PlannedAnswers joined(const PlannedPerson& person, const std::vector<std::size_t>& places) {
  PlannedAnswers all;
  std::map<std::pair<double, double>, AnswerCount> counts;
  for (const std::size_t place : places) {
    for (const AnswerCount& count : person[place].counts) {
      AnswerCount& sum = counts[{count.intensity, count.order}];
      sum.intensity = count.intensity;
      sum.order = count.order;
      sum.num_yes += count.num_yes;
      sum.num_trials += count.num_trials;
    }
    for (const auto& [x, values] : person[place].magnitudes) {
      std::vector<double>& into = all.magnitudes[x];
      into.insert(into.end(), values.begin(), values.end());
    }
  }
  for (const auto& [key, count] : counts) all.counts.push_back(count);
  return all;
}

/// A person's number in one condition of a contrast, as `ConditionNumbers` computes it for the
/// results.
std::optional<double> contrast_number(const PlannedAnalysis& analysis,
                                      const PowerContrast& contrast,
                                      const std::vector<std::size_t>& places,
                                      const PlannedPerson& person) {
  using experiments::ContrastMeasure;
  const PlannedBlock& block = analysis.blocks[places.front()];
  const PlannedAnswers answers = joined(person, places);
  if (answers.counts.empty() && answers.magnitudes.empty()) return std::nullopt;
  switch (contrast.measure) {
    case ContrastMeasure::kWeberFraction: {
      const OwnNumber own = own_number(analysis, block, answers);
      return own.plain ? own.plain : own.corrected;
    }
    case ContrastMeasure::kPse: {
      const std::optional<double> pse =
          fit_psychometric(answers.counts, {.reference = block.reference,
                                            .free_pse = true,
                                            .by_order = true,
                                            .intervals = false,
                                            .solver = Solver::kNewton})
              .pse;
      if (!pse || !(*pse > 0.0)) return std::nullopt;
      return std::log(*pse / block.reference);
    }
    case ContrastMeasure::kExponent:
      if (block.quantity == PlannedQuantity::kProductionExponent) {
        return fit_own_intensity_on_magnitude(answers.magnitudes).a;
      }
      return own_number(analysis, block, answers).plain;
    case ContrastMeasure::kMatch:
    case ContrastMeasure::kRating:
      return own_number(analysis, block, answers).plain;
    case ContrastMeasure::kMagnitude:
      return mean_over_stimuli(
          means_of(log_answers(answers.magnitudes, ZeroRule::kHalfSmallest).logs));
    case ContrastMeasure::kQuestion:
    case ContrastMeasure::kResponseTime:
      break;
  }
  return std::nullopt;
}

std::optional<PersonScore> contrast_score(const PlannedAnalysis& analysis,
                                          const PowerContrast& contrast,
                                          const PlannedPerson& person,
                                          const experiments::Levels& levels) {
  const auto is_its = [&](const experiments::Levels& group) {
    return std::ranges::all_of(group, [&](const auto& level) {
      const auto own = levels.find(level.first);
      return own != levels.end() && own->second == level.second;
    });
  };
  const auto group = std::ranges::find_if(contrast.groups, is_its);
  if (group == contrast.groups.end()) return std::nullopt;
  PersonScore score{.group = static_cast<std::size_t>(group - contrast.groups.begin())};
  for (std::size_t at = 0; at < contrast.conditions.size(); ++at) {
    const auto number = contrast_number(analysis, contrast, contrast.conditions[at], person);
    if (!number) return std::nullopt;
    score.score += contrast.weights[score.group][at] * *number;
  }
  return score;
}

/// Indexed by contrast, then by person.
using ContrastScores = std::vector<std::vector<std::optional<PersonScore>>>;

/// The tests of all contrasts with the first `size` people. p values are adjusted within their
/// families.
std::vector<PlannedTest> contrast_tests(const PlannedAnalysis& analysis,
                                        const ContrastScores& scores, std::size_t size) {
  std::vector<std::optional<EffectEstimate>> estimates;
  std::map<std::string, std::vector<std::size_t>> families;
  for (std::size_t at = 0; at < analysis.contrasts.size(); ++at) {
    std::vector<std::vector<double>> by_group(analysis.contrasts[at].groups.size());
    for (std::size_t person = 0; person < size; ++person) {
      const std::optional<PersonScore>& one = scores[at][person];
      if (one) by_group[one->group].push_back(one->score);
    }
    estimates.push_back(contrast_estimate(by_group));
    families[analysis.contrasts[at].family].push_back(at);
  }
  std::vector<std::optional<double>> adjusted(analysis.contrasts.size());
  for (const auto& [family, members] : families) {
    std::vector<std::optional<double>> p_values;
    for (const std::size_t at : members) {
      p_values.push_back(
          estimates[at] ? std::optional(p_value_of(*estimates[at], analysis.contrasts[at].tail))
                        : std::nullopt);
    }
    using experiments::Correction;
    const Correction correction = analysis.contrasts[members.front()].correction;
    if (correction == Correction::kHolm) p_values = holm_adjusted(p_values);
    if (correction == Correction::kBonferroni) p_values = bonferroni_adjusted(p_values);
    for (std::size_t i = 0; i < members.size(); ++i) adjusted[members[i]] = p_values[i];
  }
  std::vector<PlannedTest> tests;
  for (std::size_t at = 0; at < analysis.contrasts.size(); ++at) {
    const auto effect = estimates[at] ? std::optional(estimates[at]->effect) : std::nullopt;
    tests.push_back({effect, adjusted[at]});
    if (!analysis.contrasts[at].margin) continue;
    tests.push_back({effect, estimates[at]
                                 ? std::optional(equivalence_p_value(
                                       *estimates[at], *analysis.contrasts[at].margin))
                                 : std::nullopt});
  }
  return tests;
}

/// Transforms a number back from the scale on which it is normally distributed.
double quantity_at(double number, PlannedQuantity quantity) {
  if (quantity == PlannedQuantity::kWeberFraction) return std::expm1(std::exp(number));
  if (quantity == PlannedQuantity::kProductionExponent) {
    // No power function sets a lower intensity for a higher target, so such an end is open.
    return number > 0.0 ? 1.0 / number : std::numeric_limits<double>::infinity();
  }
  return quantity == PlannedQuantity::kMatch ? std::exp(number) : number;
}

PlannedEstimate mean_of(const std::vector<double>& numbers, PlannedQuantity quantity) {
  const Summary summary = summary_of(numbers);
  PlannedEstimate estimate{.value = summary.mean, .ci95 = summary.mean_ci95};
  for (std::optional<double>* end :
       {&estimate.value, &estimate.ci95.low, &estimate.ci95.high}) {
    if (!*end) continue;
    const double value = quantity_at(**end, quantity);
    *end = std::isfinite(value) ? std::optional(value) : std::nullopt;
  }
  // The reciprocal exchanges the lower and the upper end.
  if (quantity == PlannedQuantity::kProductionExponent) {
    std::swap(estimate.ci95.low, estimate.ci95.high);
  }
  return estimate;
}

/// Analyses one study of a certain size from everybody's numbers.
class SizeAnalysis {
 public:
  SizeAnalysis(const PlannedAnalysis& analysis, const std::vector<PlannedPerson>& people,
               const std::vector<std::vector<OwnNumber>>& numbers, int size)
      : analysis_(analysis),
        people_(people),
        numbers_(numbers),
        size_(static_cast<std::size_t>(size)) {}

  [[nodiscard]] PlannedSize result() const {
    PlannedSize result;
    for (std::size_t block = 0; block < analysis_.blocks.size(); ++block) {
      add_block(result, block);
    }
    if (!analysis_.compared) return result;
    result.tests.push_back(test(&OwnNumber::plain));
    result.tests.push_back(test(&OwnNumber::corrected));
    if (analysis_.hierarchical) result.tests.push_back(hierarchical_test());
    return result;
  }

 private:
  void add_block(PlannedSize& result, std::size_t block) const {
    std::vector<double> numbers;
    int num_with_answers = 0, num_degenerate = 0, num_at_grid_end = 0;
    for (std::size_t person = 0; person < size_; ++person) {
      const OwnNumber& own = numbers_[person][block];
      if (!own.answered) continue;
      ++num_with_answers;
      num_degenerate += own.plain ? 0 : 1;
      num_at_grid_end += people_[person][block].at_grid_end ? 1 : 0;
      if (own.plain) numbers.push_back(*own.plain);
    }
    const PlannedQuantity quantity = analysis_.blocks[block].quantity;
    result.estimates.push_back(mean_of(numbers, quantity));
    if (analysis_.hierarchical && quantity == PlannedQuantity::kWeberFraction) {
      const HierarchicalFit fit = hierarchical({block});
      PlannedEstimate estimate;
      if (fit.status == FitStatus::kOk) {
        estimate = {fit.conditions.front().weber_fraction,
                    fit.conditions.front().weber_fraction_ci95};
      }
      result.estimates.push_back(estimate);
    }
    result.num_with_answers.push_back(num_with_answers);
    result.num_degenerate.push_back(num_degenerate);
    result.num_at_grid_end.push_back(num_at_grid_end);
  }

  [[nodiscard]] PlannedTest test(std::optional<double> OwnNumber::*number) const {
    std::vector<double> first, second;
    for (std::size_t person = 0; person < size_; ++person) {
      const std::optional<double>& a = numbers_[person][analysis_.compared->first].*number;
      const std::optional<double>& b = numbers_[person][analysis_.compared->second].*number;
      if (analysis_.paired && !(a && b)) continue;
      if (a) first.push_back(*a);
      if (b) second.push_back(*b);
    }
    const Comparison comparison = analysis_.paired
                                      ? paired_t_test(first, second, EffectSizes::kLeftOut)
                                      : welch_t_test(first, second, EffectSizes::kLeftOut);
    return {comparison.estimate, comparison.p_value};
  }

  [[nodiscard]] HierarchicalFit hierarchical(const std::vector<std::size_t>& blocks) const {
    std::vector<ParticipantAnswers> answers;
    for (const std::size_t block : blocks) {
      for (std::size_t person = 0; person < size_; ++person) {
        const std::vector<AnswerCount>& counts = people_[person][block].counts;
        if (counts.empty()) continue;
        answers.push_back({std::to_string(person), analysis_.blocks[block].name,
                           analysis_.blocks[block].reference, counts});
      }
    }
    if (answers.empty()) return {};
    const bool free_pse = std::ranges::any_of(blocks, [&](std::size_t block) {
      return frees_pse(analysis_, analysis_.blocks[block]);
    });
    return fit_hierarchical(
        answers, {.pse = free_pse ? HierarchicalPse::kPersonal : HierarchicalPse::kReference,
                  // The interval of a single block's fraction is reported. A difference needs
                  // no profile.
                  .lapse_profile = blocks.size() == 1});
  }

  [[nodiscard]] PlannedTest hierarchical_test() const {
    const HierarchicalFit fit =
        hierarchical({analysis_.compared->first, analysis_.compared->second});
    if (fit.status != FitStatus::kOk || fit.differences.empty()) return {};
    // The fit has the second condition minus the first.
    return {-fit.differences.front().estimate, fit.differences.front().p_value};
  }

  const PlannedAnalysis& analysis_;
  const std::vector<PlannedPerson>& people_;
  const std::vector<std::vector<OwnNumber>>& numbers_;
  std::size_t size_;
};

}  // namespace

std::vector<PlannedName> estimate_names(const PlannedAnalysis& analysis) {
  std::vector<PlannedName> names;
  for (std::size_t place = 0; place < analysis.blocks.size(); ++place) {
    const PlannedBlock& block = analysis.blocks[place];
    if (block.quantity == PlannedQuantity::kMatch) {
      names.push_back({block.name + ".match",
                       "geometric mean of the participants' matches over all standards",
                       place});
      continue;
    }
    if (block.quantity == PlannedQuantity::kRating) {
      names.push_back({block.name + ".rating",
                       "mean of the participants' mean steps over all stimuli", place});
      continue;
    }
    if (block.quantity != PlannedQuantity::kWeberFraction) {
      names.push_back(
          {block.name + ".own_exponents",
           block.quantity == PlannedQuantity::kEstimationExponent
               ? "mean of the participants' own slopes of ln S over ln I, in place of the "
                 "curve through the means"
               : "1 / mean of the participants' own slopes of ln I over ln S, in place of "
                 "the curve through the means",
           place});
      continue;
    }
    const std::string pse = pse_words(frees_pse(analysis, block));
    names.push_back({block.name + ".weber_fraction",
                     "median person's w by the fast route: mean of individual ln ln(1 + w), " +
                         pse + ", without degenerate participants, transformed back",
                     place, /*quick=*/true});
    if (!analysis.hierarchical) continue;
    names.push_back({block.name + ".weber_fraction_hierarchical",
                     "median person's w: hierarchical probit, " + pse, place});
  }
  return names;
}

namespace {

std::vector<PlannedName> pair_names(const PlannedAnalysis& analysis) {
  if (!analysis.compared) return {};
  const std::string pair = analysis.blocks[analysis.compared->first].name + " - " +
                           analysis.blocks[analysis.compared->second].name;
  const PlannedBlock& first = analysis.blocks[analysis.compared->first];
  const PlannedBlock& second = analysis.blocks[analysis.compared->second];
  const bool free_pse = frees_pse(analysis, first) || frees_pse(analysis, second);
  // A test with everything at the reference is secondary, as in the results.
  const bool is_primary = free_pse || (first.either_interval && second.either_interval);
  const std::string what = pair + ": ln ln(1 + w)";
  const std::string how =
      what + (analysis.paired ? ", paired, " : ", unpaired, Welch, ") + pse_words(free_pse);
  std::vector<PlannedName> names = {
      {how + ", without degenerate participants", !is_primary             ? kSecondary
                                                  : analysis.hierarchical ? ""
                                                                          : kStandsForPrimary},
      {how + ", with degenerate participants (half an answer added)", ""}};
  if (analysis.hierarchical) {
    names.push_back({what + " of the median person, hierarchical, " + pse_words(free_pse),
                     is_primary ? kPrimaryTest : kSecondary});
  }
  return names;
}

}  // namespace

std::vector<PlannedName> test_names(const PlannedAnalysis& analysis) {
  std::vector<PlannedName> names = pair_names(analysis);
  for (const PowerContrast& contrast : analysis.contrasts) {
    names.push_back({.name = contrast.name,
                     .meaning = contrast.meaning,
                     .alpha = contrast.alpha,
                     .of_contrast = true,
                     .is_ratio = contrast.is_ratio});
    if (!contrast.margin) continue;
    names.push_back({.name = contrast.name + ": equivalence",
                     .meaning = "two one-sided tests against the smallest effect of interest",
                     .alpha = contrast.alpha,
                     .of_contrast = true,
                     .is_ratio = contrast.is_ratio});
  }
  return names;
}

PlannedRun analyse_run(const PlannedAnalysis& analysis,
                       const std::vector<PlannedPerson>& people,
                       const std::vector<experiments::Levels>& levels) {
  std::vector<std::vector<OwnNumber>> numbers;
  for (const PlannedPerson& person : people) {
    std::vector<OwnNumber>& own = numbers.emplace_back();
    for (std::size_t block = 0; block < analysis.blocks.size(); ++block) {
      own.push_back(own_number(analysis, analysis.blocks[block], person[block]));
    }
  }
  ContrastScores scores;
  for (const PowerContrast& contrast : analysis.contrasts) {
    auto& of_contrast = scores.emplace_back();
    for (std::size_t person = 0; person < people.size(); ++person) {
      of_contrast.push_back(
          contrast_score(analysis, contrast, people[person],
                         person < levels.size() ? levels[person] : experiments::Levels{}));
    }
  }
  PlannedRun run;
  for (const int size : analysis.sizes) {
    run.sizes.push_back(SizeAnalysis(analysis, people, numbers, size).result());
    for (const PlannedTest& test :
         contrast_tests(analysis, scores, static_cast<std::size_t>(size))) {
      run.sizes.back().tests.push_back(test);
    }
  }
  for (std::size_t at = 0; analysis.sequential && at < analysis.contrasts.size(); ++at) {
    if (analysis.contrasts[at].name != analysis.sequential->contrast) continue;
    run.sequential =
        sequential_run(*analysis.sequential, scores[at], analysis.contrasts[at].groups.size());
  }
  return run;
}

}  // namespace jnd::analysis
