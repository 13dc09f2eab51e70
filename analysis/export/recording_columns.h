#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/sample_table.h"

namespace jnd::analysis {

/// A column of a recording.
struct RecordingColumn {
  core::SampleColumn column;
  std::size_t index = 0;  ///< The index of its value among `core::sample_values`.
  std::string unit;
  std::string meaning;
  int decimals = 0;  ///< The value was stored in steps of 10^-decimals.
  /// By how many steps a value that was read may be off. It is larger for joints, whose samples
  /// have single precision.
  double tolerance = 1e-3;
  bool is_flags = false;  ///< Whether it holds bits or a code, which have no mean.

  [[nodiscard]] const std::string& name() const noexcept { return column.name; }
  /// The stored step in the column's unit.
  [[nodiscard]] double step() const noexcept;
};
[[nodiscard]] std::vector<RecordingColumn> recording_columns(const core::SampleColumns& which);

/// The double nearest to the stored step. A value that is on no step is unchanged.
[[nodiscard]] double on_grid(double value, const RecordingColumn& column);

}  // namespace jnd::analysis
