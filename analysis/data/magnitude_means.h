#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "analysis/data/study_data.h"

namespace jnd::analysis {

/// One participant's answers at each x. For an estimation these are magnitudes, as ratios to
/// water, at intensities. For a production they are the intensities that were set, at targets
/// in percent.
using MagnitudeAnswers = std::map<double, std::vector<double>>;
/// A mean at each x.
using Means = std::map<double, double>;

/// How an answer of 0, which has no logarithm, enters an analysis of logarithms. With every
/// rule an intensity of 0 is left out, because it has no place on a logarithmic axis.
enum class ZeroRule {
  /// It counts as half the smallest answer above 0 of the same person in the block.
  kHalfSmallest,
  kLeaveOut,  ///< It is left out, which raises the means of weak stimuli.
};

/// One participant's answers as logarithms.
struct LogAnswers {
  MagnitudeAnswers logs;  ///< Natural logarithms at x > 0.
  int num_zeros =
      0;  ///< The number of answers of 0 (or less) at x > 0, to which the rule was applied.
};
[[nodiscard]] LogAnswers log_answers(const MagnitudeAnswers& answers, ZeroRule rule);

[[nodiscard]] Means means_of(const MagnitudeAnswers& answers);

/// The answers of the participants in a block, with all lists in one order, and the
/// participants without answers.
struct MagnitudeBlock {
  std::vector<std::string> names;
  std::vector<MagnitudeAnswers> answers;
  std::vector<Means> means;      ///< Arithmetic means over the repetitions.
  std::vector<Means> log_means;  ///< Means of the logarithms, with zeros by `kHalfSmallest`.
  std::vector<Means>
      log_means_without_zeros;  ///< Means of the logarithms, with zeros by `kLeaveOut`.
  int num_zeros = 0;            ///< The number of answers of 0 over all participants.
  std::vector<ExcludedParticipant> excluded;

  [[nodiscard]] std::size_t size() const noexcept { return names.size(); }
};

/// The answers of an estimation, which are in percent, become ratios.
[[nodiscard]] MagnitudeBlock estimation_block(const StudyData& data, const BlockDesign& block);
[[nodiscard]] MagnitudeBlock production_block(const StudyData& data, const BlockDesign& block);

/// Keeps only the participants who are in both, in the order of the first.
void keep_common(MagnitudeBlock& first, MagnitudeBlock& second);

/// The participants who have a mean at an x > 0. The others tell nothing about a power law.
[[nodiscard]] std::vector<Means> with_mean_above_zero(const std::vector<Means>& participants);

/// The mean over the drawn participants, at each x that one of them has.
[[nodiscard]] Means group_means(const std::vector<Means>& participants,
                                const std::vector<std::size_t>& drawn);

/// The indices of all participants, from 0.
[[nodiscard]] std::vector<std::size_t> everyone(std::size_t num_participants);

/// The mean of each participant's logarithms over the x > 0 that all of them have, which is the
/// logarithm of the participant's unit (modulus). It is absent if they have no common x.
[[nodiscard]] std::optional<std::vector<double>> log_moduli(const MagnitudeBlock& block);

/// The means of the drawn participants, after each participant's answers are scaled to the
/// geometric mean of their moduli (modulus equalisation, Lane, Catania and Stevens 1961). So
/// nobody has more weight because of larger numbers.
[[nodiscard]] Means equalised_means(const std::vector<Means>& participants,
                                    const std::vector<double>& own_log_moduli,
                                    const std::vector<std::size_t>& drawn);

}  // namespace jnd::analysis
