#include "analysis/report/explored_media.h"

#include <algorithm>

#include "analysis/data/presentation_use.h"
#include "analysis/report/plot_parts.h"
#include "analysis/report/recording_conditions.h"
#include "analysis/words/said.h"

namespace jnd::analysis {
namespace {

struct Quantity {
  const char* name;
  const char* axis;
  std::optional<double> StrokeMeans::*value;
};

constexpr Quantity kQuantities[] = {
    {"stroke_width_m", said_later("Stroke width [m]"), &StrokeMeans::stroke_width_m},
    {"max_speed_m_per_s", said_later("Highest speed [m/s]"), &StrokeMeans::max_speed_m_per_s},
};

FigureTable explored_table(const std::vector<ExploredMedium>& media) {
  FigureTable table{.name = "explored",
                    .columns = {"position", "medium", "participant", "num_strokes",
                                "stroke_width_m", "max_speed_m_per_s"}};
  for (std::size_t i = 0; i < media.size(); ++i) {
    for (const ExploredMedium::Person& person : media[i].people) {
      table.rows.push_back({static_cast<int>(i) + 1, media[i].title, person.participant,
                            person.strokes.num_strokes, person.strokes.stroke_width_m,
                            person.strokes.max_speed_m_per_s});
    }
  }
  return table;
}

FigureTable means_table(const std::vector<ExploredMedium>& media) {
  FigureTable table{.name = "explored_means",
                    .columns = {"position", "medium", "stroke_width_m", "max_speed_m_per_s"}};
  for (std::size_t i = 0; i < media.size(); ++i) {
    std::vector<FigureCell> row = {static_cast<int>(i) + 1, media[i].title};
    for (const Quantity& quantity : kQuantities) {
      double sum = 0.0;
      int count = 0;
      for (const ExploredMedium::Person& person : media[i].people) {
        if (!(person.strokes.*quantity.value)) continue;
        sum += *(person.strokes.*quantity.value);
        ++count;
      }
      row.push_back(count > 0 ? FigureCell(sum / count) : FigureCell());
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace

std::vector<ExploredMedium> explored_media(const FigureSource& source,
                                           const MovementAnalysis& movement) {
  std::vector<ExploredMedium> media;
  for (const ParticipantMovement& person : movement.participants) {
    for (const ConditionMovement& condition : person.conditions) {
      if (!condition.block.empty()) continue;
      const std::string title = shown_condition(source, condition).title;
      auto medium = std::ranges::find(media, title, &ExploredMedium::title);
      if (medium == media.end()) medium = media.insert(media.end(), {.title = title});
      medium->people.push_back({person.participant, condition.strokes});
    }
  }
  return media;
}

std::vector<Figure> explored_figures(const FigureSource& source,
                                     const MovementAnalysis& movement) {
  const std::vector<ExploredMedium> media = explored_media(source, movement);
  if (media.empty() || !presentation_uses(source.data).empty()) return {};
  FigureTable table = explored_table(media);
  FigureTable means = means_table(media);
  std::vector<std::string> titles;
  for (const ExploredMedium& medium : media) titles.push_back(medium.title);
  Figure figure{
      .name = "explored_media",
      .section = "movement",
      .title = said("Stroke width and highest speed by medium"),
      .caption = said(
          "From the recordings of media explored outside of trials, all whole strokes: circles "
          "are participants, bars their means. A medium without a mark has no whole stroke.")};
  PanelGrid grid{.num_columns = 2,
                 .x_title = "",
                 .left_in = 0.75,
                 .top_in = 0.15,
                 .bottom_in = 1.15,
                 .gap_x_in = 0.75};
  std::vector<Panel> panels;
  for (const Quantity& quantity : kQuantities) {
    Panel panel;
    panel.before = "  set xrange [0.4:" + plot_number(static_cast<double>(media.size()) + 0.6) +
                   "]\n" + named_tics("x", titles, /*upright=*/true) +
                   "  set xtics font small\n  set yrange [0:*]\n" +
                   small_tics("y", {0.0, largest_in(table, quantity.name)}) + "  set ylabel " +
                   gnuplot_quoted(said(quantity.axis)) + "\n";
    panel.plot = "plot " + from_table(means) + "(column('position')-0.25):'" + quantity.name +
                 "':(0.5):(0.0) with vectors nohead ls 11, " + from_table(table) +
                 "'position':'" + quantity.name + "' with points lt 1 pt 6 ps 0.7";
    panels.push_back(std::move(panel));
  }
  figure.height_in = grid_height_in(grid, panels.size(), 1.5);
  figure.plot = grid_plot(grid, panels, figure.width_in, figure.height_in);
  figure.tables = {std::move(table), std::move(means)};
  return {std::move(figure)};
}

}  // namespace jnd::analysis
