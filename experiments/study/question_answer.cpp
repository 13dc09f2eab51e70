#include "experiments/study/question_answer.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "experiments/study/parameter_table.h"

namespace jnd::experiments {
namespace {

bool is_within(const QuestionnaireItem& item, double value) {
  return !(item.minimum && value < *item.minimum) && !(item.maximum && value > *item.maximum);
}

std::string number_words(const QuestionnaireItem& item) {
  std::string words = "a number";
  if (item.minimum) words += " >= " + plain_number(*item.minimum);
  if (item.maximum) words += (item.minimum ? " and <= " : " <= ") + plain_number(*item.maximum);
  return words;
}

}  // namespace

std::optional<double> number_in(const std::string& text) {
  const std::size_t first = text.find_first_not_of(' ');
  if (first == std::string::npos) return std::nullopt;
  const char* const begin = text.data() + first;
  const char* const end = text.data() + text.find_last_not_of(' ') + 1;
  double value = 0.0;
  const auto [stopped, error] = std::from_chars(begin, end, value);
  const bool is_number = error == std::errc() && stopped == end && std::isfinite(value);
  return is_number ? std::optional(value) : std::nullopt;
}

std::optional<double> value_of_answer(const std::string& answer) {
  if (answer == "yes") return 1.0;
  return answer == "no" ? std::optional(0.0) : number_in(answer);
}

bool has_value(const QuestionnaireItem& item) {
  return item.kind == "scale" || item.kind == "number" || item.kind == "yes_no";
}

std::string expected_answer(const QuestionnaireItem& item, const std::string& answer) {
  if (!item.required && answer == kNoAnswer) return "";
  const bool has_words = answer.find_first_not_of(' ') != std::string::npos;
  if (item.kind == "number") {
    const std::optional<double> value = number_in(answer);
    return value && is_within(item, *value) ? "" : number_words(item);
  }
  if (item.kind == "scale") {
    const std::optional<double> step = number_in(answer);
    const bool is_step =
        step && *step == std::floor(*step) && *step >= 1.0 && *step <= item.num_steps;
    return is_step ? "" : "a step from 1 to " + std::to_string(item.num_steps);
  }
  if (item.kind == "choice") {
    std::vector<std::string> values;
    for (const Option& option : item.options) values.push_back(option.value);
    return std::ranges::find(values, answer) != values.end() ? "" : one_of_words(values);
  }
  if (item.kind == "yes_no") return answer == "yes" || answer == "no" ? "" : "yes or no";
  if (item.kind == "yes_no_which") {
    constexpr char kYesAnd[] = "yes: ";
    const bool is_answer = answer == "no" || (answer.starts_with(kYesAnd) &&
                                              answer.size() > std::string(kYesAnd).size());
    return is_answer ? "" : "no, or yes and which";
  }
  return has_words ? "" : "words";
}

}  // namespace jnd::experiments
