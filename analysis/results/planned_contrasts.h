#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "analysis/data/study_data.h"
#include "analysis/statistics/effect_test.h"
#include "analysis/statistics/sequential_test.h"
#include "experiments/procedures/contrast_conditions.h"
#include "experiments/study/design.h"

namespace jnd::analysis {

/// Whether an effect lies within the smallest effect of interest.
struct Equivalence {
  double margin = 0.0;  ///< The planned margin: a ratio > 1, or a difference > 0.
  /// The interval with confidence 1 - 2 alpha, in the unit of the effect.
  Interval interval;
  double p_value = 1.0;  ///< The larger p value of the two one-sided tests.
  bool is_shown = false;
};

/// One way to test a contrast.
struct ContrastTest {
  std::string method;
  std::optional<double> effect;  ///< A ratio or a difference; see `is_ratio`.
  Interval ci95;
  std::optional<double> statistic, degrees_of_freedom;
  std::optional<double> p_value;  ///< The p value on the planned side.
  std::string statistic_name = "t";
  int num_participants = 0;
  std::string reason{};  ///< Why there is no effect; "" if there is one.
};

/// The progress of a study that is looked at before all have taken part.
struct SequentialResult {
  std::vector<int> looks;              ///< The planned numbers of complete sessions.
  std::vector<double> nominal_levels;  ///< The nominal level of p at each look.
  int num_looks_taken = 0;
  int num_participants = 0;  ///< The number of sessions on which the last look rests.
  /// Whether the study has ended by its rule. Only then are values adjusted for the looks.
  bool ended = false;
  bool significant = false;  ///< Whether the boundary was crossed.
};

/// The result of a contrast that the study file plans.
struct ContrastResult {
  experiments::PlannedContrast plan;
  std::string hypothesis{};  ///< In the study's first language. It may be empty.
  /// For example "thin (+1)", in the order of their weights.
  std::vector<std::string> conditions;
  ContrastTest test;  ///< The primary test.
  /// Adjusted within the family. It is absent without a p value.
  std::optional<double> p_value_adjusted;
  /// Present if the plan has a smallest effect of interest.
  std::optional<Equivalence> equivalence;
  std::vector<ContrastTest> otherwise;  ///< The same contrast tested by other methods.
  /// Present for the contrast that ends the study.
  std::optional<SequentialResult> sequential{};
  std::vector<ExcludedParticipant> excluded;
  std::vector<std::string> cautions;
  std::string sentence;  ///< In the format of a journal; "" without an effect.
};

/// People's numbers in the conditions of a contrast, on scales on which people spread evenly:
/// ln ln(1 + w), ln(pse / reference), the exponent, mean ln magnitude, mean ln match, the mean
/// step of a rating, the mean answer to a question, or mean ln response time. Means of
/// magnitudes, matches and ratings are taken over the means at each stimulus, so that a lost
/// trial does not shift them. A number is absent if the person has none.
struct ConditionNumbers {
  std::vector<std::string> participants;
  std::vector<std::string> groups;  ///< The group of each participant.
  /// Indexed by participant, then by condition.
  std::vector<std::vector<std::optional<double>>> numbers;
};

/// The planned side of the test.
[[nodiscard]] Tail tail_of(const experiments::PlannedContrast& plan);
/// Converts a value from the scale of the test to the scale on which an effect is reported: a
/// logarithm becomes its ratio.
[[nodiscard]] std::optional<double> told_effect(const experiments::PlannedContrast& plan,
                                                const std::optional<double>& value);
/// The scale of people's own numbers in words, such as "ln ln(1 + w)".
[[nodiscard]] std::string own_number_words(experiments::ContrastMeasure measure);

/// Everybody's own numbers in the conditions of a contrast. Not real time.
[[nodiscard]] ConditionNumbers condition_numbers(
    const StudyData& data, const experiments::PlannedContrast& plan,
    const experiments::ContrastConditions& conditions);

/// The weighted sum of each participant's numbers.
struct OwnContrasts {
  std::vector<std::string> participants;
  /// Absent for a participant who lacks a number.
  std::vector<std::optional<PersonScore>> scores;
  /// The condition in which the participant lacks a number; "" if in none.
  std::vector<std::string> lacking;
};
[[nodiscard]] OwnContrasts own_contrasts(const ConditionNumbers& numbers,
                                         const experiments::ContrastConditions& conditions);

/// The contrasts that the study plans, each with its primary test and further tests:
///
/// - A Weber fraction or a point of subjective equality is tested by the hierarchical fit of
///   all its conditions. A further test uses people's own fits.
/// - Everything else is tested by people's own numbers. Their weighted sums are tested by
///   Student's t, or by Welch's with several groups. (For balanced answers these are the
///   contrasts of a mixed model with a slope for each person.)
///
/// p values are adjusted within their families. The contrast that ends a sequential study is
/// adjusted for its looks. Not real time.
[[nodiscard]] std::vector<ContrastResult> planned_contrasts(const StudyData& data);

}  // namespace jnd::analysis
