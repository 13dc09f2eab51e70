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

/// Whether an effect lies within the smallest that is of interest.
struct Equivalence {
  double margin = 0.0;   ///< As planned: a ratio > 1, or a difference > 0.
  Interval interval;     ///< With the confidence 1 - 2 alpha, in the unit of the effect.
  double p_value = 1.0;  ///< The larger of both one-sided tests'.
  bool is_shown = false;
};

/// One way to test a contrast.
struct ContrastTest {
  std::string method;
  std::optional<double> effect;  ///< A ratio, or a difference; see `is_ratio`.
  Interval ci95;
  std::optional<double> statistic, degrees_of_freedom;
  std::optional<double> p_value;  ///< On the side that was planned.
  std::string statistic_name = "t";
  int num_participants = 0;
  std::string reason{};  ///< Why there is no effect; "" if there is one.
};

/// How far a study has come that is looked at before all have taken part.
struct SequentialResult {
  std::vector<int> looks;              ///< Numbers of complete sessions, as planned.
  std::vector<double> nominal_levels;  ///< Of p at each of them.
  int num_looks_taken = 0;
  int num_participants = 0;  ///< Sessions that the last look taken rests on.
  bool ended = false;        ///< By its rule; only then values are adjusted for the looks.
  bool significant = false;  ///< The boundary was crossed.
};

/// What came of a contrast that the study file plans.
struct ContrastResult {
  experiments::PlannedContrast plan;
  std::string hypothesis{};                ///< In the study's first language; may be empty.
  std::vector<std::string> conditions;     ///< "thin (+1)", in the order of their weights.
  ContrastTest test;                       ///< The answer.
  std::optional<double> p_value_adjusted;  ///< Within the family; absent without a p value.
  std::optional<Equivalence> equivalence;  ///< Of a plan with a smallest effect.
  std::vector<ContrastTest> otherwise;     ///< The same by other means.
  std::optional<SequentialResult> sequential{};  ///< Of the contrast that ends the study.
  std::vector<ExcludedParticipant> excluded;
  std::vector<std::string> cautions;
  std::string sentence;  ///< As a journal prints it; "" without an effect.
};

/// A person's number in one condition, where people spread evenly: ln ln(1 + w), ln(pse /
/// reference), the exponent, mean ln magnitude, mean ln match, the mean step of a rating, the
/// mean answer to a question, mean ln response time. Means of magnitudes, matches and ratings
/// are over the means at each stimulus, so that a lost trial does not move them. Absent where
/// the person has none.
struct ConditionNumbers {
  std::vector<std::string> participants;
  std::vector<std::string> groups;  ///< Of each participant.
  /// By participant, then by condition.
  std::vector<std::vector<std::optional<double>>> numbers;
};

/// The side of the test that was planned.
[[nodiscard]] Tail tail_of(const experiments::PlannedContrast& plan);
/// From the scale on which an effect is tested to that in which it is told: of a logarithm its
/// ratio.
[[nodiscard]] std::optional<double> told_effect(const experiments::PlannedContrast& plan,
                                                const std::optional<double>& value);
/// What people's own numbers are: "ln ln(1 + w)".
[[nodiscard]] std::string own_number_words(experiments::ContrastMeasure measure);

/// Everybody's own numbers in the conditions of a contrast. Not real time.
[[nodiscard]] ConditionNumbers condition_numbers(
    const StudyData& data, const experiments::PlannedContrast& plan,
    const experiments::ContrastConditions& conditions);

/// Everybody's weighted sum of their numbers, by participant.
struct OwnContrasts {
  std::vector<std::string> participants;
  std::vector<std::optional<PersonScore>> scores;  ///< None of who lacks a number,
  std::vector<std::string> lacking;                ///< in this condition; else "".
};
[[nodiscard]] OwnContrasts own_contrasts(const ConditionNumbers& numbers,
                                         const experiments::ContrastConditions& conditions);

/// The contrasts that the study plans, each by its answer and otherwise:
/// - a Weber fraction or a point of subjective equality by the hierarchical fit of all of its
///   conditions, otherwise by people's own fits;
/// - everything else by people's own numbers, whose weighted sums are tested by Student's t, in
///   several groups by Welch's (of balanced answers these are the contrasts of a mixed model
///   with a slope of every person).
/// p values are adjusted in their families; the contrast that ends a sequential study, for its
/// looks. Not real time.
[[nodiscard]] std::vector<ContrastResult> planned_contrasts(const StudyData& data);

}  // namespace jnd::analysis
