#include "app/gui/views/scope_curve.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace jnd::app::gui {

double least_scope_span(const std::string& unit) {
  if (unit == "m") return 1e-3;
  if (unit == "m/s" || unit == "rad" || unit == "N m") return 1e-2;
  return unit == "N" ? 0.1 : 1.0;
}

AxisRange scope_range(const std::vector<ScopePoint>& points, const std::string& unit) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const ScopePoint& point : points) {
    low = std::fmin(low, point.low);
    high = std::fmax(high, point.high);
  }
  if (!(low <= high)) return {0.0, least_scope_span(unit)};
  const double missing = std::max(0.0, least_scope_span(unit) - (high - low));
  low -= 0.5 * missing;
  high += 0.5 * missing;
  const double eighth = (high - low) / 8.0;
  double step = std::pow(10.0, std::floor(std::log10(eighth)));
  for (const double factor : {5.0, 2.0}) {
    if (factor * step <= eighth) {
      step *= factor;
      break;
    }
  }
  return {step * std::floor(low / step), step * std::ceil(high / step)};
}

PlotSeries scope_curve(const std::vector<ScopePoint>& points, const ScopePicture& picture,
                       const Rect& place, const AxisRange& range) {
  PlotSeries series{.colour = Colour::kBlue, .thickness = 1.5f};
  const double column_s = kScopeSeconds / std::max(1.0f, place.width);
  const double pixel = (range.high - range.low) / std::max(1.0f, place.height);
  const auto add = [&](double time_s, double value) {
    series.x.push_back(time_s - picture.newest_s);
    series.y.push_back(value);
  };
  // The columns are fixed in time, so that a moving curve does not flicker.
  const auto column_of = [&](const ScopePoint& point) {
    return std::floor(point.time_s / column_s);
  };
  double before = 0.0;
  for (std::size_t i = 0; i < points.size();) {
    const double began_s = points[i].time_s;
    const double column = column_of(points[i]);
    if (i > 0 && began_s - points[i - 1].time_s > 1.5 * picture.interval_s) {
      add(began_s, std::numeric_limits<double>::quiet_NaN());
    }
    double low = points[i].low;
    double high = points[i].high;
    double ended_s = began_s;
    for (++i; i < points.size() && column_of(points[i]) == column &&
              points[i].time_s - ended_s <= 1.5 * picture.interval_s;
         ++i) {
      low = std::fmin(low, points[i].low);
      high = std::fmax(high, points[i].high);
      ended_s = points[i].time_s;
    }
    const double middle = 0.5 * (low + high);
    if (high - low < pixel) {
      add(0.5 * (began_s + ended_s), middle);
    } else {
      add(began_s, before > middle ? high : low);
      add(ended_s, before > middle ? low : high);
    }
    before = middle;
  }
  return series;
}

}  // namespace jnd::app::gui
