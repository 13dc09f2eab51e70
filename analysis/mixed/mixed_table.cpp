#include "analysis/mixed/mixed_table.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <set>
#include <unordered_map>

namespace jnd::analysis {
namespace {

/// Numbers the groups by the cells of one or several columns, in the order of their first rows.
void number_groups(const RandomTerm& term, const TrialTable& table, MixedTerm& to) {
  std::vector<const TrialVariable*> columns;
  for (const std::string& name : term.group_columns) columns.push_back(table.find(name));
  std::map<std::vector<std::uint32_t>, std::uint32_t> numbers;
  std::vector<std::uint32_t> key(columns.size());
  for (std::size_t row = 0; row < table.num_rows(); ++row) {
    for (std::size_t i = 0; i < columns.size(); ++i) key[i] = columns[i]->place[row];
    const auto next = static_cast<std::uint32_t>(numbers.size());
    to.place.push_back(numbers.try_emplace(key, next).first->second);
  }
  to.num_groups = numbers.size();
}

/// Splits the effects into one formula for each term, as `||` requires.
std::vector<Formula> uncorrelated(const Formula& effects) {
  std::vector<Formula> parts;
  Formula alone = effects;
  alone.terms.clear();
  if (effects.has_intercept) parts.push_back(alone);
  alone.has_intercept = false;
  for (const std::vector<std::size_t>& term : effects.terms) {
    alone.terms = {term};
    parts.push_back(alone);
  }
  return parts;
}

/// The design of a formula with only those variables that its terms use.
Design design_of(const Formula& formula, const TrialTable& table, Contrasts contrasts) {
  Formula needed = formula;
  needed.variables.clear();
  std::vector<std::size_t> place(formula.variables.size());
  for (std::size_t i = 0; i < formula.variables.size(); ++i) {
    const bool is_used = std::ranges::any_of(formula.terms, [i](const auto& term) {
      return std::ranges::find(term, i) != term.end();
    });
    place[i] = needed.variables.size();
    if (is_used) needed.variables.push_back(formula.variables[i]);
  }
  for (std::vector<std::size_t>& term : needed.terms) {
    for (std::size_t& variable : term) variable = place[variable];
  }
  return {needed, table, contrasts};
}

}  // namespace

std::vector<std::string> columns_of(const MixedFormulas& formulas) {
  std::vector<std::string> columns;
  const auto add = [&columns](const std::string& column) {
    if (std::ranges::find(columns, column) == columns.end()) columns.push_back(column);
  };
  for (const FormulaVariable& variable : formulas.fixed.variables) add(variable.column);
  for (const RandomTerm& term : formulas.random) {
    for (const FormulaVariable& variable : term.effects.variables) add(variable.column);
    for (const std::string& column : term.group_columns) add(column);
  }
  return columns;
}

FormulaError unknown_in(const MixedFormulas& formulas, const std::string& column,
                        const std::string& known) {
  const std::string sentence =
      "expected a column of the table, found " + column + ", and the table has " + known;
  for (const FormulaVariable& variable : formulas.fixed.variables) {
    if (variable.column == column) return {sentence, formulas.fixed.text, variable.at};
  }
  for (const RandomTerm& term : formulas.random) {
    for (const FormulaVariable& variable : term.effects.variables) {
      if (variable.column == column) return {sentence, term.effects.text, variable.at};
    }
    if (std::ranges::find(term.group_columns, column) != term.group_columns.end()) {
      const std::size_t at = term.effects.text.find(column, term.group_at);
      return {sentence, term.effects.text, at == std::string::npos ? term.group_at : at};
    }
  }
  return {sentence, formulas.fixed.text, 0};
}

std::string previous_stimulus(const std::string& stimulus) { return "previous_" + stimulus; }

std::size_t add_history(TrialTable& table, const std::string& stimulus,
                        const std::string& person) {
  const TrialVariable& shown = *table.find(stimulus);
  const TrialVariable& people = *table.find(person);
  TrialVariable before{.name = previous_stimulus(stimulus),
                       .cells = shown.cells,
                       .numbers = shown.numbers,
                       .place = {}};
  TrialVariable answer{
      .name = kPreviousAnswer, .cells = {"0", "1"}, .numbers = {0.0, 1.0}, .place = {}};
  std::unordered_map<std::uint32_t, std::size_t> last;
  std::vector<std::size_t> kept;
  for (std::size_t row = 0; row < table.num_rows(); ++row) {
    if (table.num_trials[row] != 1.0) {
      throw core::Error(
          "expected rows of one trial each, of which one comes before the other, found a row "
          "of several; --terms history needs trials");
    }
    const auto [found, is_first] = last.try_emplace(people.place[row], row);
    if (!is_first) {
      kept.push_back(row);
      before.place.push_back(shown.place[found->second]);
      answer.place.push_back(table.num_yes[found->second] > 0.0 ? 1 : 0);
      found->second = row;
    }
  }
  const std::size_t num_first = table.num_rows() - kept.size();
  const auto keep = [&kept](auto& values) {
    for (std::size_t i = 0; i < kept.size(); ++i) values[i] = values[kept[i]];
    values.resize(kept.size());
  };
  for (TrialVariable& variable : table.variables) keep(variable.place);
  keep(table.num_yes);
  keep(table.num_trials);
  table.variables.push_back(std::move(before));
  table.variables.push_back(std::move(answer));
  return num_first;
}

MixedData mixed_data(const MixedFormulas& formulas, const Design& fixed,
                     const TrialTable& table, Contrasts contrasts) {
  if (formulas.random.empty()) throw core::Error("expected a random term, found none");
  MixedData data{.names = fixed.names(),
                 .x = fixed.matrix(table),
                 .num_yes = table.num_yes,
                 .num_trials = table.num_trials,
                 .terms = {}};
  for (const RandomTerm& term : formulas.random) {
    const std::vector<Formula> parts =
        term.is_correlated ? std::vector{term.effects} : uncorrelated(term.effects);
    for (const Formula& part : parts) {
      const Design design = design_of(part, table, contrasts);
      if (design.names().empty()) {
        throw FormulaError("expected effects before the bar, found none", term.effects.text, 0);
      }
      MixedTerm one{.group = term.group,
                    .names = design.names(),
                    .z = design.matrix(table),
                    .place = {},
                    .num_groups = 0};
      number_groups(term, table, one);
      data.terms.push_back(std::move(one));
    }
  }
  return data;
}

namespace {

/// Whether some group has rows with different cells in the column.
bool varies_within(const TrialVariable& variable,
                   const std::vector<const TrialVariable*>& groups) {
  std::map<std::vector<std::uint32_t>, std::uint32_t> first;
  for (std::size_t row = 0; row < variable.place.size(); ++row) {
    std::vector<std::uint32_t> group;
    for (const TrialVariable* column : groups) group.push_back(column->place[row]);
    const auto known = first.try_emplace(std::move(group), variable.place[row]).first;
    if (known->second != variable.place[row]) return true;
  }
  return false;
}

}  // namespace

std::vector<EffectOfAll> effects_of_all(const MixedFormulas& formulas,
                                        const TrialTable& table) {
  std::vector<EffectOfAll> found;
  const std::set<std::string> groups = [&] {
    std::set<std::string> names;
    for (const RandomTerm& term : formulas.random) names.insert(term.group);
    return names;
  }();
  for (const std::string& group : groups) {
    std::set<std::string> random;
    std::vector<const TrialVariable*> columns;
    for (const RandomTerm& term : formulas.random) {
      if (term.group != group) continue;
      for (const FormulaVariable& one : term.effects.variables) random.insert(one.column);
      columns.clear();
      for (const std::string& column : term.group_columns)
        columns.push_back(table.find(column));
    }
    for (const FormulaVariable& variable : formulas.fixed.variables) {
      const TrialVariable* column = table.find(variable.column);
      if (column == nullptr || random.contains(variable.column)) continue;
      if (std::ranges::find(columns, nullptr) != columns.end()) continue;
      if (!varies_within(*column, columns)) continue;
      random.insert(variable.column);
      found.push_back({.effect = variable.name, .column = variable.column, .group = group});
    }
  }
  return found;
}

}  // namespace jnd::analysis
