#include <cmath>
#include <map>
#include <set>

#include "analysis/report/figures.h"
#include "analysis/report/plot_parts.h"
#include "analysis/results/magnitude_section.h"
#include "analysis/results/report_words.h"
#include "experiments/study/media.h"

namespace jnd::analysis {
namespace {

struct BlockMatches {
  const BlockDesign& block;
  FigureTable own, group, function;
  std::vector<double> standards, matches;  ///< All that is drawn, > 0.
  int num_participants = 0;
  std::string law;  ///< "k = 1.02, a = 0.98"; "" without a matching function.
};

/// Ascending; one of 0 has no place on a logarithmic axis.
std::set<double> standards_of(const StudyData& data, const std::string& block) {
  std::set<double> standards;
  for (const ParticipantData& participant : data.participants) {
    for (const core::TrialRow& trial : participant.trials_in(block)) {
      if (trial.reference_intensity.value_or(0.0) > 0.0) {
        standards.insert(*trial.reference_intensity);
      }
    }
  }
  return standards;
}

void add_own_matches(const FigureSource& source, const std::set<double>& standards,
                     BlockMatches& matches) {
  const std::string& block = matches.block.block;
  for (const std::string& participant : source.participants()) {
    const int series = matches.num_participants + 1;
    bool any = false;
    for (const double standard : standards) {
      const ParticipantEstimate* const own =
          source.own(block, participant, block + ".match_at_" + number_text(standard));
      if (own == nullptr || !own->value) continue;
      any = true;
      matches.own.rows.push_back({series, participant, standard, own->value});
      matches.matches.push_back(*own->value);
    }
    matches.num_participants += any ? 1 : 0;
  }
}

void add_group_matches(const FigureSource& source, const std::set<double>& standards,
                       BlockMatches& matches) {
  for (const double standard : standards) {
    const Estimate* const group =
        source.results.find(matches.block.block + ".match_at_" + number_text(standard));
    if (group == nullptr || !group->value) continue;
    matches.group.rows.push_back(
        {standard, group->value, group->ci95.low, group->ci95.high, group->n});
    matches.standards.push_back(standard);
  }
}

void add_function(const FigureSource& source, BlockMatches& matches) {
  constexpr int kPoints = 40;
  const Estimate* const k = source.results.find(matches.block.block + ".k");
  const Estimate* const a = source.results.find(matches.block.block + ".a");
  if (k == nullptr || a == nullptr || !k->value || !a->value) return;
  matches.law = "k = " + number_words(k->value, 3) + ", a = " + number_words(a->value, 3);
  // No further than there were standards.
  const double low = matches.standards.front(), high = matches.standards.back();
  for (int i = 0; i <= kPoints; ++i) {
    const double standard = low * std::pow(high / low, static_cast<double>(i) / kPoints);
    matches.function.rows.push_back({standard, *k->value * std::pow(standard, *a->value)});
  }
}

BlockMatches matches_of(const FigureSource& source, const BlockDesign& block) {
  const std::string name = file_word(block.block);
  BlockMatches matches{
      .block = block,
      .own = {.name = name + "_matches",
              .columns = {"series", "participant", "standard", "match"}},
      .group = {.name = name + "_group_matches",
                .columns = {"standard", "match", "ci95_low", "ci95_high", "num_participants"}},
      .function = {.name = name + "_matching_function", .columns = {"standard", "match"}}};
  const std::set<double> standards = standards_of(source.data, block.block);
  add_own_matches(source, standards, matches);
  add_group_matches(source, standards, matches);
  if (!matches.standards.empty()) add_function(source, matches);
  return matches;
}

std::string axis_words(const std::string& what, const std::string& quantity,
                       const std::string& medium) {
  const std::string unit = experiments::quantity_unit(quantity);
  return what + ": " + experiments::quantity_words(quantity) +
         (medium.empty() ? "" : " of “" + medium + "”") +
         (unit.empty() ? "" : " [" + unit + "]");
}

AxisRange shown_matches(const BlockMatches& matches) {
  std::vector<double> shown = matches.matches;
  for (const auto& row : matches.group.rows) {
    for (const std::size_t column : {1U, 2U, 3U}) {
      if (row[column].number) shown.push_back(*row[column].number);
    }
  }
  return axis_range(shown, /*logarithmic=*/true);
}

std::string caption_of(const BlockMatches& matches, bool has_identity) {
  return "Match over standard, both axes logarithmic. Grey: geometric means of each of " +
         counted_words(matches.num_participants, "participant") +
         " over repetitions and starting values. Squares: the group’s geometric means with "
         "their 95 % intervals (Student’s t in ln). " +
         (matches.law.empty() ? std::string("There is no matching function here.")
                              : "Black line: the matching function, match = k standardᵃ with " +
                                    matches.law + ".") +
         (has_identity ? " Dashed: identity, the match being the standard." : "");
}

Figure figure_of(const FigureSource& source, BlockMatches matches) {
  const BlockDesign& block = matches.block;
  const bool has_identity = block.standard_is_of_its_quantity();
  const AxisRange standards = axis_range(matches.standards, /*logarithmic=*/true);
  const AxisRange shown = shown_matches(matches);
  Figure figure{.name = file_word(block.block) + "_matches",
                .section = block.block,
                .title = "Matches, " + source.titles.title_of(block.block),
                .caption = caption_of(matches, has_identity),
                .width_in = 5.2,
                .height_in = 3.6};
  figure.plot = "  set logscale xy\n  set xrange " + range_words(standards) +
                "\n  set yrange " + range_words(shown) + "\n" + log_tics("x", standards) +
                log_tics("y", shown) + "  set xlabel " +
                gnuplot_quoted(axis_words("Standard", block.standard_quantity(),
                                          block.written.standard_medium)) +
                "\n  set ylabel " +
                gnuplot_quoted(axis_words("Match", block.quantity, block.medium)) +
                "\n  set key top left reverse Left samplen 2\n  plot ";
  if (has_identity) figure.plot += "x with lines ls 12 title 'identity', ";
  for (int series = 1; series <= matches.num_participants; ++series) {
    figure.plot += from_table(matches.own) + "'standard':" + if_series(series, "match") +
                   " with linespoints ls 10 ps 0.4" +
                   (series == 1 ? " title 'participants'" : "") + ", ";
  }
  if (!matches.law.empty()) {
    figure.plot += from_table(matches.function) + "'standard':'match' with lines ls 11 title " +
                   gnuplot_quoted("matching function, " + matches.law) + ", ";
  }
  // One participant has no interval.
  figure.plot += from_table(matches.group) +
                 "'standard':'match':(valid(3) ? column('ci95_low') : column('match')):"
                 "(valid(4) ? column('ci95_high') : column('match')) with yerrorbars ls 11 "
                 "lc rgb '#0072B2' ps 0.9 title 'geometric mean, 95 %'\n";
  figure.tables = {std::move(matches.own), std::move(matches.group)};
  if (!matches.function.rows.empty()) figure.tables.push_back(std::move(matches.function));
  return figure;
}

}  // namespace

std::vector<Figure> matching_figures(const FigureSource& source) {
  std::vector<Figure> figures;
  for (const BlockDesign& block : source.data.blocks) {
    if (!block.matches()) continue;
    BlockMatches matches = matches_of(source, block);
    if (matches.standards.empty()) continue;
    figures.push_back(figure_of(source, std::move(matches)));
  }
  return figures;
}

}  // namespace jnd::analysis
