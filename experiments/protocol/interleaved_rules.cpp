#include "experiments/protocol/interleaved_rules.h"

#include <nlohmann/json.hpp>
#include <string>

#include "experiments/protocol/study_check.h"
#include "experiments/study/media.h"
#include "experiments/study/rule_values.h"
#include "experiments/study/stage_walk.h"

namespace jnd::experiments {
namespace {

using nlohmann::json;

class InterleavedRules : StudyCheck {
 public:
  using StudyCheck::StudyCheck;

  void run() {
    for_each_written_stage(file_.root(), [&](const json& stage, const std::string& pointer) {
      if (word(stage, "kind") == "interleaved") check_group(stage, pointer + "/blocks/");
    });
  }

 private:
  void check_group(const json& group, const std::string& at) {
    const json& blocks = list(group, "blocks");
    const json* first = nullptr;  // First of the blocks whose medium is known.
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      if (!blocks[i].is_object() || word(blocks[i], "kind") != "block") continue;
      const std::string here = at + std::to_string(i);
      check_block(blocks[i], here);
      if (quantity_of(word(blocks[i], "medium")).empty()) continue;
      if (first == nullptr) first = &blocks[i];
      check_movement(*first, blocks[i], here);
    }
  }

  void check_block(const json& block, const std::string& here) {
    if (block.contains("only_for")) {
      report(here + "/only_for",
             "expected this key on the whole group, found it on one of its blocks; write it "
             "beside `blocks`");
    }
    if (block.contains("practice")) {
      report(here + "/practice",
             "expected no practice among interleaved blocks, as it comes before what is "
             "practised, found one; put the block before the group");
    }
    if (word(object_at(block, "order"), "method") == "williams") {
      report(here + "/order/method",
             "expected `shuffled`, `mixed` or `latin` in an interleaved block, found "
             "`williams`; it balances which stimulus follows which, and trials of other blocks "
             "come in between");
    }
  }

  /// Refuses a mixture of pressing and stroking, because participants would have to be told
  /// before every trial how to move.
  void check_movement(const json& first, const json& block, const std::string& here) {
    const std::string medium = word(block, "medium"), other = word(first, "medium");
    if (is_pressed(medium) == is_pressed(other)) return;
    const auto movement = [](const std::string& name) {
      return is_pressed(name) ? "pressed" : "stroked";
    };
    report(here + "/medium",
           "expected a medium that is " + std::string(movement(other)) + " as `" + other +
               "` of `" + shown_text(word(first, "name")) + "`, found `" + medium +
               "`, which is " + movement(medium) +
               "; hands have to know how to move before they feel what comes, so put it into "
               "a block of its own");
  }
};

}  // namespace

void check_interleaved_rules(const LocatedJson& file, std::vector<StudyProblem>& problems) {
  InterleavedRules(file, problems).run();
}

}  // namespace jnd::experiments
