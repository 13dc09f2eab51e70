#include <cmath>
#include <limits>
#include <string>

#include "app/gui/plot_drawing.h"
#include "app/language/words.h"

namespace jnd::app::gui {
namespace {

constexpr float kReach = 24;  // The mouse's reach in logical pixels.

struct Nearest {
  float distance = kReach;
  float x = 0, y = 0;
  std::string words;
};

std::string with_unit(double value, const std::string& unit) {
  std::string text = short_number(value);
  if (!unit.empty()) text += " " + unit;
  return text;
}

/// The values, after the name if there is one.
std::string described(const std::string& name, const std::string& values) {
  return name.empty() ? values : name + ":  " + values;
}

class Search {
 public:
  Search(const Ui& ui, const PlotArea& area) : ui_(ui), area_(area) {}

  /// Returns true if this point is the nearest so far; only then does the caller make its
  /// words. A `weight` below 1 prefers a point that the person rather means.
  bool is_nearer(double x, double y, float weight = 1.0f) {
    if (!area_.can_show(x, y)) return false;
    const float there_x = area_.x(x);
    const float there_y = area_.y(y);
    if (!area_.place.inset(-6).contains(there_x, there_y)) return false;
    const float distance = std::hypot(there_x - ui_.mouse_x(), there_y - ui_.mouse_y());
    if (!(distance < kReach && weight * distance < nearest_.distance)) return false;
    nearest_ = {.distance = weight * distance, .x = there_x, .y = there_y};
    return true;
  }
  Nearest& nearest() { return nearest_; }

 private:
  const Ui& ui_;
  const PlotArea& area_;
  Nearest nearest_;
};

void search_series(Search& search, const PlotSeries& series, const PlotModel& model) {
  // A measured point is preferred to a curve that passes beside it.
  const float weight = series.style == PlotSeries::Style::kPoints ? 0.1f : 1.0f;
  std::size_t best = std::numeric_limits<std::size_t>::max();
  for (std::size_t i = 0; i < std::min(series.x.size(), series.y.size()); ++i) {
    if (search.is_nearer(series.x[i], series.y[i], weight)) best = i;
  }
  if (best == std::numeric_limits<std::size_t>::max()) return;
  const std::string& name = best < series.names.size() ? series.names[best] : series.name;
  const std::string& y_unit = model.y.unit.empty() ? model.unit : model.y.unit;
  std::string values = tr("{} at {}", with_unit(series.y[best], y_unit),
                          with_unit(series.x[best], model.x.unit + model.x.tick_suffix));
  if (best < series.low.size() && best < series.high.size() &&
      std::isfinite(series.low[best]) && std::isfinite(series.high[best])) {
    values += "  (" +
              tr("{} to {}", short_number(series.low[best]), short_number(series.high[best])) +
              ")";
  }
  search.nearest().words = described(name, values);
}

void search_box(Search& search, const PlotBox& box, const PlotModel& model) {
  const std::string& unit = model.y.unit.empty() ? model.unit : model.y.unit;
  if (search.is_nearer(box.x, box.lower_whisker)) {
    search.nearest().words =
        described(box.name, tr("down to {}", with_unit(box.lower_whisker, unit)));
  }
  if (search.is_nearer(box.x, box.lower_quartile)) {
    search.nearest().words =
        described(box.name, tr("lower quartile {}", with_unit(box.lower_quartile, unit)));
  }
  if (search.is_nearer(box.x, box.median)) {
    search.nearest().words = described(box.name, tr("median {}", with_unit(box.median, unit)));
  }
  if (search.is_nearer(box.x, box.upper_quartile)) {
    search.nearest().words =
        described(box.name, tr("upper quartile {}", with_unit(box.upper_quartile, unit)));
  }
  if (search.is_nearer(box.x, box.upper_whisker)) {
    search.nearest().words =
        described(box.name, tr("up to {}", with_unit(box.upper_whisker, unit)));
  }
  for (const PlotBox::Outlier& outlier : box.outliers) {
    if (!search.is_nearer(box.x, outlier.value)) continue;
    search.nearest().words = described(outlier.name, with_unit(outlier.value, unit));
  }
}

}  // namespace

void draw_hover(Ui& ui, const PlotArea& area, const PlotModel& model) {
  if (!ui.hovered(area.place.inset(-6))) return;
  Search search(ui, area);
  for (const PlotSeries& series : model.series) {
    if (series.style != PlotSeries::Style::kBand) search_series(search, series, model);
  }
  for (const PlotBox& box : model.boxes) search_box(search, box, model);
  const Nearest& nearest = search.nearest();
  if (nearest.words.empty()) return;
  ui.ring(nearest.x, nearest.y, 7, Colour::kBlue, 2);
  ui.tooltip(nearest.x, nearest.y, nearest.words);
}

}  // namespace jnd::app::gui
