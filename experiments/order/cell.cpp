#include "experiments/order/cell.h"

#include <algorithm>
#include <numeric>
#include <string_view>
#include <utility>

#include "core/error.h"
#include "experiments/order/square_rows.h"
#include "experiments/order/stimulus_order.h"
#include "experiments/study/parameter_table.h"
#include "experiments/study/stage_walk.h"
#include "experiments/study/study_problem.h"

namespace jnd::experiments {
namespace {

using Arms = std::vector<std::string>;

constexpr std::string_view kRow = "row_";

OrderRows all_orders(std::size_t n) {
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t{0});
  OrderRows orders;
  do {
    orders.push_back(order);
  } while (std::next_permutation(order.begin(), order.end()));
  return orders;
}

/// Returns what a counterbalance can assign, each as a list of arms.
std::vector<Arms> alternatives(const Counterbalance& counterbalance) {
  std::vector<Arms> found;
  if (counterbalance.method == Counterbalance::Method::kOneOf) {
    for (const Counterbalance::Arm& arm : counterbalance.arms) found.push_back({arm.name});
    return found;
  }
  const std::size_t num_arms = counterbalance.arms.size();
  const bool is_latin = counterbalance.method == Counterbalance::Method::kLatin;
  for (const auto& order : is_latin        ? latin_rows(num_arms)
                           : num_arms <= 3 ? all_orders(num_arms)
                                           : williams_rows(num_arms)) {
    Arms arms;
    for (const std::size_t index : order) arms.push_back(counterbalance.arms[index].name);
    found.push_back(std::move(arms));
  }
  return found;
}

/// Adds the factor of a counterbalance or of a block's square.
void add_factor(const Stage& stage, std::vector<Factor>& factors) {
  if (const auto* counterbalance = std::get_if<Counterbalance>(&stage.content)) {
    factors.push_back({.name = stage.name,
                       .alternatives = alternatives(*counterbalance),
                       .stratify_by = counterbalance->stratify_by});
  }
  const auto* block = std::get_if<Block>(&stage.content);
  if (block == nullptr) return;
  const std::size_t num_rows = num_square_rows(block->order, block->intensities.size());
  if (num_rows == 0) return;
  factors.push_back({.name = stage.name, .alternatives = {}, .stratify_by = ""});
  for (std::size_t row = 1; row <= num_rows; ++row) {
    factors.back().alternatives.push_back({std::string(kRow) + std::to_string(row)});
  }
}

bool is_cell_of(const std::vector<Factor>& factors, const Cell& cell) {
  return std::equal(cell.begin(), cell.end(), factors.begin(), factors.end(),
                    [](const Assignment& given, const Factor& factor) {
                      const auto& known = factor.alternatives;
                      return given.counterbalance == factor.name &&
                             std::find(known.begin(), known.end(), given.arms) != known.end();
                    });
}

[[noreturn]] void refuse(const Study& study, const std::string& text) {
  throw core::Error("cell: expected one of the study `" + study.name + "`, found `" + text +
                    "`");
}

std::vector<std::string> parted(const std::string& text, char divider) {
  std::vector<std::string> parts;
  if (text.empty()) return parts;
  std::size_t begin = 0;
  for (std::size_t end = 0; end != std::string::npos; begin = end + 1) {
    end = text.find(divider, begin);
    parts.push_back(text.substr(begin, end - begin));
  }
  return parts;
}

/// Returns "`female` or `male`".
std::string values_words(const ParticipantField& field) {
  std::vector<std::string> values;
  for (const Option& option : field.options) values.push_back(option.value);
  return one_of_words(values);
}

}  // namespace

std::string to_string(const Cell& cell) {
  std::string text;
  for (const Assignment& assignment : cell) {
    if (!text.empty()) text += ';';
    text += assignment.counterbalance + '=';
    for (std::size_t i = 0; i < assignment.arms.size(); ++i) {
      text += (i > 0 ? "," : "") + assignment.arms[i];
    }
  }
  return text;
}

std::vector<Factor> factors_of(const Study& study) {
  std::vector<Factor> factors;
  for (const ParticipantField& field : study.participant_fields) {
    factors.push_back(
        {.name = field.name, .alternatives = {}, .is_field = true, .stratify_by = ""});
    for (const Option& option : field.options) {
      factors.back().alternatives.push_back({option.value});
    }
  }
  for_each_stage(study.stages, [&](const Stage& stage) { add_factor(stage, factors); });
  return factors;
}

std::vector<Cell> cells_of(const Study& study) {
  std::vector<Cell> cells = {{}};
  for (const Factor& factor : factors_of(study)) {
    std::vector<Cell> crossed;
    for (const Cell& cell : cells) {
      for (const Arms& arms : factor.alternatives) {
        crossed.push_back(cell);
        crossed.back().push_back({factor.name, arms});
      }
    }
    cells = std::move(crossed);
  }
  return cells;
}

Cell cell_from_text(const Study& study, const std::string& text) {
  Cell cell;
  for (const std::string& assignment : parted(text, ';')) {
    const std::size_t divider = assignment.find('=');
    if (divider == std::string::npos) refuse(study, text);
    cell.push_back(
        {assignment.substr(0, divider), parted(assignment.substr(divider + 1), ',')});
  }
  if (!is_cell_of(factors_of(study), cell)) refuse(study, text);
  return cell;
}

void require_cell(const Study& study, const Cell& cell) {
  if (!is_cell_of(factors_of(study), cell)) refuse(study, to_string(cell));
}

FieldValues field_values(const Study& study, const Cell& cell) {
  FieldValues values;
  for (const ParticipantField& field : study.participant_fields) {
    const Assignment* given = find_assignment(cell, field.name);
    if (given != nullptr) values[field.name] = given->arms.front();
  }
  return values;
}

std::string field_problem(const Study& study, const FieldValues& values) {
  std::vector<std::string> names;
  for (const ParticipantField& field : study.participant_fields) names.push_back(field.name);
  // A misspelt name is reported first, because the field that was meant lacks a value, too.
  for (const auto& [name, value] : values) {
    if (std::ranges::find(names, name) != names.end()) continue;
    return "expected a field of the study `" + study.name + "`, found `" + name + '`' +
           did_you_mean(name, names);
  }
  for (const ParticipantField& field : study.participant_fields) {
    const auto given = values.find(field.name);
    const bool is_known =
        given != values.end() &&
        std::any_of(field.options.begin(), field.options.end(),
                    [&](const Option& option) { return option.value == given->second; });
    if (is_known) continue;
    return "expected `" + field.name + "=VALUE`, VALUE being " + values_words(field) +
           ", found " + (given == values.end() ? "nothing" : '`' + given->second + '`');
  }
  return "";
}

std::size_t order_row(const Cell& cell, const std::string& block) {
  const Assignment* given = find_assignment(cell, block);
  if (given == nullptr || !given->arms.front().starts_with(kRow)) return 0;
  return std::stoul(given->arms.front().substr(kRow.size())) - 1;
}

const Assignment* find_assignment(const Cell& cell, const std::string& counterbalance) {
  for (const Assignment& assignment : cell) {
    if (assignment.counterbalance == counterbalance) return &assignment;
  }
  return nullptr;
}

Levels people_levels(const Cell& cell) {
  Levels levels;
  for (const Assignment& given : cell) {
    if (given.arms.size() == 1) levels[given.counterbalance] = given.arms.front();
  }
  return levels;
}

}  // namespace jnd::experiments
