#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace jnd::analysis {

/// What a study file says of a block and no row of its trials does.
struct ProtocolBlock {
  int place = 0;  ///< In the file, from 0.
  /// "reminder", "yes_no", "two_interval" or "same_different"; where none stands in the file, a
  /// reminder, which magnitudes are not asked by.
  std::string task = "reminder";
  std::string interval_order = "random";  ///< Or "balanced": which interval holds the test.
  bool is_practice = false;               ///< Its trials are no data.
  bool feedback = false;          ///< Participants were told whether an answer was right.
  std::string standard_medium;    ///< "water"; "" for a block without a standard.
  std::string standard_quantity;  ///< What its reference intensities are: "scale".
  /// Of a magnitude estimation: "water_is_100", "standard" or "free".
  std::string modulus = "water_is_100";
  double modulus_value = 100.0;  ///< What the standard counts as, > 0.
};

/// The blocks of a study file by their names, those of every arm among them. What does not look
/// like a block is passed over: the reader of study files has checked it.
[[nodiscard]] std::map<std::string, ProtocolBlock> protocol_blocks(
    const nlohmann::json& protocol);

}  // namespace jnd::analysis
