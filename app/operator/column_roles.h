#pragma once

#include <string>

#include "app/curves/curve_request.h"
#include "app/operator/data_preview.h"

namespace jnd::app {

/// What a column of somebody's table is to the fits.
enum class ColumnRole { kNone, kIntensity, kYes, kTrials, kGroup };

[[nodiscard]] ColumnRole role_of(const CurveRequest& request, const std::string& column);

/// The request with another column in this role, or one more that curves are told apart by. A
/// column has one role, so it loses the one it had. The cell that is a yes is guessed anew
/// where the answers are others.
[[nodiscard]] CurveRequest with_role(CurveRequest request, const DataPreview& preview,
                                     const std::string& column, ColumnRole role);

/// Which column and cell a filter "COLUMN=CELL" is of.
struct RowFilter {
  std::string column, cell;
};
[[nodiscard]] RowFilter filter_of(const std::string& where);

/// The request for rows alone that have this cell in the column, in place of another cell of
/// it.
[[nodiscard]] CurveRequest with_filter(CurveRequest request, const RowFilter& filter);
[[nodiscard]] CurveRequest without_filter(CurveRequest request, const std::string& column);

}  // namespace jnd::app
