#pragma once

#include <string>
#include <vector>

#include "core/sample.h"

namespace jnd::core {

/// Columns that only some recordings have.
struct SampleColumns {
  bool times = false;        ///< Monotonic and device time, in sessions in real time.
  bool joints = false;       ///< Joint angles and torques, from a device with joints.
  ChannelBits channels = 0;  ///< What else the device measures; see `DeviceChannels`.

  /// Returns the columns that either of the two has.
  friend SampleColumns operator|(const SampleColumns& a, const SampleColumns& b) noexcept {
    return {.times = a.times || b.times,
            .joints = a.joints || b.joints,
            .channels = static_cast<ChannelBits>(a.channels | b.channels)};
  }
};

/// One column of a table of samples. Files that hold arrays group the columns of one `array`;
/// for example, the force on five points along three axes is one array.
struct SampleColumn {
  std::string name;       ///< "palm_inner_force_x_n"
  std::string array;      ///< "force_n"; the column's name if it stands alone.
  std::string part;       ///< "palm_inner", a point or a joint; "" if the array has no parts.
  std::string component;  ///< "x"; "" if the array has no components.
};

/// A sample as a row of a table, for files that people and other programs read. The columns are
/// spelt in one way for all files, and their names end in the unit. The columns of an array are
/// ordered by part, then by component. Not real time.
[[nodiscard]] std::vector<SampleColumn> sample_columns(const SampleColumns& which);
[[nodiscard]] std::vector<std::string> sample_column_names(const SampleColumns& which);

/// Returns values in the order of `sample_column_names`. Integers (tick, bits) are exact.
[[nodiscard]] std::vector<double> sample_values(const Sample& sample,
                                                const SampleColumns& columns);

/// Whether the sample was taken in real time.
[[nodiscard]] inline bool has_times(const Sample& sample) noexcept {
  return sample.monotonic_ns != 0;
}

/// Whether any joint is not 0. NaN counts as not 0.
[[nodiscard]] bool has_joints(const Sample& sample) noexcept;

}  // namespace jnd::core
