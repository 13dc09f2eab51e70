#include <algorithm>
#include <array>
#include <set>

#include "analysis/report/plot_parts.h"
#include "analysis/report/recording_conditions.h"
#include "analysis/words/said.h"
#include "core/hand.h"

namespace jnd::analysis {
namespace {

constexpr std::size_t kPeople = 5;
constexpr std::size_t kConditions = 9;

/// One row of panels.
struct ShownPerson {
  std::string participant;
  StrokeCurves first;  ///< The curves of the first condition, whose turning points are drawn.
  std::array<std::vector<double>, core::kNumContactPoints> distances_mm;
};

/// The content of the figure, from participants whose device had joints. For others the tips
/// are where the hand is.
class TipDistances {
 public:
  FigureTable table{
      .name = "tip_distances",
      .columns = {"person", "participant", "series", "condition", "stroke_percent"}};
  std::vector<ShownPerson> people;
  /// The titles of the conditions, in the order of their series.
  std::vector<std::string> titles;
  std::set<std::string> all_titles;  ///< Includes conditions that are not shown.

  TipDistances() {
    for (const std::string_view point : core::kContactPointNames) {
      table.columns.push_back(std::string(point) + "_m");
    }
  }

  void add(const FigureSource& source, const ParticipantMovement& person) {
    bool is_new = true;
    for (const ShownCondition& condition : each_intensity(source, person)) {
      const StrokeCurves& curves = condition.movement->curves;
      const bool has_distances = curves.has_joints && curves.tip_distance_m[0].mean.size() ==
                                                          curves.stroke_percent.size();
      const std::optional<int> series =
          has_distances ? series_of(condition.title) : std::nullopt;
      if (!series) continue;
      if (is_new) {
        people.push_back({.participant = person.participant, .first = curves});
        is_new = false;
      }
      add(condition, *series);
    }
  }

 private:
  /// The number of a series, from 1. It is absent once there are as many conditions as lines
  /// that can be distinguished.
  std::optional<int> series_of(const std::string& title) {
    all_titles.insert(title);
    const auto known = std::ranges::find(titles, title);
    const auto index = static_cast<int>(known - titles.begin());
    if (known == titles.end()) {
      if (titles.size() == kConditions) return std::nullopt;
      titles.push_back(title);
    }
    return index + 1;
  }

  void add(const ShownCondition& condition, int series) {
    const StrokeCurves& curves = condition.movement->curves;
    for (std::size_t finger = 0; finger < curves.tip_distance_m.size(); ++finger) {
      for (const double distance_m : curves.tip_distance_m[finger].mean) {
        people.back().distances_mm[finger].push_back(1000.0 * distance_m);
      }
    }
    for (std::size_t i = 0; i < curves.stroke_percent.size(); ++i) {
      std::vector<FigureCell> row = {static_cast<int>(people.size()), people.back().participant,
                                     series, condition.name, curves.stroke_percent[i]};
      for (const CurveBand& band : curves.tip_distance_m) row.emplace_back(band.mean[i]);
      table.rows.push_back(std::move(row));
    }
  }
};

/// A style from light to dark and from dashed to solid, in the order of the conditions.
std::string line_style(std::size_t series, std::size_t num_series) {
  constexpr const char* kDashes[] = {"1", "(12,4)", "(5,3)", "(2,3)"};
  const double part =
      num_series < 2 ? 1.0 : static_cast<double>(series) / static_cast<double>(num_series - 1);
  const auto shade = [part](double light, double dark) {
    return std::to_string(static_cast<int>(light + part * (dark - light)));
  };
  return std::string("lw 1.3 dt ") + kDashes[series % 4] + " lc rgb (" + shade(150, 0) +
         "*65536+" + shade(190, 40) + "*256+" + shade(230, 100) + ")";
}

Panel panel_of(const TipDistances& shown, std::size_t person, std::size_t finger) {
  const ShownPerson& who = shown.people[person];
  const bool is_first = person == 0 && finger == 0;
  const std::string title = kFingerTitles[finger];
  Panel panel{.title = finger == 0 ? who.participant + ", " + title : title};
  if (is_first) {
    panel.before =
        "  set key at screen 0.5,0.985 center top vertical maxrows 3 reverse Left samplen 3 "
        "font small\n  set xrange [0:100]\n  set xtics 50 font small\n";
  }
  const AxisRange range = axis_range(who.distances_mm[finger]);
  panel.before += "  set yrange " + range_words(range) + "\n" + small_tics("y", range);
  if (finger == 0) panel.before += turn_lines(who.first);
  const std::string column = std::string(core::kContactPointNames[finger]) + "_m";
  panel.plot = "plot ";
  for (std::size_t s = 0; s < shown.titles.size(); ++s) {
    panel.plot += (s > 0 ? ", " : "") + from_table(shown.table) +
                  "'stroke_percent':(column('person')==" + std::to_string(person + 1) +
                  " && column('series')==" + std::to_string(s + 1) + " ? 1000*column('" +
                  column + "') : NaN) with lines " + line_style(s, shown.titles.size());
    if (is_first) panel.plot += " title " + gnuplot_quoted(shown.titles[s]);
  }
  return panel;
}

}  // namespace

std::optional<Figure> tip_distances_figure(const FigureSource& source,
                                           const MovementAnalysis& movement) {
  TipDistances shown;
  for (const ParticipantMovement& person : movement.participants) {
    if (shown.people.size() < kPeople) shown.add(source, person);
  }
  if (shown.people.empty()) return std::nullopt;
  Figure figure{.name = "tip_distances",
                .section = "movement",
                .title = said("Distance of the tips to the end effector over a stroke"),
                .thesis = said("Fig. D.28")};
  const auto num_key_rows = static_cast<double>(std::min<std::size_t>(3, shown.titles.size()));
  PanelGrid grid{.num_columns = core::kNumContactPoints,
                 .x_title = said("Stroke [%]"),
                 .y_title = said("Distance of the tip to the end effector [mm]"),
                 .top_in = 0.45 + 0.14 * num_key_rows};
  std::vector<Panel> panels;
  for (std::size_t person = 0; person < shown.people.size(); ++person) {
    for (std::size_t finger = 0; finger < core::kNumContactPoints; ++finger) {
      panels.push_back(panel_of(shown, person, finger));
    }
  }
  figure.height_in = grid_height_in(grid, panels.size(), 1.05);
  figure.plot = grid_plot(grid, panels, figure.width_in, figure.height_in);
  const std::size_t num_shown = shown.people.size();
  figure.caption = said(
      "Mean over strokes in each condition, one row a participant ({} with recordings). 0 % is "
      "the middle of the motion back; dashed lines: the turning points in the first "
      "condition.{}",
      (movement.participants.size() > num_shown
           ? said("the first {}", std::to_string(num_shown))
           : std::string("all")),
      selection_words(shown.titles.size(), shown.all_titles.size(), "conditions"));
  figure.tables = {std::move(shown.table)};
  return figure;
}

}  // namespace jnd::analysis
