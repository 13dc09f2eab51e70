#include "experiments/protocol/session_limit_rules.h"

#include <algorithm>
#include <string>
#include <utility>

#include "experiments/order/counterbalance.h"
#include "experiments/procedures/expected_session.h"
#include "experiments/procedures/practice.h"
#include "experiments/study/parameter_table.h"
#include "experiments/study/rule_values.h"

namespace jnd::experiments {
namespace {

/// Returns "`practice` at most 40, `staircase` about 60".
std::string words_of(const Stretch& stretch) {
  constexpr std::size_t kMost = 8;
  std::string words;
  for (std::size_t i = 0; i < stretch.blocks.size() && i < kMost; ++i) {
    const Stage& stage = *stretch.blocks[i];
    words += (i > 0 ? ", `" : "`") + shown_text(stage.name, 30) + "` " +
             expected_trials_words(std::get<Block>(stage.content));
  }
  return words + (stretch.blocks.size() > kMost ? " ..." : "");
}

}  // namespace

void check_session_limit_rules(const LocatedJson& file, const Study& study,
                               std::vector<StudyProblem>& problems) {
  const SessionLimits& limits = study.session_limits;
  if (!limits.max_duration_s && !limits.max_trials_without_break) return;
  double longest_s = 0.0;
  Stretch longest;
  for (const Cell& cell : cells_of(study)) {
    const std::vector<StageInstance> stages = stages_of(study, cell);
    longest_s = std::max(longest_s, expected_session_s(stages));
    const Stretch stretch = longest_stretch(stages);
    if (stretch.num_trials > longest.num_trials) longest = stretch;
  }
  const auto report = [&](const std::string& key, std::string message) {
    const std::string pointer = "/session_limits/" + key;
    const TextPosition position = file.value_position(pointer);
    add_problem(problems,
                {file.file(), position.line, position.column, pointer, std::move(message)});
  };
  if (limits.max_duration_s && longest_s > *limits.max_duration_s) {
    report("max_duration_s", "expected at least the " + plain_number(longest_s) +
                                 " s that the longest session is expected to take, found " +
                                 plain_number(*limits.max_duration_s) +
                                 "; shorten the study or raise the limit");
  }
  if (limits.max_trials_without_break &&
      longest.num_trials > *limits.max_trials_without_break) {
    report("max_trials_without_break",
           "expected at least " + std::to_string(longest.num_trials) +
               ", for so many trials are to be expected without a `break` (" +
               words_of(longest) + "), found " +
               std::to_string(*limits.max_trials_without_break) + "; put a break in between");
  }
}

}  // namespace jnd::experiments
