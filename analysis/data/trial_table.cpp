#include "analysis/data/trial_table.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <unordered_map>

#include "analysis/data/answer_rows.h"

namespace jnd::analysis {
namespace {

/// Collects the rows of a table. It knows the columns once it has the header.
class TrialCollector final : public RowSink {
 public:
  TrialCollector(std::string name, const TrialColumns& columns)
      : RowSink(std::move(name)),
        columns_(columns),
        places_of_cells_(columns.variables.size()) {
    for (const std::string& variable : columns.variables) {
      table_.variables.push_back({.name = variable, .cells = {}, .numbers = {}, .place = {}});
    }
  }

  void set_header(std::vector<std::string> header, int line) override {
    for (const std::string& variable : columns_.variables) {
      const auto found = std::ranges::find(header, variable);
      if (found == header.end()) throw UnknownColumn(problems().name(), variable, header);
      variables_.push_back(problems().place_of(variable, header, line));
    }
    yes_ = problems().place_of(columns_.answers.yes, header, line);
    if (columns_.answers.trials) {
      trials_ = problems().place_of(*columns_.answers.trials, header, line);
    }
    for (const auto& [name, cell] : columns_.where) {
      where_.push_back(problems().place_of(name, header, line));
    }
    problems().throw_problems();
  }

  void add_row(const std::vector<std::string_view>& cells, int line,
               bool decimal_comma) override {
    ++table_.num_rows_in_file;
    const auto cell = [&](std::size_t place) {
      return place < cells.size() ? cells[place] : std::string_view();
    };
    for (std::size_t i = 0; i < where_.size(); ++i) {
      if (!is_same_cell(cell(where_[i]), columns_.where[i].second, decimal_comma)) {
        ++table_.num_elsewhere;
        return;
      }
    }
    const std::string_view trials = trials_ ? cell(*trials_) : std::string_view();
    if (skips(cell(yes_), columns_.answers.yes)) return;
    if (trials_ && skips(trials, *columns_.answers.trials)) return;
    for (std::size_t i = 0; i < variables_.size(); ++i) {
      if (!is_none(cell(variables_[i])) && skips(cell(variables_[i]), columns_.variables[i])) {
        return;
      }
    }
    const std::optional<CountedAnswers> counted =
        counted_answers(columns_.answers, cell(yes_), trials, decimal_comma, line, problems());
    if (!counted) return;
    if (counted->num_trials == 0) {
      ++table_.num_without_trials;
      return;
    }
    table_.num_yes.push_back(static_cast<double>(counted->num_yes));
    table_.num_trials.push_back(static_cast<double>(counted->num_trials));
    for (std::size_t i = 0; i < variables_.size(); ++i) {
      add_cell(i, cell(variables_[i]), decimal_comma);
    }
  }

  [[nodiscard]] TrialTable finish() {
    problems().throw_problems();
    leave_out_numbers_that_are_none();
    return std::move(table_);
  }

 private:
  /// Whether a cell is "none" or "null". It may be the name of a condition, or stand for a
  /// missing number in Python or JSON. The other cells of its column decide.
  static bool is_none(std::string_view cell) noexcept {
    return same_word(cell, "none") || same_word(cell, "null");
  }

  /// Removes rows with such cells, in columns whose other cells are numbers.
  void leave_out_numbers_that_are_none() {
    std::vector<bool> stays(table_.num_rows(), true);
    for (const TrialVariable& variable : table_.variables) {
      std::size_t num_none = 0, num_numbers = 0;
      for (std::size_t i = 0; i < variable.cells.size(); ++i) {
        num_none += is_none(variable.cells[i]) ? 1 : 0;
        num_numbers += std::isnan(variable.numbers[i]) ? 0 : 1;
      }
      if (num_none == 0 || num_numbers == 0 || num_none + num_numbers < variable.cells.size()) {
        continue;
      }
      for (std::size_t row = 0; row < stays.size(); ++row) {
        if (!stays[row] || !is_none(variable.cell(row))) continue;
        stays[row] = false;
        ++table_.num_missing[variable.name];
      }
    }
    if (std::ranges::find(stays, false) == stays.end()) return;
    for (std::vector<double>* counts : {&table_.num_yes, &table_.num_trials}) {
      std::size_t num_kept = 0;
      for (std::size_t row = 0; row < stays.size(); ++row) {
        if (stays[row]) (*counts)[num_kept++] = (*counts)[row];
      }
      counts->resize(num_kept);
    }
    for (TrialVariable& variable : table_.variables) keep_rows(variable, stays);
  }

