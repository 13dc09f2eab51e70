#include "analysis/report/commissioning_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "analysis/report/plot_parts.h"

namespace jnd::analysis {
namespace {

constexpr double kHeight_in = 2.7;

/// Two panels side by side, each with its own axes.
std::string two_panels(const Panel& left, const Panel& right, double width_in) {
  return grid_plot({.num_columns = 2, .left_in = 0.75, .gap_x_in = 0.85}, {left, right},
                   width_in, kHeight_in);
}

std::string axes(const std::string& x, const std::string& y) {
  return "  set xlabel " + gnuplot_quoted(x) + " font small offset 0,0.3\n  set ylabel " +
         gnuplot_quoted(y) + " font small offset 0.8,0\n";
}

/// A range slightly wider than from -half to half.
std::string range_about_zero(const std::string& axis, double half) {
  const double wide = half > 0.0 ? 1.15 * half : 1.0;
  return "  set " + axis + "range " + range_words({-wide, wide}) + "\n" +
         small_tics(axis, {0.0, wide});
}

std::string range_from_zero(const std::string& axis, double largest) {
  const double wide = largest > 0.0 ? 1.1 * largest : 1.0;
  return "  set " + axis + "range " + range_words({0.0, wide}) + "\n" +
         small_tics(axis, {0.0, wide});
}

/// A round magnification at which the largest arrow is about this long.
double round_magnification(double largest_m, double wanted_m) {
  if (!(largest_m > 0.0)) return 1.0;
  // The small excess keeps rounding from turning 20 into 19.999.
  const double factor = (1.0 + 1e-9) * wanted_m / largest_m;
  const double decade = std::pow(10.0, std::floor(std::log10(factor)));
  for (const double round : {5.0, 2.0}) {
    if (round * decade <= factor) return round * decade;
  }
  return decade;
}

/// A panel that shows the marks along one axis of the workspace.
Panel marks_panel(const FigureTable& table, const std::array<std::string, 2>& axis,
                  const std::array<double, 4>& range, const std::string& title) {
  const auto column = [&](std::size_t which, const std::string& what) {
    return "'" + axis[which] + "_" + what + "_mm'";
  };
  const auto arrows = [&](int is_upper) {
    const std::string which = std::to_string(is_upper);
    return from_table(table) + "(column('is_upper')==" + which + " ? column(" +
           column(0, "mark") + ") : NaN):" + column(1, "mark") + ":" + column(0, "arrow") +
           ":" + column(1, "arrow") +
           " with vectors head filled size screen 0.008,20 dt 1 lw 1.3 lc " +
           (is_upper == 1 ? "rgb '#0072B2' title 'upper'" : "rgb '#D55E00' title 'lower'");
  };
  return {.title = title,
          .before = axes(axis[0] + " [mm]", axis[1] + " [mm]") + "  set xrange " +
                    range_words({range[0], range[1]}) + "\n  set yrange " +
                    range_words({range[2], range[3]}) + "\n" +
                    small_tics("x", {range[0], range[1]}) +
                    small_tics("y", {range[2], range[3]}) +
                    "  set key right center samplen 1 font small\n",
          .plot = "plot " + from_table(table) + column(0, "mark") + ":" + column(1, "mark") +
                  " with points ls 10 ps 1.1, " + arrows(1) + ", " + arrows(0)};
}

Figure marks_figure(const FrameFit& fit) {
  constexpr std::array<const char*, 3> kAxes = {"x", "y", "z"};
  double largest_m = 0.0;
  Eigen::Vector3d low_m = fit.marks.front().workspace_m, high_m = low_m;
  for (const TouchedMark& mark : fit.marks) {
    largest_m = std::max(largest_m, missed_by_m(fit, mark).cwiseAbs().maxCoeff());
    low_m = low_m.cwiseMin(mark.workspace_m);
    high_m = high_m.cwiseMax(mark.workspace_m);
  }
  const double extent_m = (high_m - low_m).maxCoeff();
  const double times = round_magnification(largest_m, 0.2 * extent_m);
  FigureTable table{
      .name = "device_marks",
      .columns = {"mark", "is_upper", "x_mark_mm", "y_mark_mm", "z_mark_mm", "x_missed_mm",
                  "y_missed_mm", "z_missed_mm", "x_arrow_mm", "y_arrow_mm", "z_arrow_mm"}};
  for (const TouchedMark& mark : fit.marks) {
    const Eigen::Vector3d missed_m = missed_by_m(fit, mark);
    auto& row = table.rows.emplace_back();
    row.emplace_back(static_cast<int>(table.rows.size()));
    row.emplace_back(mark.workspace_m.z() > 0.5 * (low_m.z() + high_m.z()) ? 1 : 0);
    for (int axis = 0; axis < 3; ++axis) row.emplace_back(1e3 * mark.workspace_m[axis]);
    for (int axis = 0; axis < 3; ++axis) row.emplace_back(1e3 * missed_m[axis]);
    for (int axis = 0; axis < 3; ++axis) row.emplace_back(1e3 * times * missed_m[axis]);
  }
  const auto panel = [&](int across, int up, const std::string& title) {
    // Both axes have the same scale, so that angles are true. A panel is this much wider than
    // high.
    constexpr double kWide = 1.41;
    const double half_m = 0.72 * extent_m;
    const double x_m = 0.5 * (low_m[across] + high_m[across]);
    const double y_m = 0.5 * (low_m[up] + high_m[up]);
    return marks_panel(
        table, {kAxes[static_cast<std::size_t>(across)], kAxes[static_cast<std::size_t>(up)]},
        {1e3 * (x_m - kWide * half_m), 1e3 * (x_m + kWide * half_m), 1e3 * (y_m - half_m),
         1e3 * (y_m + half_m)},
        title);
  };
  Figure figure{
      .name = "device_marks",
      .section = "frame",
      .title = "How the marks were met",
      .caption = fmt::format(
          "Circles: the {} marks in the workspace, from above and from the participant's "
          "place. "
          "Arrows: from a mark to where the device, by the frame that was fitted, says that it "
          "is, {:g} times as long, in two colours for the upper and the lower marks. Largest "
          "miss along an axis: {:.2f} mm; standard deviation "
          "on "
          "one axis: {:.2f} mm.",
          fit.marks.size(), times, 1e3 * largest_m, 1e3 * fit.residual_m),
      .height_in = kHeight_in};
  figure.plot = two_panels(panel(0, 1, "From above"),
                           panel(0, 2, "From the participant's place"), figure.width_in);
  figure.tables = {std::move(table)};
  return figure;
}

/// The force that must be commanded on a way for its load alone. The fit removes everything
/// that the device itself opposes to it [N].
double commanded_for_load_n(const ForceFit& fit, const GuidedWay& way) {
  return commanded_without_mass_n(fit, way) - fitted_n(fit, way) +
         load_along_n(fit, way) / fit.gain.value;
}

Figure force_figure(const ForceFit& fit) {
  FigureTable table{
      .name = "device_force",
      .columns = {"load_kg", "pose", "upwards", "commanded_n", "given_n", "residual_n"}};
  constexpr double kGravity_m_per_s2 = 9.80665;
  double most_n = 0.0, most_off_n = 0.0;
  for (const GuidedWay& way : fit.ways) {
    if (std::abs(fit.up.dot(way.direction)) < 0.9) continue;
    const double commanded_n = commanded_for_load_n(fit, way);
    const double given_n = load_along_n(fit, way);
    const double residual_n = given_n - fit.gain.value * commanded_n;
    table.rows.push_back({way.load_n / kGravity_m_per_s2, way.pose + 1,
                          fit.up.dot(way.direction) > 0.0 ? 1 : 0, commanded_n, given_n,
                          residual_n});
    most_n = std::max({most_n, std::abs(commanded_n), std::abs(given_n)});
    most_off_n = std::max(most_off_n, std::abs(residual_n));
  }
  const auto points = [&](const std::string& value, bool upwards, const std::string& style) {
    return from_table(table) + "'commanded_n':(column('upwards')==" + (upwards ? "1" : "0") +
           " ? " + value + " : NaN) with points " + style;
  };
  Figure figure{
      .name = "device_force",
      .section = "force",
      .title = "Force given for a force commanded",
      .caption = fmt::format(
          "Left: what hung from the tool, over what had to be commanded for it, a mark for "
          "each "
          "of {} ways up (circles) and down (squares); the line is the gain, {:.3f} N for a "
          "newton, and a true force would lie on the dashed one. Weight, friction, damping and "
          "what speeds the mass up are taken away as they were fitted. Right: what is left of "
          "each way; standard deviation of all {} ways {:.3f} N commanded.",
          table.rows.size(), fit.gain.value, fit.ways.size(), fit.residual_n),
      .height_in = kHeight_in};
  const std::string up_style = "lt 1 ps 0.55", down_style = "lt 2 ps 0.55";
  figure.plot =
      two_panels({.title = "Given over commanded",
                  .before = axes("Commanded [N]", "Load, upwards positive [N]") +
                            range_about_zero("x", most_n) + range_about_zero("y", most_n) +
                            "  set key top left reverse Left samplen 1 font small\n",
                  .plot = "plot x with lines ls 12, " + plot_number(fit.gain.value) +
                          "*x with lines lt 5 dt 1 lw 1, " +
                          points("column('given_n')", true, up_style + " title 'up'") + ", " +
                          points("column('given_n')", false, down_style + " title 'down'")},
                 {.title = "What is left",
                  .before = axes("Commanded [N]", "Given less gain times commanded [mN]") +
                            range_about_zero("y", 1e3 * most_off_n) + "  unset key\n",
                  .plot = "plot 0 with lines ls 12, " +
                          points("1e3*column('residual_n')", true, up_style) + ", " +
                          points("1e3*column('residual_n')", false, down_style)},
                 figure.width_in);
  figure.tables = {std::move(table)};
  return figure;
}

Figure resistance_figure(const ForceFit& fit, const std::optional<FrameFit>& frame) {
  FigureTable table{
      .name = "device_resistance",
      .columns = {"series", "axis", "speed_m_per_s", "resistance_n", "residual_n"}};
  constexpr std::array<const char*, 3> kAxes = {"x", "y", "z"};
  double fastest_m_per_s = 0.0, most_n = 0.0, most_off_n = 0.0;
  for (const GuidedWay& way : fit.ways) {
    if (way.load_n != 0.0) continue;
    const Eigen::Vector3d direction =
        frame ? Eigen::Vector3d(frame->rotation * way.direction) : way.direction;
    Eigen::Index axis = 0;
    direction.cwiseAbs().maxCoeff(&axis);
    const double resistance_n =
        fit.gain.value * commanded_without_mass_n(fit, way) + fit.offset_n.dot(way.direction);
    const double residual_n =
        resistance_n - fit.friction_n.value - fit.damping_n_s_per_m.value * way.speed_m_per_s;
    table.rows.push_back({static_cast<int>(axis) + 1, kAxes[static_cast<std::size_t>(axis)],
                          way.speed_m_per_s, resistance_n, residual_n});
    fastest_m_per_s = std::max(fastest_m_per_s, way.speed_m_per_s);
    most_n = std::max(most_n, resistance_n);
    most_off_n = std::max(most_off_n, std::abs(residual_n));
  }
  const auto points = [&](const std::string& value, bool titled) {
    std::string plot;
    for (int axis = 0; axis < 3; ++axis) {
      plot += ", " + from_table(table) +
              "'speed_m_per_s':(column('series')==" + std::to_string(axis + 1) + " ? " + value +
              " : NaN) with points lt " + std::to_string(axis + 1) + " ps 0.55";
      if (titled) {
        plot += " title 'along " + std::string(kAxes[static_cast<std::size_t>(axis)]) + "'";
      }
    }
    return plot;
  };
  Figure figure{
      .name = "device_resistance",
      .section = "force",
      .title = "What the device opposes to motion by itself",
      .caption = fmt::format(
          "Left: force against the motion without a load, over mean speed, a mark a way, both "
          "ways along each axis of the {}; the constant force is taken away. The line is what "
          "was fitted: where it begins is the dry friction, {:.3f} N, and its slope the own "
          "damping, {:.2f} N s/m. Right: what is left of each way.",
          frame ? "workspace" : "device", fit.friction_n.value, fit.damping_n_s_per_m.value),
      .height_in = kHeight_in};
  figure.plot = two_panels(
      {.title = "Force over speed",
       .before = axes("Speed [m/s]", "Against the motion [N]") +
                 range_from_zero("x", fastest_m_per_s) + range_from_zero("y", most_n) +
                 "  set key bottom right reverse Left samplen 1 font small\n",
       .plot = "plot " + plot_number(fit.friction_n.value) + "+" +
               plot_number(fit.damping_n_s_per_m.value) + "*x with lines lt 5 dt 1 lw 1" +
               points("column('resistance_n')", true)},
      {.title = "What is left",
       .before = axes("Speed [m/s]", "Measured less fitted [mN]") +
                 range_about_zero("y", 1e3 * most_off_n) + "  unset key\n",
       .plot = "plot 0 with lines ls 12" + points("1e3*column('residual_n')", false)},
      figure.width_in);
  figure.tables = {std::move(table)};
  return figure;
}

Figure noise_figure(const NoiseFit& fit) {
  FigureTable table{.name = "device_noise", .columns = {"reading", "x_um", "y_um", "z_um"}};
  double most_um = 0.0;
  for (const Eigen::Vector3d& reading_m : fit.first_readings_m) {
    table.rows.push_back({static_cast<int>(table.rows.size()) + 1, 1e6 * reading_m.x(),
                          1e6 * reading_m.y(), 1e6 * reading_m.z()});
    most_um = std::max(most_um, 1e6 * reading_m.cwiseAbs().maxCoeff());
  }
  Figure figure{
      .name = "device_noise",
      .section = "noise",
      .title = "A point that does not move",
      .caption = fmt::format(
          "The first {} readings of its position along each axis of the device, less their "
          "mean. Standard deviation on one axis {:.2f} µm (dotted lines: twice that), least "
          "step between two readings {:.3g} µm.",
          fit.first_readings_m.size(), 1e6 * fit.position_sd_m.value,
          1e6 * fit.position_resolution_m),
      .height_in = 2.1};
  const std::string bound = plot_number(2e6 * fit.position_sd_m.value);
  figure.plot =
      "  set xrange " + range_words({0.0, static_cast<double>(table.rows.size()) + 1.0}) +
      "\n" + range_about_zero("y", most_um) + axes("Reading, one a tick", "Off the mean [µm]") +
      "  set xtics autofreq font small\n" +
      "  set key outside right center vertical reverse Left samplen 1.5 font small\n"
      "  plot " +
      bound + " with lines ls 12, -" + bound + " with lines ls 12, " + from_table(table) +
      "'reading':'x_um' with lines lt 1 title 'x', " + from_table(table) +
      "'reading':'y_um' with lines lt 2 dt 1 title 'y', " + from_table(table) +
      "'reading':'z_um' with lines lt 3 dt 1 title 'z'\n";
  figure.tables = {std::move(table)};
  return figure;
}

/// A panel with the estimates of single ways about the estimate of all, with its interval.
Panel ways_panel(const FigureTable& table, const std::string& column, const Measured& all,
                 double scale, const std::string& y_title, const std::string& title) {
  double low = scale * all.ci95_low, high = scale * all.ci95_high;
  const std::size_t place = table.place_of(column);
  for (const std::vector<FigureCell>& row : table.rows) {
    low = std::min(low, row[place].number.value_or(low));
    high = std::max(high, row[place].number.value_or(high));
  }
  const double beyond = 0.15 * (high - low) + 1e-9;
  const AxisRange range{low - beyond, high + beyond};
  const std::string num = plot_number(static_cast<double>(table.rows.size()) + 1.0);
  const auto line = [&](double value, const char* style) {
    return plot_number(scale * value) + " with lines " + style;
  };
  return {.title = title,
          .before = axes("Way", y_title) + "  set xrange [0.0:" + num + "]\n  set yrange " +
                    range_words(range) + "\n" + small_tics("y", range) +
                    "  set xtics autofreq font small\n",
          .plot = "plot " + line(all.ci95_low, "ls 12") + ", " + line(all.ci95_high, "ls 12") +
                  ", " + line(all.value, "lt 5 dt 1 lw 1") + ", " + from_table(table) +
                  "'way':'" + column + "' with points lt 1 ps 0.7"};
}

Figure delay_figure(const DelayFit& fit) {
  FigureTable table{.name = "device_delay", .columns = {"way", "delay_ms", "mass_per_gain_kg"}};
  for (const PushedWay& way : fit.ways) {
    table.rows.push_back(
        {static_cast<int>(table.rows.size()) + 1, 1e3 * way.delay_s, way.mass_per_gain_kg});
  }
  Figure figure{
      .name = "device_delay",
      .section = "delay",
      .title = "Delay and mass, way by way",
      .caption = fmt::format(
          "What the pushes of each of {} ways come to by themselves (circles), what all come "
          "to "
          "together (line) and its 95 % interval (dotted). The mass is that of newtons "
          "commanded: the true mass over the gain.",
          fit.ways.size()),
      .height_in = kHeight_in};
  figure.plot =
      two_panels(ways_panel(table, "delay_ms", fit.delay_s, 1e3, "Delay [ms]", "Delay"),
                 ways_panel(table, "mass_per_gain_kg", fit.mass_per_gain_kg, 1.0,
                            "Mass over gain [kg]", "Mass"),
                 figure.width_in);
  figure.tables = {std::move(table)};
  return figure;
}

}  // namespace

std::vector<Figure> commissioning_figures(const CommissionedFits& fits) {
  std::vector<Figure> figures;
  if (fits.frame && !fits.frame->marks.empty()) figures.push_back(marks_figure(*fits.frame));
  if (fits.force && !fits.force->ways.empty()) {
    figures.push_back(force_figure(*fits.force));
    figures.push_back(resistance_figure(*fits.force, fits.frame));
  }
  if (fits.delay && !fits.delay->ways.empty()) figures.push_back(delay_figure(*fits.delay));
  if (fits.noise && !fits.noise->first_readings_m.empty()) {
    figures.push_back(noise_figure(*fits.noise));
  }
  return figures;
}

}  // namespace jnd::analysis
