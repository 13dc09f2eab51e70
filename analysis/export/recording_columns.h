#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/sample_table.h"

namespace jnd::analysis {

/// A column of a recording.
struct RecordingColumn {
  core::SampleColumn column;
  std::size_t index = 0;  ///< Of its value among `core::sample_values`.
  std::string unit;
  std::string meaning;
  int decimals = 0;  ///< It was stored in steps of 10^-decimals.
  /// By how many steps a value that was read may be off: more for joints, whose samples are of
  /// single precision.
  double tolerance = 1e-3;
  bool is_flags = false;  ///< Bits or a code, no quantity that has a mean.

  [[nodiscard]] const std::string& name() const noexcept { return column.name; }
  /// The smallest difference that was stored, in the column's unit.
  [[nodiscard]] double step() const noexcept;
};
[[nodiscard]] std::vector<RecordingColumn> recording_columns(const core::SampleColumns& which);

/// The double nearest to the step that was stored; a value that is none stays as it is.
[[nodiscard]] double on_grid(double value, const RecordingColumn& column);

}  // namespace jnd::analysis