  /// Keeps only these rows, and only the cells that they use.
  static void keep_rows(TrialVariable& variable, const std::vector<bool>& stays) {
    constexpr std::uint32_t kNotThere = 0xFFFFFFFF;
    TrialVariable kept{.name = variable.name, .cells = {}, .numbers = {}, .place = {}};
    std::vector<std::uint32_t> moved(variable.cells.size(), kNotThere);
    for (std::size_t row = 0; row < stays.size(); ++row) {
      if (!stays[row]) continue;
      std::uint32_t& to = moved[variable.place[row]];
      if (to == kNotThere) {
        to = static_cast<std::uint32_t>(kept.cells.size());
        kept.cells.push_back(variable.cell(row));
        kept.numbers.push_back(variable.number(row));
      }
      kept.place.push_back(to);
    }
    variable = std::move(kept);
  }

  bool skips(std::string_view cell, const std::string& column) {
    if (!is_missing(cell)) return false;
    ++table_.num_missing[column];
    return true;
  }

  void add_cell(std::size_t index, std::string_view cell, bool decimal_comma) {
    TrialVariable& variable = table_.variables[index];
    text_ = cell;
    const auto [found, is_new] = places_of_cells_[index].try_emplace(
        text_, static_cast<std::uint32_t>(variable.cells.size()));
    if (is_new) {
      variable.cells.push_back(text_);
      variable.numbers.push_back(number_of(cell, decimal_comma));
    }
    variable.place.push_back(found->second);
  }

  const TrialColumns& columns_;
  TrialTable table_;
  std::size_t yes_ = 0;
  std::optional<std::size_t> trials_;
  std::vector<std::size_t> variables_, where_;
  std::vector<std::unordered_map<std::string, std::uint32_t>> places_of_cells_;
  std::string text_;
};

}  // namespace

bool TrialVariable::is_numeric() const noexcept {
  return std::ranges::none_of(numbers, [](double number) { return std::isnan(number); });
}

const TrialVariable* TrialTable::find(std::string_view name) const noexcept {
  const auto found = std::ranges::find(variables, name, &TrialVariable::name);
  return found == variables.end() ? nullptr : &*found;
}

std::vector<TrialGroup> groups_of(const TrialTable& table,
                                  const std::vector<std::string>& columns) {
  std::vector<const TrialVariable*> by, kept;
  for (const std::string& column : columns) by.push_back(table.find(column));
  for (const TrialVariable& variable : table.variables) {
    if (std::ranges::find(columns, variable.name) == columns.end()) kept.push_back(&variable);
  }
  constexpr std::uint32_t kNotThere = 0xFFFFFFFF;
  std::vector<TrialGroup> groups;
  /// For each group and kept variable, the indices of the table's cells among the group's
  /// cells.
  std::vector<std::vector<std::vector<std::uint32_t>>> places;
  std::map<std::vector<std::uint32_t>, std::size_t> known;
  for (std::size_t row = 0; row < table.num_rows(); ++row) {
    std::vector<std::uint32_t> cells;
    for (const TrialVariable* variable : by) cells.push_back(variable->place[row]);
    const auto [found, is_new] = known.try_emplace(cells, groups.size());
    const std::size_t place = found->second;
    if (is_new) {
      TrialGroup& group = groups.emplace_back();
      for (const TrialVariable* variable : by) {
        group.key.emplace_back(variable->name, variable->cell(row));
      }
      places.emplace_back();
      for (const TrialVariable* variable : kept) {
        group.table.variables.push_back(
            {.name = variable->name, .cells = {}, .numbers = {}, .place = {}});
        places.back().emplace_back(variable->cells.size(), kNotThere);
      }
    }
    TrialTable& to = groups[place].table;
    to.num_yes.push_back(table.num_yes[row]);
    to.num_trials.push_back(table.num_trials[row]);
    for (std::size_t i = 0; i < kept.size(); ++i) {
      TrialVariable& variable = to.variables[i];
      std::uint32_t& cell = places[place][i][kept[i]->place[row]];
      if (cell == kNotThere) {
        cell = static_cast<std::uint32_t>(variable.cells.size());
        variable.cells.push_back(kept[i]->cell(row));
        variable.numbers.push_back(kept[i]->number(row));
      }
      variable.place.push_back(cell);
    }
  }
  return groups;
}

UnknownColumn::UnknownColumn(const std::string& where, std::string missing,
                             const std::vector<std::string>& header)
    : core::Error(where + ": " + missing +
                  ": expected a column of this name, found the columns " +
                  shown_columns(header)),
      column(std::move(missing)),
      known(shown_columns(header)) {}

TrialTable read_trial_table(const std::filesystem::path& file, const TrialColumns& columns) {
  TrialCollector collector(file.string(), columns);
  read_rows(file, collector);
  return collector.finish();
}

TrialTable parse_trial_table(std::string_view text, const std::string& name,
                             const TrialColumns& columns) {
  TrialCollector collector(name, columns);
  parse_rows(text, collector);
  return collector.finish();
}

}  // namespace jnd::analysis
