#include "app/operator/column_roles.h"

#include <algorithm>

#include "app/operator/column_guess.h"

namespace jnd::app {

ColumnRole role_of(const CurveRequest& request, const std::string& column) {
  if (column.empty()) return ColumnRole::kNone;
  if (request.intensity == column) return ColumnRole::kIntensity;
  if (request.yes == column) return ColumnRole::kYes;
  if (request.trials == column) return ColumnRole::kTrials;
  return std::ranges::find(request.group_by, column) != request.group_by.end()
             ? ColumnRole::kGroup
             : ColumnRole::kNone;
}

CurveRequest with_role(CurveRequest request, const DataPreview& preview,
                       const std::string& column, ColumnRole role) {
  const std::string yes_before = request.yes, trials_before = request.trials;
  for (std::string* one : {&request.intensity, &request.yes, &request.trials}) {
    if (*one == column) one->clear();
  }
  std::erase(request.group_by, column);
  switch (role) {
    case ColumnRole::kIntensity:
      request.intensity = column;
      break;
    case ColumnRole::kYes:
      request.yes = column;
      break;
    case ColumnRole::kTrials:
      request.trials = column;
      break;
    case ColumnRole::kGroup:
      request.group_by.push_back(column);
      break;
    case ColumnRole::kNone:
      break;
  }
  if (request.yes != yes_before || request.trials != trials_before) {
    const std::size_t place = preview.place_of(request.yes);
    const bool are_trials = request.trials.empty() && place < preview.columns.size();
    request.yes_value = are_trials ? guessed_yes_value(preview.columns[place]) : "";
  }
  return request;
}

RowFilter filter_of(const std::string& where) {
  const std::size_t sign = where.find('=');
  return {where.substr(0, sign), sign == std::string::npos ? "" : where.substr(sign + 1)};
}

CurveRequest with_filter(CurveRequest request, const RowFilter& filter) {
  request = without_filter(std::move(request), filter.column);
  request.where.push_back(filter.column + "=" + filter.cell);
  return request;
}

CurveRequest without_filter(CurveRequest request, const std::string& column) {
  std::erase_if(request.where,
                [&](const std::string& where) { return filter_of(where).column == column; });
  return request;
}

}  // namespace jnd::app
