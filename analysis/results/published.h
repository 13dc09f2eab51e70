#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace jnd::analysis {

/// How a publication computed a number, so that the program can compute it from other answers.
struct PublishedStatistic {
  enum class Kind {
    /// The pooled Weber fraction of a block, by least squares with the pse at the reference.
    kPooledWeberFraction,
    /// A summary of everybody's own fractions, computed in the same way.
    kOwnWeberFractions,
    /// The number of people whose own fraction is above the pooled one of another block.
    kNumOwnAbovePooled,
    kEstimationPowerLaw,  ///< Least squares through the group's means.
    kProductionPowerLaw,
    kCombinedPowerLaw,  ///< The law through both curves at the intensities of the estimation.
    /// A summary of the ratios of everybody's mean set values for two targets.
    kProductionRatio,
    kNumbers,            ///< A summary of the `PersonOutcome::numbers` with these names.
    kDifferenceOfMeans,  ///< The difference of the means of two such numbers.
  };
  enum class Summary { kMean, kStandardDeviation, kMedian };

  Kind kind = Kind::kNumbers;
  Summary summary = Summary::kMean;
  /// The other block is that of the pooled fraction, or of the production.
  std::string block, other_block;
  bool is_exponent = false;  ///< For a power law: whether the number is a, not k.
  double high_target = 0.0, low_target = 0.0;
  std::vector<std::string> names;

  bool operator==(const PublishedStatistic&) const = default;
};

/// One published finding, used only for comparison. It is a number, or a statement that an
/// effect is above zero.
struct PublishedValue {
  std::optional<double> value;
  bool positive = false;  ///< Whether it is reported as a positive effect without a number.
  /// The standard deviation between participants, if it was printed.
  std::optional<double> standard_deviation;
  std::string place;  ///< The place in the publication.
  std::string unit = "1";
  std::optional<int> num_decimals;  ///< The number of decimals that were printed.
  std::optional<int> n;             ///< The number of participants on which it rests.
  /// How it was computed, in words; "" if the publication does not say.
  std::string statistic;
  std::optional<PublishedStatistic> compute;  ///< How the program computes it.
  /// Whether it follows from other values, so that it adds no information to them.
  bool follows_from_others = false;
};

/// The published values of one study, by the name of the estimate.
struct Published {
  std::string citation;
  /// The number of participants of the published study; 0 if unknown.
  int num_participants = 0;
  std::map<std::string, PublishedValue> values;
};

/// The published values that files in `folder` hold for the study of this name; empty if there
/// are none. Throws `Error` for a file that does not contain valid published values.
[[nodiscard]] Published published_for(const std::string& study,
                                      const std::filesystem::path& folder);

}  // namespace jnd::analysis
