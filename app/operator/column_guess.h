#pragma once

#include <string>
#include <vector>

#include "app/curves/curve_request.h"
#include "app/operator/data_preview.h"

namespace jnd::app {

/// What the columns of somebody's table probably are, by their names and by what they hold:
/// intensities, answers (with the cell that is a yes, where the reader does not know it), how
/// many trials a row is, and what tells curves apart. What cannot be guessed stays "". All else
/// is as `jnd fit psychometric` has it where nothing is said.
[[nodiscard]] CurveRequest guessed_request(const DataPreview& preview);

/// The cell of a column that probably is a yes: one of known words, or of two the later one in
/// the alphabet; "" where the reader knows it by itself, and where nothing can be said.
[[nodiscard]] std::string guessed_yes_value(const PreviewColumn& column);

}  // namespace jnd::app
