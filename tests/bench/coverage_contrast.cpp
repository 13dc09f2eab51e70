#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include "analysis/hierarchical/hierarchical_contrast.h"
#include "analysis/results/discrimination_answers.h"
#include "analysis/statistics/effect_test.h"
#include "bench/coverage_people.h"

namespace jnd::coverage {
namespace {

/// The conditions with their Weber fractions, and the weights of a contrast of the logarithms
/// of these.
struct Design {
  std::string words;
  std::vector<double> weber_fractions;  ///< One value for each condition.
  std::vector<double> weights;          ///< One value for each condition that a person meets.
  bool has_groups = false;  ///< If true, other people do the second half of the conditions.
  int num_people = 13;      ///< The number of people in each group.
  double own_ln = 0.2;      ///< The sd of each person's own deviation in each condition.
};

/// Counts how often a test was significant, and how often its interval held the true value.
struct Count {
  Coverage coverage;
  int num_significant = 0, num_equivalent = 0, num_tests = 0;

  void add(const std::optional<EffectEstimate>& estimate, double truth) {
    coverage.add(estimate.has_value(), estimate ? interval_of(*estimate, 0.95) : Interval{},
                 truth);
    if (!estimate) return;
    ++num_tests;
    num_significant += p_value_of(*estimate, Tail::kTwoSided) < 0.05 ? 1 : 0;
    // An effect that is as large as the margin is not smaller than the margin.
    if (truth != 0.0) {
      num_equivalent += equivalence_p_value(*estimate, std::abs(truth)) < 0.05 ? 1 : 0;
    }
  }
  [[nodiscard]] std::string significant() const { return share(num_significant); }
  [[nodiscard]] std::string equivalent(double truth) const {
    return truth == 0.0 ? "-" : share(num_equivalent);
  }

