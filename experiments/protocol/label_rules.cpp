#include "experiments/protocol/label_rules.h"

#include <map>
#include <string>
#include <utility>

#include "experiments/protocol/study_check.h"
#include "experiments/study/rule_values.h"
#include "experiments/study/stage_walk.h"

namespace jnd::experiments {
namespace {

using nlohmann::json;

class LabelRules : StudyCheck {
 public:
  using StudyCheck::StudyCheck;

  void run() {
    for_each_written_stage(file_.root(), [&](const json& stage, const std::string& pointer) {
      check_pair(stage, pointer, "yes_label", "no_label");
      Labels intervals;
      for (const char* const key : {"first_label", "second_label", "third_label"}) {
        add(intervals, object_at(stage, key), pointer + '/' + key);
      }
      check_pair(stage, pointer, "low_label", "high_label");
      for (const char* const key : {"items", "questions"}) {
        check_items(list(stage, key), pointer + '/' + key);
      }
    });
  }

 private:
  void check_items(const json& items, const std::string& pointer) {
    for (std::size_t i = 0; i < items.size(); ++i) {
      if (!items[i].is_object()) continue;
      const std::string item = pointer + '/' + std::to_string(i);
      check_pair(items[i], item, "low_label", "high_label");
      Labels labels;
      const json& options = list(items[i], "options");
      for (std::size_t j = 0; j < options.size(); ++j) {
        if (!options[j].is_object()) continue;
        add(labels, object_at(options[j], "label"),
            item + "/options/" + std::to_string(j) + "/label");
      }
    }
  }

  void check_pair(const json& object, const std::string& pointer, const std::string& first,
                  const std::string& second) {
    Labels labels;
    add(labels, object_at(object, first), pointer + '/' + first);
    add(labels, object_at(object, second), pointer + '/' + second);
  }

  /// Language and words, with the pointer of the label that has them.
  using Labels = std::map<std::pair<std::string, std::string>, std::string>;

  void add(Labels& labels, const json& text, const std::string& pointer) {
    for (const auto& [language, words] : text.items()) {
      if (language == "comment" || !words.is_string()) continue;
      const auto [first, is_new] =
          labels.emplace(std::pair(language, words.get<std::string>()), pointer);
      if (is_new) continue;
      const std::string here = pointer + '/' + pointer_token(language);
      report(here, "expected words of its own, so that answers can be told apart, found \"" +
                       shown_text(words.get<std::string>()) + "\", as in " + first->second);
    }
  }
};

}  // namespace

void check_label_rules(const LocatedJson& file, std::vector<StudyProblem>& problems) {
  LabelRules(file, problems).run();
}

}  // namespace jnd::experiments
