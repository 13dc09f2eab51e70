#include <algorithm>
#include <cmath>
#include <limits>

#include "app/gui/plot_drawing.h"

namespace jnd::app::gui {
namespace {

/// The smallest and the largest value that can be shown.
class Extent {
 public:
  explicit Extent(bool logarithmic) : logarithmic_(logarithmic) {}

  void add(double value) {
    if (!std::isfinite(value) || (logarithmic_ && !(value > 0))) return;
    low_ = std::min(low_, value);
    high_ = std::max(high_, value);
  }
  void add(const std::vector<double>& values) {
    for (const double value : values) add(value);
  }
  /// Moves the ends apart, each by a share of their distance.
  void widen(double by) {
    if (!(low_ < high_)) return;
    if (logarithmic_) {
      const double factor = std::pow(high_ / low_, by);
      low_ /= factor;
      high_ *= factor;
    } else {
      const double distance = by * (high_ - low_);
      low_ -= distance;
      high_ += distance;
    }
  }
  [[nodiscard]] AxisRange range(const PlotAxis& axis) const {
    return sound_range(axis.minimum.value_or(low_), axis.maximum.value_or(high_), logarithmic_);
  }

 private:
  bool logarithmic_;
  double low_ = std::numeric_limits<double>::infinity();
  double high_ = -std::numeric_limits<double>::infinity();
};

}  // namespace

AxisRange x_range_of(const PlotModel& model) {
  Extent extent(model.x.logarithmic);
  bool has_points = !model.boxes.empty();
  for (const PlotSeries& series : model.series) {
    extent.add(series.x);
    has_points |= series.style == PlotSeries::Style::kPoints;
  }
  for (const PlotBox& box : model.boxes) {
    extent.add(box.x - 0.5);
    extent.add(box.x + 0.5);
  }
  for (const PlotMark& mark : model.marks) {
    if (mark.vertical) extent.add(mark.at);
  }
  // A curve may begin at the axis, but a point would be cut in half there.
  if (has_points && model.boxes.empty()) extent.widen(0.04);
  return extent.range(model.x);
}

AxisRange y_range_of(const PlotModel& model, int max_ticks) {
  Extent extent(model.y.logarithmic);
  for (const PlotSeries& series : model.series) {
    if (series.style != PlotSeries::Style::kBand) extent.add(series.y);
    extent.add(series.low);
    extent.add(series.high);
  }
  for (const PlotBox& box : model.boxes) {
    for (const double value : {box.lower_whisker, box.upper_whisker}) extent.add(value);
    for (const PlotBox::Outlier& outlier : box.outliers) extent.add(outlier.value);
  }
  for (const PlotMark& mark : model.marks) {
    if (!mark.vertical) extent.add(mark.at);
  }
  if (model.y.logarithmic || model.equal_scales) extent.widen(0.06);
  AxisRange range = extent.range(model.y);
  if (model.y.logarithmic || model.equal_scales) return range;
  const AxisRange widened = widened_to_ticks(range, max_ticks);
  if (!model.y.minimum.has_value()) range.low = widened.low;
  if (!model.y.maximum.has_value()) range.high = widened.high;
  return range;
}

void equalise(PlotArea& area) {
  const double x_per_pixel = (area.x_range.high - area.x_range.low) / area.place.width;
  const double y_per_pixel = (area.y_range.high - area.y_range.low) / area.place.height;
  AxisRange& shorter = x_per_pixel < y_per_pixel ? area.x_range : area.y_range;
  const double pixels = x_per_pixel < y_per_pixel ? area.place.width : area.place.height;
  const double wanted = std::max(x_per_pixel, y_per_pixel) * pixels;
  const double middle = (shorter.low + shorter.high) / 2;
  shorter = {middle - wanted / 2, middle + wanted / 2};
}

}  // namespace jnd::app::gui