 private:
  [[nodiscard]] std::string share(int num) const {
    if (num_tests == 0) return "-";
    char text[32];
    std::snprintf(text, sizeof text, "%.1f %%", 100.0 * num / num_tests);
    return text;
  }
};

std::string cover_design(const Design& design, int num_sets, std::uint64_t seed) {
  const std::size_t num_conditions = design.weber_fractions.size();
  const std::size_t num_met = design.has_groups ? num_conditions / 2 : num_conditions;
  double truth = 0.0, own_truth = 0.0;
  for (std::size_t i = 0; i < num_conditions; ++i) {
    truth += design.weights[i] * std::log(design.weber_fractions[i]);
    own_truth += design.weights[i] * std::log(std::log1p(design.weber_fractions[i]));
  }
  if (std::abs(truth) < 1e-12) truth = own_truth = 0.0;
  RandomStream random(seed, "coverage of a contrast " + design.words);
  Count hierarchical, own;
  for (int set = 0; set < num_sets; ++set) {
    std::vector<ParticipantAnswers> answers;
    std::map<std::string, double> weights;
    std::map<std::string, int> groups;
    std::map<int, int> num_people;
    std::vector<std::vector<double>> scores(design.has_groups ? 2 : 1);
    for (std::size_t group = 0; group < scores.size(); ++group) {
      num_people[static_cast<int>(group)] = design.num_people;
      for (int number = 0; number < design.num_people; ++number) {
        const std::string name = "P" + std::to_string(group) + "_" + std::to_string(number);
        groups[name] = static_cast<int>(group);
        const double slope_z = random.normal();
        double score = 0.0;
        bool is_whole = true;
        for (std::size_t met = 0; met < num_met; ++met) {
          const std::size_t condition = group * num_met + met;
          Person drawn = Population{.weber_fraction = design.weber_fractions[condition],
                                    .spread_ln = 0.3,
                                    .place_sd_ln = 0.15}
                             .person(slope_z, random.normal());
          drawn.slope *= std::exp(design.own_ln * random.normal());
          const std::vector<AnswerCount> rows = answers_of(drawn, kHardLevels, 8, random);
          const std::string words = "c" + std::to_string(condition);
          weights[words] = design.weights[condition];
          answers.push_back({name, words, kHardLevels.reference, rows});
          const auto value = own_number(rows);
          is_whole &= value.has_value();
          score += design.weights[condition] * value.value_or(0.0);
        }
        if (is_whole) scores[group].push_back(score);
      }
    }
    own.add(contrast_estimate(scores), own_truth);
    const bool is_pair = num_conditions == 2 && !design.has_groups;
    const HierarchicalFit fit = fit_hierarchical(
        answers,
        {.slopes = is_pair ? HierarchicalSlopes::kCorrelated : HierarchicalSlopes::kShared,
         .lapse_profile = false});
    hierarchical.add(hierarchical_contrast(fit, HierarchicalLink::kLogSlope,
                                           HierarchicalNumber::kLogWeberFraction, weights,
                                           groups, num_people),
                     truth);
  }
  char effect[32];
  std::snprintf(effect, sizeof effect, "%.2f", std::exp(truth));
  return row_of({design.words, std::to_string(design.num_people), effect,
                 hierarchical.coverage.words(), hierarchical.significant(),
                 hierarchical.equivalent(truth), own.coverage.words(), own.significant(),
                 own.equivalent(own_truth), std::to_string(hierarchical.coverage.num_without)});
}

}  // namespace

std::optional<double> own_number(const std::vector<AnswerCount>& rows) {
  for (const bool corrected : {false, true}) {
    const PsychometricFit fit = fit_psychometric(corrected ? with_half_an_answer(rows) : rows,
                                                 {.reference = kHardLevels.reference,
                                                  .free_pse = true,
                                                  .intervals = false,
                                                  .solver = Solver::kNewton});
    if (!fit.weber_fraction) continue;
    const double number = std::log(std::log1p(*fit.weber_fraction));
    if (std::isfinite(number)) return number;
  }
  return std::nullopt;
}

void cover_contrasts(int num_sets, std::uint64_t seed) {
  std::printf(
      "\n## Planned contrasts: ratios of Weber fractions\n\n"
      "%d studies a row, eight answers at each of eight levels (hard). People differ by 0.3 in "
      "ln in all conditions alike, by 0.2 in\neach alone, and their pse by 0.15 in each. By "
      "the "
      "hierarchical fit, and by people's own fits in ln ln(1 + w): coverage\nof the 95 %% "
      "interval; how often p < 0.05, which at the ratio 1 should be 5 %%; and how often "
      "equivalence is shown though\nthe margin is no larger than the effect, which should be "
      "at "
      "most 5 %%. n: in each group.\n\n",
      num_sets);
  print_row({"contrast", "n", "ratio", "hierarchical", "p < 0.05", "equivalent", "own fits",
             "p < 0.05", "equivalent", "without"});
  std::printf("| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n");
  const std::vector<double> main = {0.5, 0.5, -0.5, -0.5}, both = {1.0, -1.0, -1.0, 1.0};
  std::vector<std::function<std::string()>> rows;
  for (const Design& design : {
           Design{.words = "two conditions, nothing differs",
          .weber_fractions = {0.5, 0.5},
          .weights = {1.0, -1.0}},
           Design{.words = "two conditions",
           .weber_fractions = {0.6, 0.4},
           .weights = {1.0, -1.0}},
           Design{.words = "2 x 2 within, main effect, nothing differs",
           .weber_fractions = {0.5, 0.5, 0.5, 0.5},
           .weights = main},
           Design{.words = "2 x 2 within, main effect",
           .weber_fractions = {0.6, 0.6, 0.4, 0.4},
           .weights = main},
           Design{.words = "2 x 2 within, interaction, nothing differs",
           .weber_fractions = {0.5, 0.5, 0.5, 0.5},
           .weights = both},
           Design{.words = "2 x 2 within, interaction beside main effects",
           .weber_fractions = {0.6, 0.4, 0.4, 0.4},
           .weights = both},
           Design{.words = "2 x 2, one between, interaction, nothing differs",
           .weber_fractions = {0.5, 0.5, 0.5, 0.5},
           .weights = both,
           .has_groups = true},
           Design{.words = "2 x 2, one between, main effect between",
           .weber_fractions = {0.6, 0.6, 0.4, 0.4},
           .weights = main,
           .has_groups = true},
           Design{.words = "2 x 2, one between, main effect between, nothing differs, few",
           .weber_fractions = {0.5, 0.5, 0.5, 0.5},
           .weights = main,
           .has_groups = true,
           .num_people = 6},
       }) {
    rows.emplace_back(
        [design, num_sets, seed] { return cover_design(design, num_sets, seed); });
  }
  print_rows(rows);
}

}  // namespace jnd::coverage
