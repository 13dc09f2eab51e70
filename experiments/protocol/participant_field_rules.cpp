#include "experiments/protocol/participant_field_rules.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "experiments/protocol/study_check.h"
#include "experiments/study/rule_values.h"
#include "experiments/study/stage_walk.h"

namespace jnd::experiments {
namespace {

using nlohmann::json;

class FieldRules : StudyCheck {
 public:
  using StudyCheck::StudyCheck;

  void run() {
    const json& fields = list(file_.root(), "participant_fields");
    for (const json& field : fields) {
      if (field.is_object()) names_.push_back(word(field, "name"));
    }
    for_each_written_stage(file_.root(), [&](const json& stage, const std::string& pointer) {
      take_names(stage, pointer);
      check_stratified(word(stage, "stratify_by"), pointer + "/stratify_by");
    });
    for (std::size_t i = 0; i < fields.size(); ++i) {
      if (fields[i].is_object()) {
        check_field(fields[i], "/participant_fields/" + std::to_string(i));
      }
    }
  }

 private:
  void take_names(const json& stage, const std::string& pointer) {
    taken_.emplace(word(stage, "name"), pointer);
    const json& items = list(stage, "items");
    for (std::size_t i = 0; i < items.size(); ++i) {
      if (!items[i].is_object()) continue;
      taken_.emplace(word(items[i], "name"), pointer + "/items/" + std::to_string(i));
    }
  }

  void check_stratified(const std::string& field, const std::string& pointer) {
    if (field.empty()) return;
    used_.insert(field);
    if (std::find(names_.begin(), names_.end(), field) != names_.end()) return;
    has_unknown_ = true;
    report(pointer, "expected one of the study's `participant_fields`" +
                        (names_.empty() ? std::string() : ", " + names_words(names_)) +
                        ", found `" + shown_text(field) + "`" + did_you_mean(field, names_));
  }

  void check_field(const json& field, const std::string& pointer) {
    const std::string name = word(field, "name");
    if (name.empty()) return;
    const auto [first, is_new] = taken_.emplace(name, pointer);
    if (!is_new) {
      report(pointer + "/name", "expected a name that nothing else has, found `" +
                                    shown_text(name) + "`, the name of " + first->second);
    } else if (!used_.contains(name) && !has_unknown_) {
      report(pointer + "/name",
             "expected a field that a counterbalance is stratified by, found none with the "
             "`stratify_by` `" +
                 shown_text(name) + "`; what is only asked, a `questionnaire` asks");
    }
    std::set<std::string> values;
    const json& options = list(field, "options");
    for (std::size_t i = 0; i < options.size(); ++i) {
      if (!options[i].is_object() || word(options[i], "value").empty()) continue;
      if (values.insert(word(options[i], "value")).second) continue;
      report(pointer + "/options/" + std::to_string(i) + "/value",
             "expected each value of the field once, found `" +
                 shown_text(word(options[i], "value")) + "` a second time");
    }
  }

  std::vector<std::string> names_;  ///< Names of the fields.
  std::set<std::string> used_;      ///< Fields by which something is stratified.
  /// A stratification names an unknown field, which may have been meant for one of these.
  bool has_unknown_ = false;
  std::map<std::string, std::string> taken_;  ///< Name, with the pointer of what has it.
};

}  // namespace

void check_participant_field_rules(const LocatedJson& file,
                                   std::vector<StudyProblem>& problems) {
  FieldRules(file, problems).run();
}

}  // namespace jnd::experiments
