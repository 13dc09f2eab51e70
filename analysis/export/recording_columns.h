#pragma once

#include <string>
#include <vector>

#include "core/sample_table.h"

namespace jnd::analysis {

/// A column of a recording.
struct RecordingColumn {
  std::string name;  ///< One of `core::sample_column_names`.
  std::string unit;
  std::string meaning;
  int decimals = 0;  ///< It was stored in steps of 10^-decimals.
  /// By how many steps a value that was read may be off: more for joints, whose samples are of
  /// single precision.
  double tolerance = 1e-3;
};
[[nodiscard]] std::vector<RecordingColumn> recording_columns(const core::SampleColumns& which);

/// The double nearest to the step that was stored; a value that is none stays as it is.
[[nodiscard]] double on_grid(double value, const RecordingColumn& column);

}  // namespace jnd::analysis
