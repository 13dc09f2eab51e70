#include "experiments/protocol/sequential_rules.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "experiments/protocol/structure_check.h"
#include "experiments/protocol/study_check.h"
#include "experiments/study/rule_values.h"

namespace jnd::experiments {
namespace {

using nlohmann::json;

/// Returns the family of a contrast. Those that name none are in one family with the others of
/// their role.
std::string family_of(const json& contrast) {
  const std::string family = word(contrast, "family");
  return family.empty() ? word(contrast, "role") : family;
}

class SequentialRules : StudyCheck {
 public:
  using StudyCheck::StudyCheck;

  void run() {
    if (!file_.root().is_object()) return;
    const auto sequential = file_.root().find("sequential");
    if (sequential == file_.root().end() || !sequential->is_object()) return;
    check_looks(list(*sequential, "looks"));
    if (const std::string name = word(*sequential, "contrast"); !name.empty()) {
      check_contrast(name);
    }
  }

 private:
  void check_looks(const json& looks) {
    const json* last = nullptr;
    for (std::size_t i = 0; i < looks.size(); ++i) {
      if (!looks[i].is_number()) return;
      const std::string at = "/sequential/looks/" + std::to_string(i);
      const double look = looks[i].get<double>();
      if (look != std::floor(look)) {
        report(at, "expected a whole number of complete sessions, found " + looks[i].dump());
      } else if (last != nullptr && !(look > last->get<double>())) {
        report(at, "expected more complete sessions than at the look before, " + last->dump() +
                       ", found " + looks[i].dump());
      }
      last = &looks[i];
    }
  }

  void check_contrast(const std::string& name) {
    constexpr char kAt[] = "/sequential/contrast";
    std::vector<std::string> primary;
    const json* decides = nullptr;
    const json& contrasts = list(file_.root(), "contrasts");
    for (const json& contrast : contrasts) {
      if (!contrast.is_object()) continue;
      if (word(contrast, "role") == "primary") primary.push_back(word(contrast, "name"));
      if (word(contrast, "name") == name) decides = &contrast;
    }
    if (primary.empty()) {
      report(kAt,
             "expected one of the study's primary `contrasts`, of which there is none; plan "
             "the comparison that decides there");
      return;
    }
    if (decides == nullptr || word(*decides, "role") != "primary") {
      report(kAt, "expected one of the study's primary `contrasts`: " + names_words(primary) +
                      ", found `" + shown_text(name) + "`" + did_you_mean(name, primary));
      return;
    }
    for (const json& other : contrasts) {
      if (!other.is_object() || &other == decides) continue;
      if (family_of(other) != family_of(*decides)) continue;
      report(kAt,
             "expected a contrast that is alone in its family, for its alpha is spent over the "
             "looks, found `" +
                 shown_text(word(other, "name")) + "` in the family `" +
                 shown_text(family_of(other)) +
                 "`, too; give the contrast that decides a `family` of its own");
      return;
    }
  }
};

}  // namespace

void check_sequential_rules(const LocatedJson& file, std::vector<StudyProblem>& problems) {
  SequentialRules(file, problems).run();
}

}  // namespace jnd::experiments
