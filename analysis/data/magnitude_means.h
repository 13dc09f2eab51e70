#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "analysis/data/study_data.h"

namespace jnd::analysis {

/// One participant's answers at each x. Estimation: magnitudes as ratios to water, at
/// intensities. Production: the intensities that were set, at targets in percent.
using MagnitudeAnswers = std::map<double, std::vector<double>>;
/// A mean at each x.
using Means = std::map<double, double>;

/// How an answer of 0, which has no logarithm, enters an analysis of logarithms. Whatever the
/// rule, an intensity of 0 has no place on a logarithmic axis and is left out.
enum class ZeroRule {
  kHalfSmallest,  ///< As half the smallest answer above 0 of the same person in the block.
  kLeaveOut,      ///< Not at all: raises the means of weak stimuli.
};

/// One participant's answers as logarithms.
struct LogAnswers {
  MagnitudeAnswers logs;  ///< Natural logarithms, at x > 0.
  int num_zeros =
      0;  ///< MagnitudeAnswers of 0 (or less) at x > 0, to which the rule was applied.
};
[[nodiscard]] LogAnswers log_answers(const MagnitudeAnswers& answers, ZeroRule rule);

[[nodiscard]] Means means_of(const MagnitudeAnswers& answers);

/// What participants with answers in a block gave, all lists in one order, and who has none.
struct MagnitudeBlock {
  std::vector<std::string> names;
  std::vector<MagnitudeAnswers> answers;
  std::vector<Means> means;      ///< Arithmetic means over the repetitions.
  std::vector<Means> log_means;  ///< Means of the logarithms, zeros by `kHalfSmallest`.
  std::vector<Means>
      log_means_without_zeros;  ///< Means of the logarithms, zeros by `kLeaveOut`.
  int num_zeros = 0;            ///< Answers of 0, of all participants.
  std::vector<ExcludedParticipant> excluded;

  [[nodiscard]] std::size_t size() const noexcept { return names.size(); }
};

/// MagnitudeAnswers of an estimation, in percent, become ratios.
[[nodiscard]] MagnitudeBlock estimation_block(const StudyData& data, const BlockDesign& block);
[[nodiscard]] MagnitudeBlock production_block(const StudyData& data, const BlockDesign& block);

/// Leaves only those who are in both, in the order of the first.
void keep_common(MagnitudeBlock& first, MagnitudeBlock& second);

/// Those who have a mean at an x > 0: the others say nothing of a power law.
[[nodiscard]] std::vector<Means> with_mean_above_zero(const std::vector<Means>& participants);

/// Mean over the participants drawn, at each x that one of them has.
[[nodiscard]] Means group_means(const std::vector<Means>& participants,
                                const std::vector<std::size_t>& drawn);

/// Everyone's place, from 0.
[[nodiscard]] std::vector<std::size_t> everyone(std::size_t num_participants);

/// Mean of each participant's logarithms over the x > 0 that all of them have: the logarithm of
/// the unit (modulus) they counted in. Absent where they have no x in common.
[[nodiscard]] std::optional<std::vector<double>> log_moduli(const MagnitudeBlock& block);

/// Means of the participants drawn, each brought to the geometric mean of their moduli first
/// (modulus equalisation, Lane, Catania and Stevens 1961): nobody counts more for counting in
/// larger numbers.
[[nodiscard]] Means equalised_means(const std::vector<Means>& participants,
                                    const std::vector<double>& own_log_moduli,
                                    const std::vector<std::size_t>& drawn);

}  // namespace jnd::analysis
