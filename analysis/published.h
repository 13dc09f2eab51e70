#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

namespace jnd::analysis {

/// One published finding, for comparison alone: a number, or in words that it is above zero.
struct PublishedValue {
  std::optional<double> value;
  bool positive = false;  ///< Told as an effect of this direction, without a number.
  std::optional<double> standard_deviation;  ///< Between participants, where it was printed.
  std::string place;                         ///< Where it stands in the publication.
};

/// Published values of one study, by the name of the estimate.
struct Published {
  std::string citation;
  std::map<std::string, PublishedValue> values;
};

/// What the files in `folder` know of the study of this name; empty if none does. Throws
/// `Error` for a file that cannot be read as published values.
[[nodiscard]] Published published_for(const std::string& study,
                                      const std::filesystem::path& folder);

}  // namespace jnd::analysis
