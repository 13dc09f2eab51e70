#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/sample.h"
#include "core/streams/session_markers.h"

namespace jnd::core {

/// Turns ticks of the loop into samples of a stream: the chosen channels as float32. Not real
/// time.
class SampleStream {
 public:
  /// The hand's position, velocity and force, and the number of commands that the loop has had,
  /// which increases when a stimulus begins.
  static const std::vector<std::string>& usual_channels();

  /// `names` are names of channels or of arrays of channels, as tables of samples have them
  /// ("index_force_z_n", "position_m"), or usual ones. Empty means all usual ones. Throws
  /// `Error` for an unknown name; the message lists the names.
  explicit SampleStream(const std::vector<std::string>& names);

  [[nodiscard]] StreamInfo info(const SessionStreamFacts& facts, double rate_hz) const;
  /// `time_s` is the sample's own time.
  [[nodiscard]] StreamSample sample(const Sample& sample, double time_s) const;

 private:
  struct Channel {
    std::string name;
    /// Index among the usual channels, or -1 for a column of the table.
    int usual = -1;
    std::size_t column = 0;  ///< Index of the column in the table.
  };
  std::vector<Channel> channels_;
  bool has_columns_ = false;
};

}  // namespace jnd::core
