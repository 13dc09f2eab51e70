#pragma once

#include <string>
#include <vector>

#include "core/sample.h"

namespace jnd::core {

/// Columns that not every recording has.
struct SampleColumns {
  bool times = false;        ///< Monotonic and device time, of sessions in real time.
  bool joints = false;       ///< Joint angles and torques, of a device with joints.
  ChannelBits channels = 0;  ///< What else the device measures, see `DeviceChannels`.

  /// The columns that either of the two has.
  friend SampleColumns operator|(const SampleColumns& a, const SampleColumns& b) noexcept {
    return {.times = a.times || b.times,
            .joints = a.joints || b.joints,
            .channels = static_cast<ChannelBits>(a.channels | b.channels)};
  }
};

/// One column of such a table. Files that hold arrays put those of one `array` together: the
/// force on five points along three axes is one array.
struct SampleColumn {
  std::string name;       ///< "palm_inner_force_x_n"
  std::string array;      ///< "force_n"; the name where it stands alone.
  std::string part;       ///< "palm_inner": a point or a joint; "": the array has none.
  std::string component;  ///< "x"; "": the array has none.
};

/// A sample as a row of a table, for files that people and other programs read: one spelling of
/// its columns for all of them. Units end the names. The columns of an array come by part, then
/// by component. Not real time.
[[nodiscard]] std::vector<SampleColumn> sample_columns(const SampleColumns& which);
[[nodiscard]] std::vector<std::string> sample_column_names(const SampleColumns& which);

/// In the order of `sample_column_names`. Whole numbers (tick, bits) are exact.
[[nodiscard]] std::vector<double> sample_values(const Sample& sample,
                                                const SampleColumns& columns);

/// Whether it was taken in real time.
[[nodiscard]] inline bool has_times(const Sample& sample) noexcept {
  return sample.monotonic_ns != 0;
}

/// Whether any joint is not 0, NaN included.
[[nodiscard]] bool has_joints(const Sample& sample) noexcept;

}  // namespace jnd::core
