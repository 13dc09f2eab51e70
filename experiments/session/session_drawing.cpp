// What a session draws: the trials of its blocks, and the turns of interleaved blocks. Every
// draw is an event and uses a stream of the session's seed, so an interrupted session continues
// as it would have.

#include <algorithm>

#include "core/error.h"
#include "core/random_stream.h"
#include "experiments/procedures/practice.h"
#include "experiments/procedures/procedure_registry.h"
#include "experiments/session/session.h"

namespace jnd::experiments {

std::vector<std::int64_t> Session::current_stages() const {
  const auto num_stages = static_cast<std::int64_t>(parameters_.stages.size());
  if (current_stage() == nullptr) return {};
  std::int64_t first = state_.stage, num = 1;
  if (state_.stage_open) {
    first = state_.first_together;
    num = state_.num_together;
  } else {
    num = static_cast<std::int64_t>(
        num_run_together(parameters_.stages, static_cast<std::size_t>(first)));
  }
  std::vector<std::int64_t> stages;
  for (std::int64_t stage = first; stage < std::min(first + num, num_stages); ++stage) {
    stages.push_back(stage);
  }
  return stages;
}

void Session::enter_stage() {
  const Stage* stage = current_stage();
  if (stage == nullptr || state_.stage_open || state_.ended) {
    throw core::Error(
        "session: expected a next stage in order to go on, found none; nothing was stored");
  }
  const auto num_together = static_cast<std::int64_t>(current_stages().size());
  commit(StageEntered{.stage = state_.stage, .num_together = num_together});
  if (!std::holds_alternative<Block>(stage->content)) return;
  for (const std::int64_t one : current_stages()) draw_trials(one);
  take_turn_if_due();
}

Block Session::block_as_drawn(std::int64_t stage) const {
  const Stage& its = *parameters_.stages.at(static_cast<std::size_t>(stage));
  return block_of(its, order_row(parameters_.cell, its.name), people_levels(parameters_.cell));
}

Block Session::current_block_as_drawn() const {
  (void)current_block();
  return block_as_drawn(state_.stage);
}

void Session::draw_trials(std::int64_t stage) {
  const Block block = block_as_drawn(stage);
  const std::vector<AnsweredTrial> answered = state_.answered_in(stage);
  core::RandomStream stream(parameters_.seed, "order",
                            {stage, static_cast<std::int64_t>(answered.size())});
  const std::vector<PlannedTrial> trials = next_trials(block, answered, stream);
  if (trials.empty()) return;
  TrialsDrawn drawn{.stage = stage,
                    .first_trial = static_cast<std::int64_t>(state_.trials.size()) + 1,
                    .trials = trials};
  core::Commit rows;
  std::int64_t number = drawn.first_trial;
  for (const PlannedTrial& trial : trials) {
    core::DesignRow& row = rows.design.emplace_back();
    row = {.session = parameters_.session,
           .trial = number++,
           .stage = stage,
           .block = parameters_.stages.at(static_cast<std::size_t>(stage))->name,
           .procedure = block.procedure,
           .medium = block.medium,
           .quantity = block.quantity,
           .sequence = state_.last_sequence + 1};
    core::copy_columns(trial, row);
  }
  commit(std::move(drawn), std::move(rows));
}

/// Draws what an interruption kept from being drawn.
void Session::draw_missing_trials() {
  if (!state_.stage_open || current_stage() == nullptr ||
      !std::holds_alternative<Block>(current_stage()->content)) {
    return;
  }
  for (const std::int64_t stage : current_stages()) {
    if (!state_.has_waiting(stage)) draw_trials(stage);
  }
  take_turn_if_due();
}

BlockProgress Session::progress_of(std::int64_t stage) const {
  const Block block = block_as_drawn(stage);
  BlockProgress progress;
  for (const TrialState& trial : state_.trials) {
    if (trial.stage != stage || trial.is_void) continue;
    (trial.is_answered ? progress.num_answered : progress.num_left) += 1;
  }
  // If answers determine the trials, only one trial waits of all that are expected.
  if (progress.num_left > 0 && procedure_named(block.procedure).adapts()) {
    progress.num_left = std::max(1, expected_trials(block) - progress.num_answered);
  }
  return progress;
}

/// Draws which of the interleaved blocks comes next, if any is not done.
void Session::take_turn() {
  const std::vector<std::int64_t> stages = current_stages();
  std::vector<BlockProgress> blocks;
  std::int64_t num_answered = 0;
  for (const std::int64_t stage : stages) {
    blocks.push_back(progress_of(stage));
    num_answered += blocks.back().num_answered;
  }
  core::RandomStream stream =
      turn_stream(parameters_.seed, state_.first_together, num_answered, state_.num_put_off);
  const Turns turns = current_stage()->interleaving->turns;
  if (const auto next = next_turn(turns, blocks, stream)) commit(TurnTaken{stages[*next]});
}

/// Takes a turn if one is due and no question after an answer is open.
void Session::take_turn_if_due() {
  if (state_.turn_is_due && !open_question()) take_turn();
}

}  // namespace jnd::experiments
