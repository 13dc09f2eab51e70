#include "app/gui/plot_drawing.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

namespace jnd::app::gui {
namespace {

/// A line without the points that nobody can see. Of successive points in one column of pixels
/// it keeps the first, the lowest, the highest and the last.
class ThinnedLine {
 public:
  explicit ThinnedLine(std::vector<ImVec2>& points) : points_(points) {}

  void add(const ImVec2& point) {
    const float column = std::floor(point.x);
    if (count_ > 0 && column == column_) {
      if (point.y < lowest_.y) lowest_ = point, lowest_at_ = count_;
      if (point.y > highest_.y) highest_ = point, highest_at_ = count_;
      last_ = point;
      ++count_;
      return;
    }
    finish();
    column_ = column;
    count_ = 1;
    lowest_at_ = highest_at_ = 0;
    first_ = lowest_ = highest_ = last_ = point;
  }

  void finish() {
    if (count_ == 0) return;
    push(first_);
    push(lowest_at_ < highest_at_ ? lowest_ : highest_);
    push(lowest_at_ < highest_at_ ? highest_ : lowest_);
    push(last_);
    count_ = 0;
  }

 private:
  void push(const ImVec2& point) {
    const bool is_same =
        !points_.empty() && points_.back().x == point.x && points_.back().y == point.y;
    if (!is_same) points_.push_back(point);
  }

  std::vector<ImVec2>& points_;
  ImVec2 first_, lowest_, highest_, last_;
  float column_ = 0;
  int count_ = 0;
  int lowest_at_ = 0, highest_at_ = 0;
};

std::size_t count_of(const PlotSeries& series) {
  return std::min(series.x.size(), series.style == PlotSeries::Style::kBand
                                       ? std::min(series.low.size(), series.high.size())
                                       : series.y.size());
}

void stroke(Ui& ui, const std::vector<ImVec2>& points, const PlotSeries& series) {
  const std::uint32_t colour = ui.theme().line_rgba(series.colour, series.alpha);
  const float thickness = ui.px(series.thickness);
  if (!series.dashed) {
    ui.draw_list().AddPolyline(points.data(), static_cast<int>(points.size()), colour, 0,
                               thickness);
    return;
  }
  // The dashes go on from piece to piece, because the pieces of a curve are shorter than a
  // dash.
  float drawn = 0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    draw_dashes(ui, points[i - 1].x, points[i - 1].y, points[i].x, points[i].y, colour,
                thickness, drawn);
    drawn += std::hypot(points[i].x - points[i - 1].x, points[i].y - points[i - 1].y);
  }
}

}  // namespace

void draw_dashes(Ui& ui, float x0, float y0, float x1, float y1, std::uint32_t colour,
                 float thickness, float drawn) {
  const float length = std::hypot(x1 - x0, y1 - y0);
  const float dash = ui.px(4);
  const float period = ui.px(8);
  if (!(length > 0) || length > 1e5f) return;
  for (float at = -std::fmod(drawn, period); at < length; at += period) {
    const float from = std::max(at, 0.0f) / length;
    const float to = std::min(at + dash, length) / length;
    if (to <= from) continue;
    ui.draw_list().AddLine(ImVec2(x0 + from * (x1 - x0), y0 + from * (y1 - y0)),
                           ImVec2(x0 + to * (x1 - x0), y0 + to * (y1 - y0)), colour, thickness);
  }
}

void draw_band(Ui& ui, const PlotArea& area, const PlotSeries& series) {
  ImDrawList& list = ui.draw_list();
  const std::uint32_t colour = ui.theme().line_rgba(series.colour, 0.16f * series.alpha);
  const ImVec2 white = ImGui::GetFontTexUvWhitePixel();
  const std::size_t count = count_of(series);
  for (std::size_t i = 1; i < count; ++i) {
    const bool can_show = area.can_show(series.x[i - 1], series.low[i - 1]) &&
                          area.can_show(series.x[i - 1], series.high[i - 1]) &&
                          area.can_show(series.x[i], series.low[i]) &&
                          area.can_show(series.x[i], series.high[i]);
    if (!can_show) continue;
    const float x0 = ui.px(area.x(series.x[i - 1]));
    const float x1 = ui.px(area.x(series.x[i]));
    // Drawn without soft edges, which would show where one piece meets the next.
    list.PrimReserve(6, 4);
    list.PrimQuadUV(
        ImVec2(x0, ui.px(area.y(series.high[i - 1]))),
        ImVec2(x1, ui.px(area.y(series.high[i]))), ImVec2(x1, ui.px(area.y(series.low[i]))),
        ImVec2(x0, ui.px(area.y(series.low[i - 1]))), white, white, white, white, colour);
  }
}

void draw_curve(Ui& ui, const PlotArea& area, const PlotSeries& series) {
  std::vector<ImVec2> points;
  ThinnedLine line(points);
  const std::size_t count = count_of(series);
  for (std::size_t i = 0; i < count; ++i) {
    if (area.can_show(series.x[i], series.y[i])) {
      line.add(ImVec2(ui.px(area.x(series.x[i])), ui.px(area.y(series.y[i]))));
      continue;
    }
    line.finish();
    stroke(ui, points, series);
    points.clear();
  }
  line.finish();
  stroke(ui, points, series);
}

