#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/gui/axis_ticks.h"
#include "app/gui/ui.h"

namespace jnd::app::gui {

struct PlotAxis {
  std::string label;  ///< The label, such as "test viscosity"; "" for none.
  /// The unit, such as "Pa s", shown after the label and after the value under the mouse.
  std::string unit;
  bool logarithmic = false;
  /// The ends of the axis. Without them the data's ends are used; those of y are widened to
  /// ticks.
  std::optional<double> minimum, maximum;
  /// The ticks, such as names of boxes or quarters of a percentage; if empty, they are
  /// computed.
  std::vector<AxisTick> ticks;
  std::string tick_suffix;  ///< Follows each tick's number, such as " s" on an axis of time.
};

struct PlotSeries {
  enum class Style {
    kLine,    ///< Uses x and y; the line is broken where a value is not finite.
    kPoints,  ///< Uses x and y; `low` and `high`, if given, are error bars.
    kBand,    ///< Uses x, low and high; drawn below everything else.
  };
  Style style = Style::kLine;
  std::string name;  ///< The name in the legend; a series named "" is not in it.
  Colour colour = Colour::kBlue;
  std::vector<double> x, y;
  std::vector<double> low, high;
  /// Names of single points, shown at the mouse, such as "P05".
  std::vector<std::string> names;
  /// Radii of single points in logical pixels; if empty, all points are alike.
  std::vector<float> radii;
  bool hollow = true;      ///< Points only: rings of ink, filled with the card's colour.
  bool dashed = false;     ///< Lines only.
  float thickness = 2.0f;  ///< Lines only.
  float alpha = 1.0f;
};

/// A straight line across the plot, for example at the reference.
struct PlotMark {
  double at = 0.0;
  bool vertical = true;
  std::string label;
  Colour colour = Colour::kSoft;
  bool dashed = true;
  /// The line ends at this value of the other axis; without it, the line goes all the way
  /// across.
  std::optional<double> until;
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
  std::string name;  ///< The name shown at the mouse.
  Colour colour = Colour::kBlue;
};

/// What a plot shows: numbers and words that know nothing of studies. Values that are not
/// finite are left out, and so are values that are not positive on a logarithmic axis.
struct PlotModel {
  std::string title;  ///< The heading; `unit` follows it.
  std::string unit;
  PlotAxis x, y;
  std::vector<PlotSeries> series;
  std::vector<PlotBox> boxes;
  std::vector<PlotMark> marks;
  bool legend = true;  ///< Draws a legend if more than one series has a name.
  /// A unit is equally long on both axes, as paths need it.
  bool equal_scales = false;
  bool axes = true;   ///< Draws the ticks and their lines; a path needs none.
  bool hover = true;  ///< Tells in words what is under the mouse.
  /// The least width left of the plot for the y axis, so that plots above each other align.
  float least_left = 0;
};

/// Where values are on the screen, in logical pixels.
struct PlotArea {
  Rect place;
  AxisRange x_range, y_range;
  bool x_logarithmic = false, y_logarithmic = false;

  [[nodiscard]] float x(double value) const noexcept;
  [[nodiscard]] float y(double value) const noexcept;  ///< Larger values are higher up.
  /// True if both values are finite, and positive on logarithmic axes.
  [[nodiscard]] bool can_show(double x, double y) const noexcept;
};

/// Draws the plot, and tells in words what is under the mouse. Of thousands of points, only
/// those are drawn that the screen's resolution can show.
PlotArea draw_plot(Ui& ui, const Rect& place, const PlotModel& model);

}  // namespace jnd::app::gui
