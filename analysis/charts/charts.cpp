#include "analysis/charts/charts.h"

#include <algorithm>

namespace jnd::analysis {

const Chart* ChartSet::chart_of(const std::string& who) const {
  if (who == kEverybody) return everybody ? &*everybody : nullptr;
  const auto found = std::ranges::find(participants, who, &Chart::who);
  return found == participants.end() ? nullptr : &*found;
}

std::vector<ChartSet> charts_of(const FigureSource& source) {
  std::vector<ChartSet> all;
  for (const auto kind : kChartKinds) {
    for (ChartSet& set : kind(source)) all.push_back(std::move(set));
  }
  return all;
}

}  // namespace jnd::analysis
