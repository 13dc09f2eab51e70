#pragma once

#include <string>
#include <vector>

#include "app/curves/curve_request.h"
#include "app/operator/data_preview.h"

namespace jnd::app {

/// Guesses what the columns of somebody's table are, by their names and contents: the
/// intensities, the answers (with the cell that means yes, if the reader does not know it), the
/// number of trials in a row, and what separates the curves. What cannot be guessed stays "".
/// Everything else is as `jnd fit psychometric` has it by default.
[[nodiscard]] CurveRequest guessed_request(const DataPreview& preview);

/// Guesses which cell of a column means yes: one of some known words, or else the later one of
/// two in the alphabet. "" if the reader knows it by itself, or if nothing can be said.
[[nodiscard]] std::string guessed_yes_value(const PreviewColumn& column);

}  // namespace jnd::app
