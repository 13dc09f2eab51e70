#include <algorithm>
#include <limits>
#include <map>
#include <utility>

#include "analysis/results/block_words.h"
#include "app/language/words.h"
#include "app/operator/operated_session.h"
#include "app/operator/session_count.h"
#include "experiments/order/block_turns.h"
#include "experiments/procedures/expected_session.h"
#include "experiments/procedures/practice.h"
#include "experiments/procedures/procedure_registry.h"
#include "experiments/procedures/task.h"

// What the view of a session counts and lists. The blocks of a group count as one block here,
// because the block whose turn it is would tell which stimulus comes.

namespace jnd::app {

using namespace experiments;

namespace {

constexpr std::size_t kMostAnswersShown = 50;

Text instruction_of(const Stage& stage) {
  struct Instruction {
    Text operator()(const Explore& content) const { return content.instruction; }
    Text operator()(const Training& content) const { return content.instruction; }
    Text operator()(const Block& content) const { return content.instruction; }
    Text operator()(const Break& content) const { return content.instruction; }
    Text operator()(const Questionnaire& content) const { return content.instruction; }
    Text operator()(const Checklist&) const { return {}; }
    Text operator()(const Consent&) const { return {}; }
    Text operator()(const PostExperiment&) const { return {}; }
    Text operator()(const Counterbalance&) const { return {}; }
  };
  return std::visit(Instruction{}, stage.content);
}

}  // namespace

/// What is said at the beginning of the current stage. For a group, it is what is said about
/// each of its blocks, with each text once.
std::string OperatedSession::instructions() const {
  std::vector<std::string> told;
  for (const std::int64_t index : session_.current_stages()) {
    std::string text =
        words(instruction_of(*session_.stages().at(static_cast<std::size_t>(index))));
    if (!text.empty() && std::ranges::find(told, text) == told.end()) {
      told.push_back(std::move(text));
    }
  }
  std::string all;
  for (const std::string& text : told) all += (all.empty() ? "" : "\n") + text;
  return all;
}

/// What the procedures of the current stage say about its answers; "" for nothing.
std::string OperatedSession::cautions() const {
  std::string all;
  for (const std::int64_t index : session_.current_stages()) {
    const auto& its =
        std::get<Block>(session_.stages().at(static_cast<std::size_t>(index))->content);
    const std::string caution =
        procedure_named(its.procedure).caution(its, state().answered_in(index));
    if (!caution.empty()) all += (all.empty() ? "" : "; ") + caution;
  }
  return all;
}

/// Sets the number of the trial, and the number of all trials.
void OperatedSession::count_trials(TrialView& view) const {
  view.num_in_block = 0;
  view.in_block = 1;
  const bool is_group = state().num_together > 1;
  for (const std::int64_t index : session_.current_stages()) {
    int num = 0;
    for (const TrialState& trial : state().trials) {
      if (trial.stage != index || trial.is_void) continue;
      ++num;
      // The blocks of a group have repetitions of their own.
      if (!is_group) {
        view.num_repetitions = std::max(view.num_repetitions, trial.planned.repetition);
      }
      // Counts answers, because a trial that was put off comes later than its number says.
      if (trial.is_answered) ++view.in_block;
    }
    const auto& its =
        std::get<Block>(session_.stages().at(static_cast<std::size_t>(index))->content);
    if (analysis::length_is_expected(its) || its.practice) {
      view.num_is_expected = true;
      num = std::max(num, expected_trials(its));
    }
    view.num_in_block += num;
  }
}

/// The first of the stages that are run together with this one.
std::size_t OperatedSession::first_together(std::size_t stage) const {
  std::size_t first = 0;
  while (first + num_run_together(session_.stages(), first) <= stage) {
    first += num_run_together(session_.stages(), first);
  }
  return first;
}

/// The indices of all trials, stage by stage in the order in which they were drawn. Trials of a
/// group are in the order of their answers, followed by those without an answer.
std::vector<std::size_t> OperatedSession::trials_in_order() const {
  constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::max();
  std::vector<std::pair<std::pair<std::size_t, std::int64_t>, std::size_t>> places;
  for (std::size_t i = 0; i < state().trials.size(); ++i) {
    const TrialState& trial = state().trials[i];
    const auto stage = static_cast<std::size_t>(trial.stage);
    const bool is_mixed = session_.stages().at(stage)->interleaving.has_value();
    const std::int64_t place = !is_mixed           ? static_cast<std::int64_t>(i)
                               : trial.is_answered ? trial.answer_sequence
                                                   : kNever;
    places.push_back({{first_together(stage), place}, i});
  }
  std::ranges::sort(places);
  std::vector<std::size_t> order;
  for (const auto& [place, index] : places) order.push_back(index);
  return order;
}

std::vector<AnswerLine> OperatedSession::answer_lines() const {
  std::vector<AnswerLine> lines;
  const std::optional<std::int64_t> last = state().last_answered_trial();
  std::map<std::size_t, int> in_block;  // By the stage, or by the first stage of its group.
  for (const std::size_t i : trials_in_order()) {
    const TrialState& trial = state().trials[i];
    // The trial was never run.
    if (trial.is_void) continue;
    const auto its_stage = static_cast<std::size_t>(trial.stage);
    const int number = ++in_block[first_together(its_stage)];
    if (!trial.is_answered) continue;
    const Block& its_block = std::get<Block>(session_.stages().at(its_stage)->content);
    AnswerLine line{.trial = static_cast<std::int64_t>(i) + 1,
                    .in_block = number,
                    .block = title_of(its_stage),
                    .form = form_of(its_block),
                    .response_time_s = trial.measures.response_time_s.value_or(0.0)};
    const AnswerKind kind = line.form.kind;
    std::optional<double> given;
    if (trial.response) {
      given = answer_of(kind, trial.planned, *trial.response, trial.measures.chosen_interval);
    }
    line.answer = answer_in_words(its_block, given);
    line.can_undo = last == line.trial && state().is_under_way(trial.stage) && !state().ended;
    line.can_run_again = session_.can_run_again(line.trial) && !state().ended;
    lines.push_back(std::move(line));
  }
  std::reverse(lines.begin(), lines.end());
  if (lines.size() > kMostAnswersShown) lines.resize(kMostAnswersShown);
  for (AnswerLine& line : lines) {
    const TrialState& trial = state().trial(line.trial);
    line.hint = shown_doubts(doubts_about(given_answer(trial, line.form.kind, trial.response)));
  }
  return lines;
}

void OperatedSession::describe_progress(SessionView& view) const {
  const std::vector<const Stage*>& stages = session_.stages();
  double done_s = 0.0;
  double whole_s = 0.0;
  std::size_t next = 0;
  for (std::size_t i = 0; i < stages.size(); i = next) {
    next = i + num_run_together(stages, i);
    double expected_s = 0.0;
    for (std::size_t one = i; one < next; ++one) {
      expected_s += expected_duration_s(*stages[one]);
    }
    whole_s += expected_s;
    StageLine line{.title = title_of(i)};
    if (state().ended || static_cast<std::int64_t>(next) <= state().stage) {
      line.status = StageLine::Status::kDone;
      done_s += expected_s;
    } else if (static_cast<std::int64_t>(i) <= state().stage && begun_) {
      line.status = StageLine::Status::kNow;
      if (view.trial) {
        done_s += expected_s * (view.trial->in_block - 1) / view.trial->num_in_block;
      } else if (block() != nullptr && state().stage_open) {
        done_s += expected_s;
      }
    }
    view.stages.push_back(std::move(line));
  }
  view.elapsed_s =
      1e-9 * static_cast<double>(begun_ ? state().earlier_visits_ns : state().visited_ns()) +
      visit_s();
  const SessionCount count = count_of_session(state(), stages);
  view.trials_on_disk = count.num_answers;
  view.num_trials = count.num_trials;
  view.num_trials_is_expected = count.is_expected;
  view.left_s = std::max(0.0, whole_s - done_s);
  view.done_ratio = state().completed ? 1.0 : whole_s > 0.0 ? done_s / whole_s : 0.0;
}

}  // namespace jnd::app
