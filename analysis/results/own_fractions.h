#pragma once

#include <string>
#include <vector>

#include "analysis/results/discrimination_answers.h"

namespace jnd::analysis {

/// One participant's own Weber fraction in a block, and what the stimuli can tell of it: it
/// lies between `at_least` and `at_most`.
struct OwnFraction {
  std::string participant;
  std::optional<double> weber_fraction;  ///< Of the fit; absent where there is none.
  std::string reason;                    ///< Of the fit, why there is none.
  std::optional<double> mended;          ///< Where there is none: with half an answer added.
  /// Both are the fraction of the fit where that lies within the stimuli of the block. Above
  /// the largest nothing can be told from anything else: `at_least` is that, `at_most`
  /// infinite, also of flat and inverted answers. Perfectly separated ones lie between 0 and
  /// `mended`.
  double at_least = 0.0, at_most = 0.0;

  [[nodiscard]] bool is_beyond_stimuli() const;
};

/// Everybody's own fractions of one block, in the order of the answers.
struct OwnFractions {
  std::vector<OwnFraction> people;
  double largest = 0.0;  ///< That of the block's largest stimulus, of whomever.
  [[nodiscard]] int num_beyond() const;
};

/// Of these options `corrected`, `intervals` and `num_goodness` are not looked at. With
/// `method` least squares and a pse at the reference they are what Schmidt (2018) took the mean
/// and the standard deviation of.
[[nodiscard]] OwnFractions own_fractions(const std::vector<DiscriminationAnswers>& all,
                                         const OwnFitOptions& options);

/// "group_d: no Weber fraction of their own with a free pse, ": then follows the reason.
[[nodiscard]] std::string without_words(const std::string& block, bool free_pse);

/// The range that a statistic of the fractions lies in: one number where the stimuli tell it.
struct CensoredValue {
  double at_least = 0.0, at_most = 0.0;
  [[nodiscard]] std::optional<double> value() const;
};

/// The quantile (type 7) of those at these places, 0 <= probability <= 1.
[[nodiscard]] CensoredValue own_fraction_quantile(const OwnFractions& fractions,
                                                  const std::vector<std::size_t>& places,
                                                  double probability);
/// Interquartile range / 1.349, the standard deviation of normal values; at least two people.
[[nodiscard]] CensoredValue own_fraction_spread(const OwnFractions& fractions,
                                                const std::vector<std::size_t>& places);

/// Adds median, robust spread, how many lie beyond the stimuli, and the plain mean and standard
/// deviation where nobody does, as BLOCK.individual_weber_fraction_NAME with the pse of the
/// block's primary value; then the same with the other pse, NAME_at_reference or NAME_free_pse.
/// Who lies beyond the stimuli counts as beyond: a median or an end of an interval that is
/// among them is open. Names who has no fraction with the pse of the primary value.
void add_individual_fractions(ResultsSection& section,
                              const std::vector<DiscriminationAnswers>& all,
                              const BlockDesign& block, const ResultsOptions& options);

}  // namespace jnd::analysis
