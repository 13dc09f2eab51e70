#include <algorithm>

#include "analysis/report/figures.h"
#include "analysis/report/plot_parts.h"
#include "analysis/results/number_words.h"
#include "analysis/words/said.h"

namespace jnd::analysis {
namespace {

struct StrokeQuantity {
  const char* name;
  const char* axis;
  std::optional<double> core::PresentationMeasures::*value;
};

constexpr StrokeQuantity kStrokeQuantities[] = {
    {"stroke_width_m", said_later("Stroke width [m]"),
     &core::PresentationMeasures::stroke_width_m},
    {"max_speed_m_per_s", said_later("Highest speed [m/s]"),
     &core::PresentationMeasures::max_speed_m_per_s},
};

FigureTable strokes_table(const FigureSource& source) {
  FigureTable table{.name = "strokes",
                    .columns = {"series", "block", "position", "participant", "stroke_width_m",
                                "max_speed_m_per_s"}};
  const std::size_t num_blocks = source.data.blocks.size();
  for (std::size_t b = 0; b < num_blocks; ++b) {
    const std::string& block = source.data.blocks[b].block;
    const double aside =
        0.25 * (static_cast<double>(b) - 0.5 * static_cast<double>(num_blocks - 1));
    for (std::size_t i = 0; i < source.data.participants.size(); ++i) {
      const ParticipantData& participant = source.data.participants[i];
      const auto found = participant.presentations.find(block);
      if (found == participant.presentations.end()) continue;
      const auto width = movement_mean(found->second, kStrokeQuantities[0].value);
      const auto speed = movement_mean(found->second, kStrokeQuantities[1].value);
      if (!width && !speed) continue;
      table.rows.push_back({static_cast<int>(b) + 1, block,
                            static_cast<double>(i) + 1.0 + aside, participant.participant,
                            width, speed});
    }
  }
  return table;
}

}  // namespace

std::vector<Figure> stroke_figures(const FigureSource& source) {
  FigureTable table = strokes_table(source);
  if (table.rows.empty()) return {};
  const std::vector<std::string> people = source.participants();
  Figure figure{.name = "strokes",
                .section = "movement",
                .title = said("Stroke width and highest speed of every participant"),
                .caption = said("Means over the presentations of a block that hold a whole "
                                "stroke. Horizontal lines: means over participants."),
                .thesis = said("Fig. D.17 and D.25")};
  PanelGrid grid{
      .num_columns = 1, .x_title = said("Participant"), .left_in = 0.75, .top_in = 0.42};
  std::vector<Panel> panels;
  for (const StrokeQuantity& quantity : kStrokeQuantities) {
    Panel panel;
    panel.before =
        "  set xrange [0.3:" + plot_number(static_cast<double>(people.size()) + 0.7) + "]\n" +
        named_tics("x", people, people.size() > 16) +
        "  set yrange [0:*]\n  set offsets 0,0,graph 0.06,0\n" +
        small_tics("y", {0.0, largest_in(table, quantity.name)}) + "  set ylabel " +
        gnuplot_quoted(said(quantity.axis)) + "\n" +
        (panels.empty()
             ? "  set key at screen 0.5,0.99 center top horizontal reverse Left samplen 1\n"
             : "");
    panel.plot = "plot ";
    for (std::size_t b = 0; b < source.data.blocks.size(); ++b) {
      const std::string& block = source.data.blocks[b].block;
      const std::string type = std::to_string(b % 7 + 1);
      panel.plot += (b > 0 ? ", " : "") + from_table(table) +
                    "'position':" + if_series(static_cast<int>(b) + 1, quantity.name) +
                    " with points lt " + type + " ps 0.8";
      if (panels.empty()) {
        panel.plot += " title " + gnuplot_quoted(source.titles.short_title_of(block));
      }
      const Estimate* const mean =
          source.results.find(std::string(quantity.name) + "." + block);
      if (mean != nullptr && mean->value) {
        panel.plot += ", " + plot_number(*mean->value) + " with lines lt " + type + " lw 1";
      }
    }
    panels.push_back(std::move(panel));
  }
  figure.height_in = grid_height_in(grid, panels.size(), 1.6);
  figure.plot = grid_plot(grid, panels, figure.width_in, figure.height_in);
  figure.tables = {std::move(table)};
  return {std::move(figure)};
}

}  // namespace jnd::analysis
