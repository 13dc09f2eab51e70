#include "experiments/study/parameter_table.h"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>

namespace jnd::experiments {

const Parameter* ParameterTable::find(std::string_view key) const noexcept {
  for (const Parameter& parameter : parameters) {
    if (parameter.key == key) return &parameter;
  }
  return nullptr;
}

std::vector<const ParameterTable*> tables_below(const ParameterTable& root) {
  std::vector<const ParameterTable*> tables = {&root};
  for (std::size_t next = 0; next < tables.size(); ++next) {
    for (const Parameter& parameter : tables[next]->parameters) {
      const bool is_new = parameter.nested != nullptr &&
                          std::ranges::find(tables, parameter.nested) == tables.end();
      if (is_new) tables.push_back(parameter.nested);
    }
  }
  return tables;
}

ParameterTable measured_table(const Parameter& parameter) {
  return {.name = "measured",
          .meaning = "A measured value and how surely it is known.",
          .parameters = {{.key = "value",
                          .kind = ValueKind::kNumber,
                          .meaning = "What was measured.",
                          .unit = parameter.unit,
                          .range = parameter.range},
                         {.key = "ci95",
                          .kind = ValueKind::kNumbers,
                          .meaning = "Lower and upper end of the interval that holds the true "
                                     "value with 95 %.",
                          .unit = parameter.unit,
                          .min_items = 2,
                          .max_items = 2}}};
}

bool is_date(std::string_view text) noexcept {
  if (text.size() != 10 || text[4] != '-' || text[7] != '-') return false;
  const auto number = [text](std::size_t begin, std::size_t length) {
    unsigned value = 0;
    const char* end = text.data() + begin + length;
    const auto [stop, error] = std::from_chars(text.data() + begin, end, value);
    return error == std::errc() && stop == end ? static_cast<int>(value) : -1;
  };
  const int year = number(0, 4), month = number(5, 2), day = number(8, 2);
  if (year < 1 || month < 1 || day < 1) return false;
  return std::chrono::year_month_day(std::chrono::year(year),
                                     std::chrono::month(static_cast<unsigned>(month)),
                                     std::chrono::day(static_cast<unsigned>(day)))
      .ok();
}

const Parameter& comment_parameter() {
  static const Parameter kComment = {
      .key = "comment",
      .kind = ValueKind::kString,
      .meaning = "A note to whoever reads the file. Allowed in every object, without effect.",
      .required = false};
  return kComment;
}

std::string plain_number(double value) {
  char digits[32];
  const double size = std::abs(value);
  const bool has_few_zeros = value == 0.0 || (size >= 1e-6 && size < 1e15);
  const auto end = has_few_zeros ? std::to_chars(digits, digits + sizeof digits, value,
                                                 std::chars_format::fixed)
                                 : std::to_chars(digits, digits + sizeof digits, value);
  return {digits, end.ptr};
}

std::string one_of_words(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) text += i + 1 == words.size() ? " or " : ", ";
    text += '`' + words[i] + '`';
  }
  return text;
}

std::string item_count(const Parameter& parameter) {
  if (parameter.min_items == parameter.max_items) {
    return std::to_string(parameter.min_items) + ' ';
  }
  return parameter.min_items > 1 ? std::to_string(parameter.min_items) + " or more " : "";
}

std::string number_expectation(const Parameter& parameter) {
  const bool whole = parameter.kind == ValueKind::kInteger;
  std::string text = whole ? "a whole number" : "a number";
  const Range& range = parameter.range;
  if (whole && range.low == range.high) return plain_number(range.low);
  const bool has_low = range.low > -std::numeric_limits<double>::infinity();
  if (has_low) text += (range.low_is_open ? " > " : " >= ") + plain_number(range.low);
  if (range.high < std::numeric_limits<double>::infinity()) {
    text += std::string(has_low ? " and" : "") + " <= " + plain_number(range.high);
  }
  if (!parameter.unit.empty()) text += " (" + parameter.unit + ")";
  return text;
}

std::string expectation(const Parameter& parameter) {
  const std::string count = item_count(parameter);
  const std::string list = parameter.min_items == 1 && count.empty() ? "a list of one or more "
                                                                     : "a list of " + count;
  switch (parameter.kind) {
    case ValueKind::kString:
      if (parameter.may_be_empty) return "a text in quotes, which may be empty";
      return parameter.allowed.empty() ? "a text in quotes" : one_of_words(parameter.allowed);
    case ValueKind::kName:
      return "a name of at most 64 lower-case letters, digits and _";
    case ValueKind::kText:
      return R"(a text by language such as {"en": "..."})";
    case ValueKind::kNumber:
    case ValueKind::kInteger:
      return number_expectation(parameter);
    case ValueKind::kBoolean:
      return "true or false";
    case ValueKind::kDate:
      return "a date such as 2026-11-25";
    case ValueKind::kMeasured:
      return R"(an object such as {"value": 1.02, "ci95": [1.01, 1.03]})";
    case ValueKind::kNumbers:
      return list + "numbers";
    case ValueKind::kStrings:
      return list + "texts in quotes";
    case ValueKind::kTexts:
      return list + R"(texts by language such as {"en": "..."})";
    case ValueKind::kObject:
      return "an object";
    case ValueKind::kObjects:
      return list + "objects";
    case ValueKind::kStages:
      return list + (parameter.allowed.empty()
                         ? "stages"
                         : "stages of kind " + one_of_words(parameter.allowed));
    case ValueKind::kArms:
      return R"(an object such as {"priming": "primed"})";
    case ValueKind::kLevels:
      return R"(an object such as {"fluid": "thin"})";
    case ValueKind::kWeights:
      return R"(an object such as {"fluid": {"thin": 1, "thick": -1}})";
  }
  return "";
}

}  // namespace jnd::experiments
