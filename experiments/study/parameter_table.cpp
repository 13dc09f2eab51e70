#include "experiments/study/parameter_table.h"

#include <charconv>
#include <cmath>

namespace jnd::experiments {

const Parameter* ParameterTable::find(std::string_view key) const noexcept {
  for (const Parameter& parameter : parameters) {
    if (parameter.key == key) return &parameter;
  }
  return nullptr;
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
      return list + "stages";
    case ValueKind::kArms:
      return R"(an object such as {"priming": "primed"})";
  }
  return "";
}

}  // namespace jnd::experiments
