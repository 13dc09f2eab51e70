#pragma once

#include <string>
#include <vector>

#include "core/sample.h"

namespace jnd::core {

/// A sample as a row of a table, for files that people and other programs read: one spelling of
/// its columns for all of them. Units end the names. Not real time.
[[nodiscard]] std::vector<std::string> sample_column_names(bool with_joints);

/// In the order of `sample_column_names`. Whole numbers (tick, bits) are exact.
[[nodiscard]] std::vector<double> sample_values(const Sample& sample, bool with_joints);

/// Whether any joint is not 0, NaN included.
[[nodiscard]] bool has_joints(const Sample& sample) noexcept;

}  // namespace jnd::core