void draw_points(Ui& ui, const PlotArea& area, const PlotSeries& series) {
  const std::size_t count = count_of(series);
  const Colour ink =
      series.hollow && series.colour == Colour::kBlue ? Colour::kInk : series.colour;
  for (std::size_t i = 0; i < count && i < series.low.size() && i < series.high.size(); ++i) {
    const bool can_show =
        area.can_show(series.x[i], series.low[i]) && area.can_show(series.x[i], series.high[i]);
    if (!can_show) continue;
    const float x = area.x(series.x[i]);
    ui.draw_list().AddLine(ImVec2(ui.px(x), ui.px(area.y(series.low[i]))),
                           ImVec2(ui.px(x), ui.px(area.y(series.high[i]))),
                           ui.theme().line_rgba(ink, series.alpha), ui.px(1.3f));
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (!area.can_show(series.x[i], series.y[i])) continue;
    const ImVec2 centre(ui.px(area.x(series.x[i])), ui.px(area.y(series.y[i])));
    const float radius = i < series.radii.size() ? series.radii[i]
                         : series.hollow         ? 4.5f
                                                 : 3.5f;
    if (!series.hollow) {
      ui.draw_list().AddCircleFilled(centre, ui.px(radius),
                                     ui.theme().line_rgba(series.colour, series.alpha));
      continue;
    }
    ui.draw_list().AddCircleFilled(centre, ui.px(radius), ui.rgba(Colour::kCard));
    // Answers are ink; a second kind of points is told apart by its colour.
    const bool is_plain = series.colour == Colour::kBlue;
    ui.draw_list().AddCircle(
        centre, ui.px(radius),
        is_plain ? ui.rgba(Colour::kInk) : ui.theme().line_rgba(series.colour), 0, ui.px(1.6f));
  }
}

void draw_box(Ui& ui, const PlotArea& area, const PlotBox& box, float width) {
  for (const double value : {box.lower_whisker, box.lower_quartile, box.median,
                             box.upper_quartile, box.upper_whisker}) {
    if (!area.can_show(box.x, value)) return;
  }
  const float centre = area.x(box.x);
  const float left = centre - width / 2;
  const auto whisker = [&](double from, double to) {
    ui.line(centre, area.y(from), centre, area.y(to), Colour::kInk, 1.3f);
    ui.line(centre - width / 5, area.y(to), centre + width / 5, area.y(to), Colour::kInk, 1.3f);
  };
  whisker(box.lower_quartile, box.lower_whisker);
  whisker(box.upper_quartile, box.upper_whisker);
  const float top = area.y(box.upper_quartile);
  const Rect body = {left, top, width, std::max(1.0f, area.y(box.lower_quartile) - top)};
  ui.fill(body, Colour::kCard, 3);
  ui.fill(body, box.colour, 3, 0.16f);
  ui.outline(body, box.colour, 3, 1.5f);
  ui.line(left, area.y(box.median), left + width, area.y(box.median), Colour::kInk, 2.0f);
  for (const PlotBox::Outlier& outlier : box.outliers) {
    if (!area.can_show(box.x, outlier.value)) continue;
    ui.ring(centre, area.y(outlier.value), 3.5f, Colour::kInk);
  }
}

void draw_mark(Ui& ui, const PlotArea& area, const PlotMark& mark) {
  const double inside = mark.vertical ? area.y_range.high : area.x_range.high;
  if (!area.can_show(mark.vertical ? mark.at : inside, mark.vertical ? inside : mark.at))
    return;
  float x0 = area.place.x;
  float y0 = area.place.bottom();
  float x1 = area.place.right();
  float y1 = area.place.y;
  if (mark.vertical) {
    x0 = x1 = area.x(mark.at);
    if (mark.until.has_value()) y1 = area.y(*mark.until);
  } else {
    y0 = y1 = area.y(mark.at);
    if (mark.until.has_value()) x1 = area.x(*mark.until);
  }
  if (mark.dashed) {
    draw_dashes(ui, std::round(ui.px(x0)) + 0.5f, std::round(ui.px(y0)) + 0.5f,
                std::round(ui.px(x1)) + 0.5f, std::round(ui.px(y1)) + 0.5f,
                ui.theme().line_rgba(mark.colour), std::max(1.0f, ui.px(1)));
  } else {
    ui.line(x0, y0, x1, y1, mark.colour, 1.6f);
  }
  if (mark.label.empty()) return;
  const float width = ui.text_width(mark.label, Font::kTiny) + 2;
  const float height = ui.line_height(Font::kTiny);
  Rect place = {x1 - width, y1 - height - 2, width, height};
  if (mark.vertical) {
    // The label stands beside the foot of the line, on the side that has room.
    const bool fits = x0 + 6 + width < area.place.right();
    place = {fits ? x0 + 6 : x0 - 6 - width, area.place.bottom() - height - 3, width, height};
  }
  ui.text(place, mark.label, {.font = Font::kTiny, .colour = mark.colour});
}

}  // namespace jnd::app::gui
