#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/sample.h"
#include "core/streams/session_markers.h"

namespace jnd::core {

/// Ticks of the loop as samples of a stream: the chosen channels as float32. Not real time.
class SampleStream {
 public:
  /// The hand's position, velocity and force, and how many commands the loop has had: where it
  /// rises, a stimulus begins.
  static const std::vector<std::string>& usual_channels();

  /// Names of channels or arrays of them, as tables of samples have them ("index_force_z_n",
  /// "position_m"), or the usual ones. Empty: all of those. Throws `Error` naming what there is
  /// for a name that is none.
  explicit SampleStream(const std::vector<std::string>& names);

  [[nodiscard]] StreamInfo info(const SessionStreamFacts& facts, double rate_hz) const;
  /// `time_s` is the sample's own.
  [[nodiscard]] StreamSample sample(const Sample& sample, double time_s) const;

 private:
  struct Channel {
    std::string name;
    int usual = -1;          ///< Place among the usual ones; -1: a column of the table.
    std::size_t column = 0;  ///< Of the table.
  };
  std::vector<Channel> channels_;
  bool has_columns_ = false;
};

}  // namespace jnd::core
