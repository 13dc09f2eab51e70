#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/gui/axis_ticks.h"
#include "app/gui/ui.h"

namespace jnd::app::gui {

struct PlotAxis {
  std::string label;  ///< "test viscosity"; "" for none.
  std::string unit;   ///< "Pa s": after the label, and after the value under the mouse.
  bool logarithmic = false;
  /// Ends of the axis; where not given, those of the data, y out to the next ticks.
  std::optional<double> minimum, maximum;
  std::vector<AxisTick> ticks;  ///< Names of boxes, quarters of a percentage; else worked out.
  std::string tick_suffix;      ///< " s", for an axis of time.
};

struct PlotSeries {
  enum class Style {
    kLine,    ///< x, y; broken where a value is not finite.
    kPoints,  ///< x, y, and low to high as error bars where given.
    kBand,    ///< x, low, high; drawn below everything else.
  };
  Style style = Style::kLine;
  std::string name;  ///< For the legend; "" is not in it.
  Colour colour = Colour::kBlue;
  std::vector<double> x, y;
  std::vector<double> low, high;
  std::vector<std::string> names;  ///< Of single points, for the mouse: "P05".
  std::vector<float> radii;        ///< Of single points, logical pixels; else all alike.
  bool hollow = true;              ///< Points: rings, with ink around the card's colour.
  bool dashed = false;             ///< Lines.
  float thickness = 2.0f;          ///< Lines.
  float alpha = 1.0f;
};

/// A line across: the reference, p (1 + w).
struct PlotMark {
  double at = 0.0;
  bool vertical = true;
  std::string label;
  Colour colour = Colour::kSoft;
  bool dashed = true;
  std::optional<double> until;  ///< From the axis to this value of the other one; else across.
};

struct PlotBox {
  double x = 0.0;
  double lower_whisker = 0.0, lower_quartile = 0.0, median = 0.0, upper_quartile = 0.0,
         upper_whisker = 0.0;
  struct Outlier {
    double value = 0.0;
    std::string name;
  };
  std::vector<Outlier> outliers;
  std::string name;  ///< For the mouse.
  Colour colour = Colour::kBlue;
};

/// What a plot shows: numbers and words, nothing of studies. Values that are not finite, and on
/// logarithmic axes those that are not positive, are left out.
struct PlotModel {
  std::string title;  ///< Drawn as a heading, with `unit` after it.
  std::string unit;
  PlotAxis x, y;
  std::vector<PlotSeries> series;
  std::vector<PlotBox> boxes;
  std::vector<PlotMark> marks;
  bool legend = true;         ///< Where more than one series has a name.
  bool equal_scales = false;  ///< A unit is as long on both axes: paths.
  bool axes = true;           ///< Ticks and their lines; a path needs none.
  bool hover = true;          ///< What is under the mouse is told in words.
  float least_left = 0;       ///< For the y axis; so that plots one above the other align.
};

/// Where values are on the screen, logical pixels.
struct PlotArea {
  Rect place;
  AxisRange x_range, y_range;
  bool x_logarithmic = false, y_logarithmic = false;

  [[nodiscard]] float x(double value) const noexcept;
  [[nodiscard]] float y(double value) const noexcept;  ///< Upwards.
  /// Finite, and positive where it must be.
  [[nodiscard]] bool can_show(double x, double y) const noexcept;
};

/// Draws it, and what is under the mouse in words. Thousands of points are drawn as what is
/// left of them at the screen's resolution.
PlotArea draw_plot(Ui& ui, const Rect& place, const PlotModel& model);

}  // namespace jnd::app::gui
