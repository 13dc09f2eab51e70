#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "analysis/fits/psychometric_fit.h"
#include "analysis/fits/signal_detection.h"
#include "analysis/results/study_results.h"

namespace jnd::analysis {

/// One participant's answers in a block that asks whether a stimulus is felt, or differs.
struct ThresholdAnswers {
  std::string participant;
  double reference = 0.0;                ///< Of a same-different block; else 0.
  std::map<double, AnswerCount> levels;  ///< Without catch trials; "yes", or "different".
  AnswerCount catches;                   ///< Of catch trials, at the reference or at 0.

  [[nodiscard]] std::vector<AnswerCount> rows() const;
  [[nodiscard]] std::vector<AnswerCount> rows_with_catches() const;
  /// Of all stimuli against all catch trials; none without either.
  [[nodiscard]] std::optional<SignalDetection> signal_detection() const;
};

/// Everybody's answers; who has none is named. A stimulus of 0, or one that is the reference
/// in a same-different block, is a catch trial whether marked so or not.
[[nodiscard]] std::vector<ThresholdAnswers> threshold_answers(
    const StudyData& data, const BlockDesign& block, bool with_excluded,
    std::vector<ExcludedParticipant>& excluded);

/// Whether a trial of the block was set aside by hand.
[[nodiscard]] bool has_trials_set_aside(const StudyData& data, const BlockDesign& block);

/// The curve of "yes" over intensity without regard to catch trials: Phi(ln(x / threshold) / s)
/// by maximum likelihood. `corrected`: with half an answer added (`with_half_an_answer`), for
/// those whose answers have no curve.
[[nodiscard]] PsychometricFit own_detection_fit(const ThresholdAnswers& answers, bool corrected,
                                                int num_goodness, std::uint64_t seed);

}  // namespace jnd::analysis
