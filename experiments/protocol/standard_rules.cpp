#include "experiments/protocol/standard_rules.h"

#include <map>
#include <utility>

#include "experiments/protocol/study_check.h"
#include "experiments/study/media.h"
#include "experiments/study/rule_values.h"

namespace jnd::experiments {
namespace {

using nlohmann::json;

class StandardRules : StudyCheck {
 public:
  StandardRules(const LocatedJson& file, const json& block, std::string pointer,
                std::vector<StudyProblem>& problems)
      : StudyCheck(file, problems), block_(block), at_(std::move(pointer) + '/') {}

  void run() {
    const std::string procedure = word(block_, "procedure");
    if (procedure == "matching") check_matching();
    if (procedure == "magnitude_estimation") check_modulus();
    check_each_once();
    check_touch();
  }

 private:
  void report(const std::string& key, std::string message) {
    StudyCheck::report(at_ + key, std::move(message));
  }

  [[nodiscard]] bool has_standard() const {
    const auto found = block_.find("standard_medium");
    return found != block_.end() && *found != "none";
  }
  [[nodiscard]] std::string found_words() const {
    return block_.contains("standard_medium") ? "`none`" : "nothing";
  }

  void check_matching() {
    if (has_standard()) return;
    report("standard_medium",
           "expected the medium of the standard, as `matching` compares with one, found " +
               found_words());
  }

  void check_modulus() {
    const std::string modulus = word(block_, "modulus");
    if (modulus == "standard" && !has_standard()) {
      report("standard_medium",
             "expected the medium of the standard, as `modulus` is `standard`, found " +
                 found_words());
    }
    if (modulus != "standard" && has_standard()) {
      report("standard_medium",
             "expected this key only where `modulus` is `standard`, found it where `modulus` "
             "is `" +
                 (modulus.empty() ? "water_is_100" : shown_text(modulus)) + "`");
    }
    if (const json& standards = list(block_, standard_key(block_)); standards.size() > 1) {
      report(standard_key(block_),
             "expected one standard, as `magnitude_estimation` has one, found a list of " +
                 std::to_string(standards.size()));
    }
    if (modulus == "standard" || modulus == "free") check_all_above_zero(modulus);
    if (is_pressed(word(block_, "medium")) && (modulus.empty() || modulus == "water_is_100")) {
      report("modulus",
             "expected `standard` or `free`, as water has no stiffness to be 100, found " +
                 std::string(modulus.empty() ? "nothing" : "`water_is_100`"));
    }
  }

  void check_all_above_zero(const std::string& modulus) {
    const std::string quantity = quantity_of(word(block_, "medium"));
    const json& stimuli = list(block_, quantity);
    for (std::size_t i = 0; i < stimuli.size(); ++i) {
      if (!stimuli[i].is_number() || stimuli[i].get<double>() != 0.0) continue;
      report(quantity + '/' + std::to_string(i),
             "expected a number > 0, as with the modulus `" + modulus +
                 "` every answer is above 0, found " + stimuli[i].dump());
    }
  }

  /// A solid is pressed and a fluid is stroked through. A participant can set one to feel as
  /// strong as the other, but a number for the ratio of a stiffness to a damping has no
  /// meaning.
  void check_touch() {
    if (word(block_, "procedure") == "matching") return;
    const std::string medium = word(block_, "medium");
    const std::string standard = word(block_, "standard_medium");
    if (find_medium(medium) == nullptr || find_medium(standard) == nullptr) return;
    if (is_pressed(standard) && !is_pressed(medium)) {
      report(
          "standard_medium",
          "expected a fluid, as numbers are ratios to the standard and the block's medium is "
          "one, found `" +
              shown_text(standard) + "`; `matching` compares both");
    }
    if (is_pressed(medium) && has_standard() && !is_pressed(standard)) {
      report(
          "standard_medium",
          "expected a solid, as numbers are ratios to the standard and the block's medium is "
          "one, found `" +
              shown_text(standard) + "`; `matching` compares both");
    }
  }

  void check_each_once() {
    const std::string key = standard_key(block_);
    std::map<double, std::size_t> seen;
    const json& standards = list(block_, key);
    for (std::size_t i = 0; i < standards.size(); ++i) {
      if (!standards[i].is_number()) continue;
      const auto [first, is_new] = seen.emplace(standards[i].get<double>(), i);
      if (is_new) continue;
      report(key + '/' + std::to_string(i), "expected each standard once, found " +
                                                standards[i].dump() + " at index " +
                                                std::to_string(first->second) + " already");
    }
  }

  const json& block_;
  std::string at_;
};

}  // namespace

void check_standard(const LocatedJson& file, const json& block, const std::string& pointer,
                    std::vector<StudyProblem>& problems) {
  StandardRules(file, block, pointer, problems).run();
}

}  // namespace jnd::experiments
