#pragma once

#include <string>

#include "app/curves/curve_request.h"
#include "app/operator/data_preview.h"

namespace jnd::app {

/// The role of a column of somebody's table in the fits.
enum class ColumnRole { kNone, kIntensity, kYes, kTrials, kGroup };

[[nodiscard]] ColumnRole role_of(const CurveRequest& request, const std::string& column);

/// The request with another column in this role, or with one more column that separates curves.
/// A column has one role, so it loses its former one. If the answers' column changes, the cell
/// that means yes is guessed again.
[[nodiscard]] CurveRequest with_role(CurveRequest request, const DataPreview& preview,
                                     const std::string& column, ColumnRole role);

/// The column and the cell of a filter "COLUMN=CELL".
struct RowFilter {
  std::string column, cell;
};
[[nodiscard]] RowFilter filter_of(const std::string& where);

/// The request for only those rows that have this cell in the column. It replaces a filter for
/// another cell of that column.
[[nodiscard]] CurveRequest with_filter(CurveRequest request, const RowFilter& filter);
[[nodiscard]] CurveRequest without_filter(CurveRequest request, const std::string& column);

}  // namespace jnd::app
