#include "analysis/results/trial_trends.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "analysis/results/test_families.h"
#include "analysis/results/threshold_results.h"
#include "analysis/words/said.h"
#include "core/psychometric_function.h"
#include "core/random_stream.h"
#include "core/require.h"

namespace jnd::analysis {
namespace {

/// Squared z. They are absent if the answers do not vary within any level.
struct Squares {
  std::optional<double> drift, learning;
};

/// One person's trials, prepared for repeated redraws.
class Person {
 public:
  explicit Person(const DiscriminationAnswers& answers) {
    const double num = static_cast<double>(answers.in_order.size());
    std::map<double, std::size_t> places;
    double first = 0.0, last = 0.0;
    for (const OrderedAnswers& row : answers.in_order) {
      const double time = row.trial.value_or(0.0);
      first = trials_.empty() ? time : std::min(first, time);
      last = trials_.empty() ? time : std::max(last, time);
      const auto [place, is_new] = places.try_emplace(row.intensity, levels_.size());
      if (is_new) {
        levels_.emplace_back();
        levels_.back().side = row.intensity > answers.reference   ? 1.0
                              : row.intensity < answers.reference ? -1.0
                                                                  : 0.0;
      }
      Level& level = levels_[place->second];
      ++level.num;
      level.mean_time += time;
      trials_.push_back({.level = place->second, .time = time, .yes = row.num_yes > 0.5});
    }
    for (Level& level : levels_) level.mean_time /= level.num;
    const double range = num > 1.0 && last > first ? last - first : 1.0;
    for (Trial& trial : trials_) {
      Level& level = levels_[trial.level];
      trial.time = (trial.time - level.mean_time) / range;
      level.squares += trial.time * trial.time;
    }
    fill_probabilities(answers);
  }

  [[nodiscard]] Squares observed() {
    for (Level& level : levels_) level.num_yes = level.covariance = 0.0;
    for (const Trial& trial : trials_) answer(trial, trial.yes);
    return squares();
  }

  /// Redraws until every value that is defined in the data is defined.
  [[nodiscard]] Squares redrawn(core::RandomStream& random, const Squares& observed) {
    // A person whose answers varied does so again within a few draws.
    constexpr int kMostDraws = 1000;
    Squares found;
    for (int draw = 0; draw < kMostDraws; ++draw) {
      for (Level& level : levels_) level.num_yes = level.covariance = 0.0;
      for (const Trial& trial : trials_) {
        answer(trial, random.with_probability(trial.probability));
      }
      found = squares();
      if (found.drift.has_value() >= observed.drift.has_value() &&
          found.learning.has_value() >= observed.learning.has_value()) {
        break;
      }
    }
    return found;
  }

 private:
  struct Level {
    double side = 0.0;  ///< 1 above the reference, -1 below.
    double num = 0.0, mean_time = 0.0, squares = 0.0;
    double num_yes = 0.0, covariance = 0.0;  ///< These belong to the present answers.
  };
  struct Trial {
    std::size_t level = 0;
    /// The time minus the mean of its level, on a scale on which the last trial is 1 after the
    /// first.
    double time = 0.0;
    bool yes = false;
    double probability = 0.0;
  };

  void fill_probabilities(const DiscriminationAnswers& answers) {
    const PsychometricFit fit = own_fit(answers, {.free_pse = true});
    for (std::size_t i = 0; i < trials_.size(); ++i) {
      const OrderedAnswers& row = answers.in_order[i];
      if (fit.weber_fraction && fit.pse) {
        const double order = !row.test_first ? 0.0 : *row.test_first ? kTestFirst : kTestSecond;
        const double shift = fit.order_effect_ln.value_or(0.0) * order;
        const core::PsychometricFunction curve(
            {.pse = *fit.pse * std::exp(shift), .weber_fraction = *fit.weber_fraction});
        trials_[i].probability = curve.probability(row.intensity);
      } else {
        const AnswerCount& level = answers.levels.at(row.intensity);
        trials_[i].probability = (static_cast<double>(level.num_yes) + 0.5) /
                                 (static_cast<double>(level.num_trials) + 1.0);
      }
    }
  }

  void answer(const Trial& trial, bool yes) {
    if (!yes) return;
    Level& level = levels_[trial.level];
    ++level.num_yes;
    level.covariance += trial.time;
  }

  [[nodiscard]] Squares squares() const {
    double drift = 0.0, learning = 0.0, drift_variance = 0.0, learning_variance = 0.0;
    for (const Level& level : levels_) {
      if (level.num < 2.0) continue;
      const double of_answers = level.num_yes - level.num_yes * level.num_yes / level.num;
      const double variance = of_answers * level.squares / (level.num - 1.0);
      drift += level.covariance;
      drift_variance += variance;
      learning += level.side * level.covariance;
      learning_variance += std::fabs(level.side) * variance;
    }
    Squares result;
    if (drift_variance > 0.0) result.drift = drift * drift / drift_variance;
    if (learning_variance > 0.0) result.learning = learning * learning / learning_variance;
    return result;
  }

