#include <algorithm>
#include <cmath>
#include <map>

#include "analysis/charts/box_plot.h"
#include "analysis/report/figures.h"
#include "analysis/report/plot_parts.h"
#include "analysis/results/discrimination_own_values.h"
#include "analysis/results/number_words.h"
#include "analysis/words/said.h"
#include "experiments/study/media.h"

namespace jnd::analysis {
namespace {

std::vector<BlockDesign> discriminations(const FigureSource& source) {
  std::vector<BlockDesign> found;
  for (const BlockDesign& block : source.data.blocks) {
    if (block.compares() && source.section(block.block) != nullptr) {
      found.push_back(block);
    }
  }
  return found;
}

/// The name of own fractions in a block: those of the block's median and box or, with `other`,
/// those with the other pse.
std::string own_name(const FigureSource& source, const BlockDesign& block, bool other = false) {
  const bool free_pse = source.section(block.block)->own_fractions_free_pse != other;
  return block.block + (free_pse ? ".weber_fraction_free_pse" : ".weber_fraction");
}

/// The pse of the fractions of `own_name`: "at the reference", or "free" with the blocks in
/// which it is free.
std::string pse_words(const FigureSource& source, const std::vector<BlockDesign>& blocks) {
  std::string free_titles;
  std::size_t num_free = 0;
  for (const BlockDesign& block : blocks) {
    if (!source.section(block.block)->own_fractions_free_pse) continue;
    free_titles += (num_free++ > 0 ? ", " : "") + source.titles.short_title_of(block.block);
  }
  if (num_free == 0) return said("at the reference");
  return num_free == blocks.size() ? said("free")
                                   : said("at the reference, free in {}", free_titles);
}

std::optional<double> reference_of(const StudyData& data, const std::string& block) {
  for (const ParticipantData& participant : data.participants) {
    for (const core::TrialRow& trial : participant.trials_in(block)) {
      if (trial.reference_intensity) return trial.reference_intensity;
    }
  }
  return std::nullopt;
}

/// Everybody's fraction in every block, with the part of its interval that can be shown, and
/// the fraction with the other pse beside it.
FigureTable fractions_table(const FigureSource& source,
                            const std::vector<BlockDesign>& blocks) {
  FigureTable table{.name = "weber_fractions",
                    .columns = {"series", "block", "position", "participant", "weber_fraction",
                                "ci95_low", "ci95_high", "reason", "pse", "position_other_pse",
                                "weber_fraction_other_pse"}};
  const std::vector<std::string> people = source.participants();
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    for (std::size_t i = 0; i < people.size(); ++i) {
      const ParticipantEstimate* const own =
          source.own(blocks[b].block, people[i], own_name(source, blocks[b]));
      if (own == nullptr) continue;
      const ParticipantEstimate* const other =
          source.own(blocks[b].block, people[i], own_name(source, blocks[b], /*other=*/true));
      const double position =
          static_cast<double>(i) + 0.95 +
          0.36 * (static_cast<double>(b) - 0.5 * static_cast<double>(blocks.size() - 1));
      table.rows.push_back({static_cast<int>(b) + 1, blocks[b].block, position, people[i],
                            own->value, own->ci95.low, own->ci95.high, own->reason,
                            pse_words(source, {blocks[b]}), position + 0.13,
                            other == nullptr ? std::optional<double>() : other->value});
    }
  }
  return table;
}

/// The section that holds a figure of all these blocks: the first comparison if there is one.
std::string section_of(const StudyResults& results, const std::vector<BlockDesign>& blocks) {
  for (const ResultsSection& section : results.sections) {
    if (section.name.find("_against_") != std::string::npos) return section.name;
  }
  return blocks.front().block;
}

/// Fig. D.21.
std::optional<Figure> fractions_figure(const FigureSource& source,
                                       const std::vector<BlockDesign>& blocks) {
  FigureTable table = fractions_table(source, blocks);
  std::vector<double> values;
  int num_without = 0;
  for (const std::vector<FigureCell>& row : table.rows) {
    if (row[4].number) values.push_back(*row[4].number);
    if (row[10].number) values.push_back(*row[10].number);
    num_without += row[4].number ? 0 : 1;
  }
  if (values.empty()) return std::nullopt;
  AxisRange range = axis_range(values, /*logarithmic=*/true);
  range.low = std::max(range.low / 1.6, 1e-3);
  range.high = std::min(range.high * 1.6, 1e3);
  const std::vector<std::string> people = source.participants();
  Figure figure{.name = "weber_fractions",
                .section = section_of(source.results, blocks),
                .title = said("Weber fraction of every participant"),
                .thesis = said("Fig. D.21"),
                .height_in = 3.1};
  figure.plot = "  set logscale y\n  set yrange " + range_words(range) +
                "\n  set xrange [0.3:" + plot_number(static_cast<double>(people.size()) + 0.7) +
                "]\n" + named_tics("x", people, people.size() > 16) + "  set xlabel " +
                gnuplot_quoted(said("Participant")) + "\n" +
                "  set ytics (0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100)\n"
                "  set ylabel " +
                gnuplot_quoted(said("Weber fraction")) +
                "\n"
                "  set key outside top center horizontal reverse Left samplen 1.5\n";
  std::string plot = "  plot ";
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const int series = static_cast<int>(b) + 1;
    const std::string type = std::to_string(b % 7 + 1);
    // Open ends reach to the edge of the figure.
    const std::string low = "(valid(6) ? column('ci95_low') : " + plot_number(range.low) + ")";
    const std::string high =
        "(valid(7) ? column('ci95_high') : " + plot_number(range.high) + ")";
    plot += (b > 0 ? ", " : "") + from_table(table) +
            "'position':" + if_series(series, "weber_fraction") + ":" + low + ":" + high +
            " with yerrorbars lt " + type + " dt 1 pt " + (b == 0 ? "7" : "5") +
            " ps 0.6 title " + gnuplot_quoted(source.titles.short_title_of(blocks[b].block)) +
            ", " + from_table(table) +
            "'position_other_pse':" + if_series(series, "weber_fraction_other_pse") +
            " with points lt " + type + " pt " + (b == 0 ? "6" : "4") + " ps 0.6 title " +
            gnuplot_quoted(source.titles.short_title_of(blocks[b].block) +
                           (source.section(blocks[b].block)->own_fractions_free_pse
                                ? said(", PSE at the reference")
                                : ", PSE free"));
    const Estimate* const median =
        source.results.find(blocks[b].block + ".individual_weber_fraction_median");
    if (median != nullptr && median->value) {
      plot += ", " + plot_number(*median->value) + " with lines lt " + type + " lw 1";
    }
  }
  figure.plot += plot + "\n";
  figure.caption = said(
      "Maximum likelihood. Full marks: point of subjective equality (PSE) {}, with 95 % "
      "likelihood-ratio intervals, which go to the edge where the data do not bound them, and "
      "medians as horizontal lines. Open marks beside them: the other PSE, free or at the "
      "reference. ",
      pse_words(source, blocks));
  for (const BlockDesign& block : blocks) {
    const FitsBorne borne = fits_borne(*source.section(block.block), block.block);
    figure.caption +=
        said("{}: {} of {} with the PSE at the reference rejected by the answers. ",
             source.titles.short_title_of(block.block), std::to_string(borne.num_rejected),
             counted_words(borne.num_fits, "fit"));
  }
  figure.caption.pop_back();
  if (num_without > 0) {
    figure.caption +=
        said(" {} of their own that do not exist are left out; the tables say why.",
             counted_words(num_without, "fraction"));
  }
  figure.tables.push_back(std::move(table));
  return figure;
}

