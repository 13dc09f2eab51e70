#include "analysis/report/answer_words.h"

#include <algorithm>
#include <charconv>

#include "analysis/results/number_words.h"
#include "analysis/words/said.h"

namespace jnd::analysis {

std::optional<double> number_of(const std::string& answer) {
  double value = 0.0;
  const char* const end = answer.data() + answer.size();
  const auto read = std::from_chars(answer.data(), end, value);
  if (read.ec != std::errc() || read.ptr != end) return std::nullopt;
  return value;
}

std::string item_words(const QuestionnaireItem& item) {
  if (!item.question.empty() && (item.kind == "yes_no" || spoken().code != "en")) {
    return item.question;
  }
  std::string words = item.name;
  if (!item.unit.empty() && words.ends_with("_" + item.unit)) {
    words.resize(words.size() - item.unit.size() - 1);
  }
  std::replace(words.begin(), words.end(), '_', ' ');
  return words;
}

std::string answer_words(const std::string& answer, const QuestionnaireItem& item) {
  if (const auto number = number_of(answer)) return shortest_words(*number);
  if (item.kind.starts_with("yes_no")) return said_of(answer);
  const auto option = std::ranges::find(item.options, answer);
  const auto place = static_cast<std::size_t>(option - item.options.begin());
  if (spoken().code != "en" && place < item.option_labels.size()) {
    return item.option_labels[place];
  }
  std::string words = answer;
  std::replace(words.begin(), words.end(), '_', ' ');
  return words;
}

}  // namespace jnd::analysis