  std::vector<Level> levels_;
  std::vector<Trial> trials_;
};

std::string more_or_less(const std::string& block, const std::string& what) {
  return said(
      "{}: {} over the trials, each in their own way, exploratory (sum of participants' z^2)",
      block, what);
}

Comparison comparison_of(const TrendDispersion& found, int num_redraws) {
  Comparison result{
      .status = FitStatus::kDegenerate,
      .kind = Comparison::Kind::kDispersion,
      .reason = said("no answers vary within a level"),
      .method = said("sum of squared z, p by parametric bootstrap ({} redraws, one-sided)",
                     std::to_string(num_redraws))};
  if (found.num_people == 0) return result;
  result.status = FitStatus::kOk;
  result.reason = "";
  result.estimate = found.sum_squares / found.num_people;
  result.statistic = found.sum_squares;
  result.statistic_name = said("sum of z^2");
  result.degrees_of_freedom = found.num_people;
  result.p_value = found.p_value;
  result.num_a = found.num_people;
  return result;
}

}  // namespace

TrendDispersions trend_dispersions(const std::vector<DiscriminationAnswers>& all,
                                   int num_redraws, std::uint64_t seed) {
  core::require(num_redraws >= 1, "num_redraws", "a number >= 1", num_redraws);
  TrendDispersions result;
  std::vector<double> drift(static_cast<std::size_t>(num_redraws)), learning = drift;
  const auto add = [](TrendDispersion& sum, const std::optional<double>& square) {
    if (!square) return;
    ++sum.num_people;
    sum.sum_squares += *square;
  };
  for (std::size_t i = 0; i < all.size(); ++i) {
    Person person(all[i]);
    const Squares observed = person.observed();
    if (!observed.drift) continue;  // Learning is then not defined either.
    add(result.drift, observed.drift);
    add(result.learning, observed.learning);
    core::RandomStream random(seed, said("trial trends"), {static_cast<std::int64_t>(i)});
    for (std::size_t redraw = 0; redraw < drift.size(); ++redraw) {
      const Squares redrawn = person.redrawn(random, observed);
      drift[redraw] += redrawn.drift.value_or(0.0);
      if (observed.learning) learning[redraw] += redrawn.learning.value_or(0.0);
    }
  }
  const auto share_of = [&](const std::vector<double>& sums, double observed) {
    // Sums of the same answers may differ in their last bits.
    const double least = observed * (1.0 - 1e-12);
    const auto num = std::ranges::count_if(sums, [&](double sum) { return sum >= least; });
    return (1.0 + static_cast<double>(num)) / (1.0 + num_redraws);
  };
  result.drift.p_value = share_of(drift, result.drift.sum_squares);
  result.learning.p_value = share_of(learning, result.learning.sum_squares);
  return result;
}

void add_trial_trends(ResultsSection& section, const std::vector<DiscriminationAnswers>& all,
                      const BlockDesign& block, const ResultsOptions& options) {
  if (block.is_adaptive()) {
    section.excluded.push_back(
        {"everyone",
         said("{}: no tests of changes over the trials, for the answers led to the levels, so "
              "that not every order of them within a level was as likely",
              block.block)});
    return;
  }
  std::vector<double> drift, learning;
  for (const DiscriminationAnswers& one : all) {
    const TrialTrend trend = trial_trend(one.in_order, one.reference);
    if (trend.drift) drift.push_back(*trend.drift);
    if (trend.learning) learning.push_back(*trend.learning);
  }
  const int num_redraws = std::max(1, options.num_resamples);
  const TrendDispersions dispersions = trend_dispersions(all, num_redraws, options.seed);
  const auto add = [&](const std::string& name, Comparison comparison) {
    section.comparisons.push_back(
        {.name = name, .comparison = std::move(comparison), .family = kTrialTrendsFamily});
  };
  add(said("{}: the test is called \"more\" more often over the trials, exploratory (mean of "
           "participants' z)",
           block.block),
      one_sample_t_test(drift));
  add(more_or_less(block.block, said("the test is called \"more\" more or less often")),
      comparison_of(dispersions.drift, num_redraws));
  add(said("{}: right answers become more frequent over the trials, exploratory (mean of "
           "participants' z)",
           block.block),
      one_sample_t_test(learning));
  add(more_or_less(block.block, said("right answers become more or less frequent")),
      comparison_of(dispersions.learning, num_redraws));
}

}  // namespace jnd::analysis
