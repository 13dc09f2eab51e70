#include <algorithm>
#include <cstdlib>
#include <map>
#include <set>

#include "analysis/statistics/summary.h"
#include "app/language/words.h"
#include "app/operator/results_model.h"
#include "app/operator/study_words.h"
#include "experiments/study/media.h"

namespace jnd::app {
namespace {

using namespace results;
using analysis::BlockDesign;
using analysis::ParticipantData;
using Values = std::vector<std::pair<std::string, double>>;

/// The participants' own estimates of this name, of those who have one.
Values own_values(const ResultsSource& source, const std::string& block,
                  const std::string& estimate) {
  Values values;
  const analysis::ResultsSection* section = source.section(block);
  if (section == nullptr) return values;
  for (const analysis::ParticipantEstimate& own : section->participants) {
    if (own.name == estimate && own.value) values.emplace_back(own.participant, *own.value);
  }
  return values;
}

/// True if the block's primary value is computed with the pse free, so that its own fractions
/// are, too.
bool has_free_pse(const ResultsSource& source, const BlockDesign& block) {
  const analysis::ResultsSection* section = source.section(block.block);
  return section != nullptr && section->own_fractions_free_pse;
}

using MovementColumn = std::optional<double> core::PresentationMeasures::*;

Values movement_values(const ResultsSource& source, const std::string& block,
                       MovementColumn column) {
  Values values;
  for (const ParticipantData& participant : source.data.participants) {
    const auto found = participant.presentations.find(block);
    if (found == participant.presentations.end()) continue;
    if (const auto mean = analysis::movement_mean(found->second, column)) {
      values.emplace_back(participant.participant, *mean);
    }
  }
  return values;
}

void add_box(BoxFigure& figure, const std::string& label, const Values& values) {
  if (!values.empty()) figure.boxes.push_back(box_of(label, values));
}

/// The participants' own matches, by the standard in the names of estimates such as
/// "match_at_8".
std::map<std::string, Values> matches_of(const ResultsSource& source,
                                         const std::string& block) {
  std::map<std::string, Values> matches;
  const analysis::ResultsSection* section = source.section(block);
  if (section == nullptr) return matches;
  const std::string start = block + ".match_at_";
  for (const analysis::ParticipantEstimate& own : section->participants) {
    if (!own.name.starts_with(start) || !own.value) continue;
    matches[own.name.substr(start.size())].emplace_back(own.participant, *own.value);
  }
  return matches;
}

/// Adds a box for each standard, block after block.
void add_matches(const ResultsSource& source, const BlockDesign& block, BoxFigure& figure) {
  const auto num_blocks =
      std::ranges::count(source.data.blocks, "matching", &BlockDesign::procedure);
  const std::string title = short_title(source.title(block.block));
  const std::string unit = experiments::quantity_unit(block.quantity);
  figure.unit = figure.unit.empty() || figure.unit == unit ? unit : "";
  std::vector<std::pair<double, std::string>> standards;
  const std::map<std::string, Values> matches = matches_of(source, block.block);
  for (const auto& [standard, values] : matches) {
    standards.emplace_back(std::strtod(standard.c_str(), nullptr), standard);
  }
  std::ranges::sort(standards);
  for (const auto& [number, standard] : standards) {
    const std::string label = tr("to {}", standard);
    add_box(figure, num_blocks > 1 ? title + ", " + label : label, matches.at(standard));
  }
}

std::optional<double> whole_movement(const ParticipantData& participant,
                                     MovementColumn column) {
  std::vector<core::PresentationRow> all;
  for (const auto& [block, rows] : participant.presentations) {
    all.insert(all.end(), rows.begin(), rows.end());
  }
  return analysis::movement_mean(all, column);
}

bool is_magnitude(const BlockDesign& block) { return block.estimates() || block.produces(); }

/// The column's title, such as "w Group D" or "a estimation": the number, and what
/// distinguishes it from others of its kind.
std::string column_title(const ResultsSource& source, const BlockDesign& block) {
  const auto same = std::count_if(
      source.data.blocks.begin(), source.data.blocks.end(),
      [&](const BlockDesign& other) { return other.procedure == block.procedure; });
  std::string title = short_title(source.title(block.block));
  if (block.detects()) return title;
  if (block.matches()) {
    return block.standard_is_of_its_quantity() ? tr("ratio {}", title) : tr("a {}", title);
  }
  if (!is_magnitude(block)) return tr("w {}", title);
  if (same > 1) return tr("a {}", title);
  return block.estimates() ? tr("a estimation") : tr("a production");
}

/// The ending of the participants' own estimate that corresponds to the block's primary value;
/// "" for no column.
std::string column_estimate(const ResultsSource& source, const BlockDesign& block) {
  if (block.compares() && has_free_pse(source, block)) return ".weber_fraction_free_pse";
  if (block.compares() || block.tells_apart()) return ".weber_fraction";
  if (block.detects()) return ".threshold";
  if (block.matches()) return block.standard_is_of_its_quantity() ? ".ratio_to_standard" : ".a";
  return is_magnitude(block) ? ".a" : "";
}

/// What was left out of this person's data and what is doubtful in them, each thing once. It
/// does not say who lacks a fraction with the pse treated the other way; the tests say that.
std::string note_of(const ResultsSource& source, const std::string& participant) {
  std::set<std::string> known;
  std::string note;
  const auto add = [&](const std::string& whose, const std::string& words) {
    if (whose != participant || !known.insert(words).second) return;
    note += (note.empty() ? "" : "; ") + source.in_titles(words);
  };
  for (const analysis::ResultsSection& section : source.results.sections) {
    if (section.name.find("_against_") != std::string::npos) continue;
    for (const auto& one : section.excluded) add(one.participant, one.reason);
    for (const auto& one : section.cautions) add(one.participant, one.caution);
  }
  return note;
}

}  // namespace

Box box_of(const std::string& label, const Values& values) {
  std::vector<double> numbers;
  for (const auto& [participant, value] : values) numbers.push_back(value);
  Box box{.label = label,
          .plot = analysis::box_plot_of(numbers),
          .n = static_cast<int>(values.size())};
  for (const auto& [participant, value] : values) {
    if (value < box.plot.lower_whisker || value > box.plot.upper_whisker) {
      box.outliers.push_back({participant, value});
    }
  }
  return box;
}

std::vector<BoxFigure> boxes_of(const ResultsSource& source) {
  BoxFigure weber{.name = "weber_fraction", .title = tr("Weber fraction"), .unit = ""};
  BoxFigure exponent{.name = "exponent", .title = tr("Exponent"), .unit = ""};
  BoxFigure match{.name = "match", .title = tr("Match to a standard"), .unit = ""};
  BoxFigure stroke{.name = "stroke_width_m", .title = tr("Stroke width"), .unit = "m"};
  BoxFigure speed{.name = "max_speed_m_per_s", .title = tr("Largest speed"), .unit = "m/s"};
  for (const BlockDesign& block : source.data.blocks) {
    const std::string label = short_title(source.title(block.block));
    if (block.compares() || block.tells_apart()) {
      const bool free_pse = has_free_pse(source, block);
      add_box(weber, free_pse ? tr("{}, pse free", label) : label,
              own_values(source, block.block, block.block + column_estimate(source, block)));
    }
    if (is_magnitude(block)) {
      add_box(exponent, label, own_values(source, block.block, block.block + ".a"));
    }
    if (block.matches()) add_matches(source, block, match);
    add_box(stroke, label,
            movement_values(source, block.block, &core::PresentationMeasures::stroke_width_m));
    add_box(
        speed, label,
        movement_values(source, block.block, &core::PresentationMeasures::max_speed_m_per_s));
  }
  std::vector<BoxFigure> figures;
  for (BoxFigure* figure : {&weber, &exponent, &match, &stroke, &speed}) {
    if (!figure->boxes.empty()) figures.push_back(std::move(*figure));
  }
  return figures;
}

void add_table(const ResultsSource& source, ResultsModel& model) {
  for (const BlockDesign& block : source.data.blocks) {
    if (column_estimate(source, block).empty()) continue;
    model.columns.push_back(
        {column_title(source, block),
         block.detects() ? experiments::quantity_unit(block.quantity) : ""});
  }
  model.columns.push_back({tr("Stroke"), "m"});
  model.columns.push_back({tr("Speed"), "m/s"});
  for (const ParticipantData& participant : source.data.participants) {
    TableRow row{.participant = participant.participant};
    for (const BlockDesign& block : source.data.blocks) {
      const std::string estimate = column_estimate(source, block);
      if (estimate.empty()) continue;
      const analysis::ParticipantEstimate* own =
          source.own(block.block, participant.participant, block.block + estimate);
      row.values.push_back(own != nullptr ? own->value : std::nullopt);
    }
    row.values.push_back(
        whole_movement(participant, &core::PresentationMeasures::stroke_width_m));
    row.values.push_back(
        whole_movement(participant, &core::PresentationMeasures::max_speed_m_per_s));
    row.note = note_of(source, participant.participant);
    model.rows.push_back(std::move(row));
  }
}

}  // namespace jnd::app
