#pragma once

#include <string>
#include <vector>

#include "analysis/results/discrimination_answers.h"

namespace jnd::analysis {

/// One participant's own Weber fraction in a block, and the range `at_least` to `at_most` in
/// which the stimuli show it to lie.
struct OwnFraction {
  std::string participant;
  /// The Weber fraction of the fit; absent if there is no fit.
  std::optional<double> weber_fraction;
  std::string reason;  ///< Why there is no fit.
  /// Without a fit: the fraction with half an answer added.
  std::optional<double> mended;
  /// Both equal the fraction of the fit if that lies within the stimuli of the block. Fractions
  /// above that of the largest stimulus cannot be distinguished: `at_least` is then that of the
  /// largest stimulus, and `at_most` is infinite. This includes flat and inverted answers. For
  /// perfectly separated answers the range is 0 to `mended`.
  double at_least = 0.0, at_most = 0.0;

  [[nodiscard]] bool is_beyond_stimuli() const;
};

/// Everybody's own fractions in one block, in the order of the answers.
struct OwnFractions {
  std::vector<OwnFraction> people;
  /// The fraction of the block's largest stimulus over all participants.
  double largest = 0.0;
  [[nodiscard]] int num_beyond() const;
};

/// The options `corrected`, `intervals` and `num_goodness` are ignored. With least squares as
/// `method` and the pse at the reference, these are the fractions of which Schmidt (2018)
/// reports the mean and standard deviation.
[[nodiscard]] OwnFractions own_fractions(const std::vector<DiscriminationAnswers>& all,
                                         const OwnFitOptions& options);

/// For example "group_d: no Weber fraction of their own with a free pse, ", to which the reason
/// is appended.
[[nodiscard]] std::string without_words(const std::string& block, bool free_pse);

/// The range of a statistic of the fractions. It is a single number if the stimuli determine
/// it.
struct CensoredValue {
  double at_least = 0.0, at_most = 0.0;
  [[nodiscard]] std::optional<double> value() const;
};

/// The quantile (type 7) of the people at these indices, with 0 <= probability <= 1.
[[nodiscard]] CensoredValue own_fraction_quantile(const OwnFractions& fractions,
                                                  const std::vector<std::size_t>& places,
                                                  double probability);
/// The interquartile range divided by 1.349, which is the standard deviation of normal values.
/// It needs at least two people.
[[nodiscard]] CensoredValue own_fraction_spread(const OwnFractions& fractions,
                                                const std::vector<std::size_t>& places);

/// Adds median, robust spread, the number of people beyond the stimuli and, if there are none,
/// the plain mean and standard deviation. They are called BLOCK.individual_weber_fraction_NAME
/// and use the pse of the block's primary value. The same values with the other pse are called
/// NAME_at_reference or NAME_free_pse. People beyond the stimuli count as beyond, so a median
/// or an end of an interval among them is open. Names the people who have no fraction with the
/// pse of the primary value.
void add_individual_fractions(ResultsSection& section,
                              const std::vector<DiscriminationAnswers>& all,
                              const BlockDesign& block, const ResultsOptions& options);

}  // namespace jnd::analysis