/// Fig. D.22.
std::optional<Figure> thresholds_figure(const FigureSource& source,
                                        const std::vector<BlockDesign>& blocks) {
  std::vector<BoxGroup> groups;
  std::vector<double> values;
  std::vector<std::string> titles;
  for (const BlockDesign& block : blocks) {
    const std::optional<double> reference = reference_of(source.data, block.block);
    BoxGroup group{.label = block.block, .position = static_cast<double>(groups.size()) + 1.0};
    for (const std::string& person : source.participants()) {
      const ParticipantEstimate* const own =
          source.own(block.block, person, own_name(source, block));
      if (own == nullptr || !own->value || !reference) continue;
      group.values.emplace_back(person, *own->value * *reference);
      values.push_back(*own->value * *reference);
    }
    titles.push_back(source.titles.short_title_of(block.block));
    groups.push_back(std::move(group));
  }
  if (values.empty()) return std::nullopt;
  const std::string& quantity = blocks.front().quantity;
  const std::string unit = experiments::quantity_unit(quantity);
  const bool of_thesis = is_of_thesis(source.results);
  Figure figure{
      .name = of_thesis ? "absolute_thresholds" : "difference_thresholds",
      .section = section_of(source.results, blocks),
      .title = said("Difference thresholds"),
      .caption =
          said("The difference from the reference that is told in 84.13 % of trials: Weber "
               "fraction, with the point of subjective equality {}, times the reference{}. One "
               "circle a participant; boxes: quartiles and median, whiskers to the last value "
               "within 1.5 interquartile ranges. Logarithmic axis.",
               pse_words(source, blocks),
               std::string(of_thesis ? said(" (Schmidt 2018 calls it the absolute threshold)")
                                     : "")),
      .thesis = said("Fig. D.22"),
      .width_in = std::min(6.6, 2.0 + 1.6 * static_cast<double>(blocks.size())),
      .height_in = 3.0};
  FigureTable boxes = box_table(figure.name + "_boxes", groups);
  FigureTable points = box_values_table(figure.name + "_values", groups);
  figure.plot =
      "  set logscale y\n  set yrange " +
      range_words(axis_range(values, /*logarithmic=*/true)) +
      "\n  set xrange [0.4:" + plot_number(static_cast<double>(blocks.size()) + 0.6) + "]\n" +
      named_tics("x", titles, false) + log_tics("y", axis_range(values, /*logarithmic=*/true)) +
      "  set ylabel " +
      gnuplot_quoted(said("Difference threshold{}", (unit.empty() ? "" : " [" + unit + "]"))) +
      "\n  plot " + box_plot_commands(boxes, points, 0.45) + "\n";
  figure.tables = {std::move(boxes), std::move(points)};
  return figure;
}

}  // namespace

std::vector<Figure> weber_figures(const FigureSource& source) {
  const std::vector<BlockDesign> blocks = discriminations(source);
  std::vector<Figure> figures;
  if (blocks.empty()) return figures;
  if (auto figure = fractions_figure(source, blocks)) figures.push_back(std::move(*figure));
  if (auto figure = thresholds_figure(source, blocks)) figures.push_back(std::move(*figure));
  return figures;
}

}  // namespace jnd::analysis
