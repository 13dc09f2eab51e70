#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace jnd::analysis {

/// How a publication came to a number, so that the same can be made of other answers.
struct PublishedStatistic {
  enum class Kind {
    kPooledWeberFraction,  ///< Of a block, least squares, pse at the reference.
    kOwnWeberFractions,    ///< The same of everybody's own answers, summed up.
    kNumOwnAbovePooled,    ///< Those whose own is above the pooled one of another block.
    kEstimationPowerLaw,   ///< Least squares through the group's means.
    kProductionPowerLaw,
    kCombinedPowerLaw,   ///< Through both curves at the intensities that were estimated.
    kProductionRatio,    ///< Of everybody's mean set values for two targets, summed up.
    kNumbers,            ///< `PersonOutcome::numbers` of these names, summed up.
    kDifferenceOfMeans,  ///< Difference of the means of two such numbers.
  };
  enum class Summary { kMean, kStandardDeviation, kMedian };

  Kind kind = Kind::kNumbers;
  Summary summary = Summary::kMean;
  std::string block, other_block;  ///< Other: pooled, or of the production.
  bool is_exponent = false;        ///< Of a power law: a, not k.
  double high_target = 0.0, low_target = 0.0;
  std::vector<std::string> names;

  bool operator==(const PublishedStatistic&) const = default;
};

/// One published finding, for comparison alone: a number, or in words that it is above zero.
struct PublishedValue {
  std::optional<double> value;
  bool positive = false;  ///< Told as an effect of this direction, without a number.
  std::optional<double> standard_deviation;  ///< Between participants, where it was printed.
  std::string place;                         ///< Where it stands in the publication.
  std::string unit = "1";
  std::optional<int> num_decimals;  ///< Decimals that were printed.
  std::optional<int> n;             ///< Participants it rests on.
  std::string statistic;            ///< How it was computed, in words; "" if nobody said.
  std::optional<PublishedStatistic> compute;  ///< How the program computes it.
  /// It is nothing but what others come to, so it tells nothing beside all of them.
  bool follows_from_others = false;
};

/// Published values of one study, by the name of the estimate.
struct Published {
  std::string citation;
  int num_participants = 0;  ///< Of the published study; 0 if nobody said.
  std::map<std::string, PublishedValue> values;
};

/// What the files in `folder` know of the study of this name; empty if none does. Throws
/// `Error` for a file that cannot be read as published values.
[[nodiscard]] Published published_for(const std::string& study,
                                      const std::filesystem::path& folder);

}  // namespace jnd::analysis
