#include <algorithm>
#include <map>

#include "analysis/report/plot_parts.h"
#include "analysis/report/recording_conditions.h"
#include "analysis/results/number_words.h"
#include "analysis/words/said.h"

namespace jnd::analysis {
namespace {

/// The start of a repetition: about a quarter of a minute at some 50 points per second. The
/// whole path would be a cloud.
constexpr std::size_t kPathPoints = 750;
constexpr std::size_t kRepetitions = 6;

const Path* longest(const std::vector<Path>& paths) {
  const Path* best = nullptr;
  for (const Path& path : paths) {
    if (best == nullptr || path.x_m.size() > best->x_m.size()) best = &path;
  }
  return best;
}

/// The narrowest range of an axis, so that small movements are not exaggerated.
constexpr double kLeastWidthM = 0.1;

AxisRange column_range(const FigureTable& table, std::size_t column) {
  std::vector<double> values;
  for (const std::vector<FigureCell>& row : table.rows) {
    if (row[column].number) values.push_back(*row[column].number);
  }
  return axis_range(values);
}

AxisRange at_least(const AxisRange& range, double width) {
  const double more = std::max(0.0, 0.5 * (width - (range.high - range.low)));
  return {range.low - more, range.high + more};
}

/// Fig. D.16 and D.24, from above and from the front.
std::optional<Figure> trajectories_figure(const FigureSource& source,
                                          const MovementAnalysis& movement,
                                          const ParticipantMovement& person) {
  FigureTable table{.name = "trajectories",
                    .columns = {"series", "block", "repetition", "x_m", "y_m", "z_m"}};
  std::vector<std::string> blocks;
  std::map<std::string, std::size_t> shown;
  std::map<std::string, std::size_t> there;
  std::size_t most = 0, num_there = 0;
  for (const Trajectory& trajectory : person.trajectories) {
    const Path* const path = longest(trajectory.hand);
    if (path == nullptr || path->x_m.size() < 2) continue;
    if (!shown.contains(trajectory.block)) blocks.push_back(trajectory.block);
    std::size_t& number = shown[trajectory.block];
    num_there = std::max(num_there, ++there[trajectory.block]);
    if (number == kRepetitions) continue;
    ++number;
    most = std::max(most, number);
    const auto block = static_cast<std::size_t>(
        std::find(blocks.begin(), blocks.end(), trajectory.block) - blocks.begin());
    const int series = static_cast<int>(block * kRepetitions + number);
    const std::size_t end = std::min(path->x_m.size(), kPathPoints);
    for (std::size_t i = 0; i < end; ++i) {
      table.rows.push_back({series, trajectory.block,
                            static_cast<double>(trajectory.repetition), path->x_m[i],
                            path->y_m[i], path->z_m[i]});
    }
  }
  if (blocks.empty()) return std::nullopt;
  Figure figure{.name = "trajectories",
                .section = "movement",
                .title = said("Trajectories of the hand"),
                .thesis = said("Fig. D.16 and D.24")};
  PanelGrid grid{.num_columns = 2,
                 .x_title = said("x, to the right [m]"),
                 .left_in = 0.8,
                 .top_in = most > 1 ? 0.62 : 0.42,
                 .gap_x_in = 0.85};
  const AxisRange x_range = column_range(table, 3);
  std::vector<Panel> panels;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const std::string title = blocks[b].empty() ? "" : source.titles.short_title_of(blocks[b]);
    for (const bool from_above : {true, false}) {
      Panel panel{.title =
                      title + (from_above ? said(", from above") : said(", from the front"))};
      const AxisRange range = at_least(column_range(table, from_above ? 4 : 5), kLeastWidthM);
      panel.before =
          small_tics("x", x_range) + small_tics("y", range) + "  set xrange " +
          range_words(x_range) + "\n  set yrange " + range_words(range) + "\n  set ylabel " +
          gnuplot_quoted(from_above ? said("y, away [m]") : said("z, up [m]")) + "\n";
      if (panels.empty()) {
        panel.before +=
            "  set key at screen 0.5,0.99 center top vertical maxrows 1 reverse Left samplen 2 "
            "width 2 font small\n";
      }
      panel.plot = "plot ";
      const std::string y = from_above ? "y_m" : "z_m";
      for (std::size_t r = 1; r <= shown[blocks[b]]; ++r) {
        const int series = static_cast<int>(b * kRepetitions + r);
        panel.plot += (r > 1 ? ", " : "") + from_table(table) +
                      "'x_m':" + if_series(series, y) + " with lines lt " + std::to_string(r) +
                      " lw 0.8";
        if (panels.empty() && most > 1) {
          panel.plot += " title " + gnuplot_quoted(said("repetition {}", r));
        }
      }
      panels.push_back(std::move(panel));
    }
  }
  figure.height_in = grid_height_in(grid, panels.size(), 1.7);
  figure.plot = grid_plot(grid, panels, figure.width_in, figure.height_in);
  figure.caption = said(
      "Participant {}{}: mean of the points of the hand, the first quarter of a minute of the "
      "longest stretch without a gap in each repetition. Workspace frame: x to the "
      "participant’s right, y away, z up from the surface of the fluid.{}",
      person.participant, person_selection_words(movement),
      selection_words(most, num_there, "repetitions"));
  figure.tables = {std::move(table)};
  return figure;
}

/// The delivered force beside the force that the law commands.
std::optional<Figure> force_figure(const FigureSource& source, const MovementAnalysis& movement,
                                   const ParticipantMovement& person) {
  constexpr std::size_t kIntensities = 12;
  FigureTable table{.name = "force_by_speed",
                    .columns = {"series", "block", "intensity", "speed_m_per_s", "delivered_n",
                                "commanded_n"}};
  std::vector<std::string> blocks;
  std::map<std::string, std::vector<double>> intensities;
  std::map<std::string, std::size_t> there;
  std::size_t num_there = 0;
  for (const ConditionMovement& condition : person.conditions) {
    if (condition.block.empty() || !condition.intensity) continue;
    const ForceBySpeed& force = condition.force;
    if (force.speed_m_per_s.empty()) continue;
    std::vector<double>& known = intensities[condition.block];
    num_there = std::max(num_there, ++there[condition.block]);
    if (known.empty()) blocks.push_back(condition.block);
    if (known.size() == kIntensities) continue;
    known.push_back(*condition.intensity);
    const auto block = static_cast<std::size_t>(
        std::find(blocks.begin(), blocks.end(), condition.block) - blocks.begin());
    const int series = static_cast<int>(block * kIntensities + known.size());
    for (std::size_t i = 0; i < force.speed_m_per_s.size(); ++i) {
      table.rows.push_back(
          {series, condition.block, *condition.intensity, force.speed_m_per_s[i],
           force.delivered_n[i],
           i < force.commanded_n.size() ? FigureCell(force.commanded_n[i]) : FigureCell()});
    }
  }
  if (blocks.empty()) return std::nullopt;
  const bool is_measured = std::ranges::any_of(
      person.conditions,
      [](const ConditionMovement& condition) { return condition.force.is_measured; });
  Figure figure{.name = "force_by_speed",
                .section = "movement",
                .title = said("Delivered and commanded force over speed")};
  PanelGrid grid{.num_columns = static_cast<int>(std::min<std::size_t>(2, blocks.size())),
                 .x_title = said("Speed of the hand [m/s]"),
                 .y_title = said("Force against the motion [N]"),
                 .gap_x_in = 0.5};
  const AxisRange speeds{0.0, column_range(table, 3).high};
  std::vector<Panel> panels;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    Panel panel{.title = source.titles.short_title_of(blocks[b]),
                .before = small_tics("x", speeds) + "  set xrange " + range_words(speeds) +
                          "\n  set yrange [0:*]\n"};
    panel.plot = "plot ";
    for (std::size_t i = 1; i <= intensities[blocks[b]].size(); ++i) {
      const int series = static_cast<int>(b * kIntensities + i);
      panel.plot += (i > 1 ? ", " : "") + from_table(table) +
                    "'speed_m_per_s':" + if_series(series, "commanded_n") +
                    " with lines ls 10, " + from_table(table) +
                    "'speed_m_per_s':" + if_series(series, "delivered_n") +
                    " with points lt 1 pt 6 ps 0.4";
    }
    panels.push_back(std::move(panel));
  }
  figure.height_in = grid_height_in(grid, panels.size(), 2.0);
  figure.plot = grid_plot(grid, panels, figure.width_in, figure.height_in);
  figure.caption = said(
      "Participant {}{}: circles: mean force {}, in classes of speed; lines: what the law "
      "commands there. One line an intensity.{}",
      person.participant, person_selection_words(movement),
      (is_measured ? said("against the motion that the device's sensors measured")
                   : said("that was rendered against the motion, after every limit")),
      selection_words(kIntensities, num_there, said("intensities of a block")));
  figure.tables = {std::move(table)};
  return figure;
}

}  // namespace

std::vector<Figure> recording_figures(const FigureSource& source,
                                      const MovementAnalysis& movement) {
  std::vector<Figure> figures;
  const auto add = [&figures](std::optional<Figure> figure) {
    if (figure) figures.push_back(std::move(*figure));
  };
  if (const ParticipantMovement* const person = shown_participant(source, movement)) {
    add(trajectories_figure(source, movement, *person));
    add(joint_angles_figure(source, movement, *person));
    add(joint_torques_figure(source, movement, *person));
    add(force_figure(source, movement, *person));
  }
  add(tip_distances_figure(source, movement));
  return figures;
}

}  // namespace jnd::analysis
