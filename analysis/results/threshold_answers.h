#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "analysis/fits/psychometric_fit.h"
#include "analysis/fits/signal_detection.h"
#include "analysis/results/study_results.h"

namespace jnd::analysis {

/// One participant's answers in a block that asks whether a stimulus is felt or differs.
struct ThresholdAnswers {
  std::string participant;
  /// The reference of a same-different block; 0 otherwise.
  double reference = 0.0;
  /// The counts of "yes" or "different", without catch trials.
  std::map<double, AnswerCount> levels;
  /// The answers to catch trials, at the reference or at 0.
  AnswerCount catches;

  [[nodiscard]] std::vector<AnswerCount> rows() const;
  [[nodiscard]] std::vector<AnswerCount> rows_with_catches() const;
  /// All stimuli together against all catch trials. It is absent if either is missing.
  [[nodiscard]] std::optional<SignalDetection> signal_detection() const;
};

/// Everybody's answers. Participants without answers are added to `excluded`. A stimulus of 0,
/// or one that equals the reference in a same-different block, is a catch trial, whether or not
/// it is marked as one.
[[nodiscard]] std::vector<ThresholdAnswers> threshold_answers(
    const StudyData& data, const BlockDesign& block, bool with_excluded,
    std::vector<ExcludedParticipant>& excluded);

/// Whether a trial of the block was set aside by hand.
[[nodiscard]] bool has_trials_set_aside(const StudyData& data, const BlockDesign& block);

/// The curve of "yes" over intensity without catch trials, Phi(ln(x / threshold) / s), by
/// maximum likelihood. `corrected` adds half an answer (`with_half_an_answer`), for
/// participants whose answers have no curve.
[[nodiscard]] PsychometricFit own_detection_fit(const ThresholdAnswers& answers, bool corrected,
                                                int num_goodness, std::uint64_t seed);

}  // namespace jnd::analysis
