#include "experiments/protocol/level_doubts.h"

#include <algorithm>
#include <functional>
#include <nlohmann/json.hpp>

#include "experiments/protocol/study_check.h"
#include "experiments/study/rule_values.h"
#include "experiments/study/shown_text.h"
#include "experiments/study/stage_walk.h"

namespace jnd::experiments {
namespace {

using nlohmann::json;

class LevelDoubts : StudyCheck {
 public:
  LevelDoubts(const LocatedJson& file, std::string_view text, std::vector<StudyProblem>& doubts)
      : StudyCheck(file, doubts), text_(text) {}

  void run() {
    for_each_written_stage(file_.root(), [&](const json& stage, const std::string& pointer) {
      if (word(stage, "kind") != "block") return;
      check(stage, quantity_of(word(stage, "medium")), pointer);
      check(stage, standard_key(stage), pointer);
    });
  }

 private:
  void check(const json& block, const std::string& key, const std::string& pointer) {
    const json& levels = list(block, key);
    const bool are_numbers = std::ranges::all_of(levels, &json::is_number);
    if (!are_numbers || levels.size() < 2) return;
    const bool is_in_order = std::ranges::is_sorted(levels, std::less<>()) ||
                             std::ranges::is_sorted(levels, std::greater<>());
    const std::string place = pointer + '/' + key;
    if (is_in_order && !has_two_kinds_of_commas(levels, place)) return;
    report(place, "expected levels in order, with a comma and a space between them, found " +
                      shown_text(text_of(levels, place), 60) + ", which is " +
                      std::to_string(levels.size()) +
                      " levels; if a comma was to be a decimal one, write a point: " +
                      example_of(levels) + "; if the list is meant so, nothing is wrong");
  }

  /// Returns the list as it stands in the file.
  [[nodiscard]] std::string text_of(const json& levels, const std::string& place) const {
    const std::size_t begin = file_.value_position(place).byte;
    const std::string last = place + '/' + std::to_string(levels.size() - 1);
    const std::size_t end = text_.find(']', file_.value_position(last).byte);
    std::string shown;
    for (const char letter : text_.substr(begin, end + 1 - begin)) {
      const bool is_space = letter == '\n' || letter == '\r' || letter == '\t' || letter == ' ';
      if (!is_space) shown += letter;
      if (is_space && !shown.ends_with(' ')) shown += ' ';
    }
    return shown;
  }

  [[nodiscard]] bool has_two_kinds_of_commas(const json& levels,
                                             const std::string& place) const {
    bool any_tight = false, any_loose = false;
    for (std::size_t i = 0; i + 1 < levels.size(); ++i) {
      const std::size_t comma =
          text_.find(',', file_.value_position(place + '/' + std::to_string(i)).byte);
      if (comma == std::string_view::npos || comma + 1 >= text_.size()) continue;
      const char next = text_[comma + 1];
      (next == ' ' || next == '\n' || next == '\r' || next == '\t' ? any_loose : any_tight) =
          true;
    }
    return any_tight && any_loose;
  }

  /// Returns "6.5" for the first two whole numbers that may have been meant as one.
  static std::string example_of(const json& levels) {
    for (std::size_t i = 0; i + 1 < levels.size(); ++i) {
      const bool could_be_one = levels[i].is_number_integer() &&
                                levels[i + 1].is_number_unsigned() &&
                                levels[i + 1].get<double>() < levels[i].get<double>();
      if (could_be_one) return levels[i].dump() + "." + levels[i + 1].dump();
    }
    return "6.5";
  }

  std::string_view text_;
};

}  // namespace

std::vector<StudyProblem> level_doubts(const LocatedJson& file, std::string_view text) {
  std::vector<StudyProblem> doubts;
  LevelDoubts(file, text, doubts).run();
  return doubts;
}

}  // namespace jnd::experiments
