#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "app/language/words.h"
#include "app/operator/operated_session.h"
#include "app/operator/trial_intervals.h"
#include "experiments/procedures/procedure_registry.h"
#include "experiments/procedures/stimulus.h"

// Answers that are asked about before they are stored, and what is said beside them afterwards.

namespace jnd::app {

using namespace experiments;

/// The answer of this block that was given last before the trial's own, where it is a
/// magnitude.
std::optional<double> OperatedSession::magnitude_before(const TrialState& trial) const {
  std::int64_t latest = 0;
  std::optional<double> value;
  for (const TrialState& other : state().trials) {
    const bool is_before = !trial.is_answered || other.answer_sequence < trial.answer_sequence;
    if (&other == &trial || other.stage != trial.stage || !other.is_answered || !is_before ||
        other.answer_sequence <= latest) {
      continue;
    }
    latest = other.answer_sequence;
    value = other.response;
  }
  return value;
}

/// Whole strokes in each stimulus of the attempt that is no solid, by what it is called.
std::map<std::string, std::int64_t> OperatedSession::strokes_in(const TrialState& trial) const {
  const Block& its_block =
      std::get<Block>(session_.stages().at(static_cast<std::size_t>(trial.stage))->content);
  std::map<std::string, std::int64_t> strokes;
  for (const PresentationState& presented : trial.presentations) {
    if (presented.interval == "free_space" || its_block.is_pressed_in(presented.interval))
      continue;
    std::int64_t& num = strokes[shown_name(presented, trial.planned)];
    num += presented.last_tick ? presented.num_strokes
                               : running_.apparatus().num_metered_strokes();
  }
  return strokes;
}

/// Of an answer to the trial under way, now, or of the one that it has.
GivenAnswer OperatedSession::given_answer(const TrialState& trial, AnswerKind kind,
                                          const std::optional<double>& value) const {
  GivenAnswer given{.kind = kind, .value = value, .last_value = magnitude_before(trial)};
  if (!hides_levels_) {
    for (const auto& [interval, num] : strokes_in(trial)) {
      if (num == 0) given.unstroked.push_back(interval);
    }
  }
  if (trial.presentations.empty()) return given;
  // In this attempt as a whole: who goes back to it decides sooner.
  const PresentationState& last = trial.presentations.back();
  double felt_s = 0.0;
  for (const PresentationState& presented : trial.presentations) {
    if (shown_name(presented, trial.planned) != shown_name(last, trial.planned)) continue;
    const std::int64_t end = presented.last_tick.value_or(running_.apparatus().next_tick() - 1);
    felt_s +=
        static_cast<double>(end - presented.first_tick) / parameters_.study.device.rate_hz;
  }
  if (last.interval != "free_space") given.felt_s = felt_s;
  return given;
}

bool OperatedSession::doubt_stands() const {
  if (!doubted_ || state().paused || known_fault_ != core::Fault::kNone) return false;
  const std::optional<std::int64_t> trial = state().current_trial();
  return trial == doubted_->answer.trial && state().trial(*trial).under_way &&
         state().trial(*trial).attempt == doubted_->attempt;
}

/// What was given and is not stored, for the reason why the attempt is given up; "" for
/// nothing.
std::string OperatedSession::doubted_words() const {
  return doubt_stands() ? given_words(doubted_->answer) : "";
}

std::optional<DoubtView> OperatedSession::doubt_view() const {
  if (!doubt_stands()) return std::nullopt;
  const AnswerKind kind = session_.current_form().answer;
  const std::string words = kind == AnswerKind::kMatch
                                ? std::string(tr("“it matches”"))
                                : answer_in_words(*block(), kind, doubted_->answer.value);
  return DoubtView{
      .trial = doubted_->answer.trial,
      .sentence = tr("The answer is {}: {}.", words, shown_doubts(doubted_->doubts))};
}

/// What became of an answer that was asked about, for the log.
std::string OperatedSession::note_of_doubt(const char* outcome) const {
  const operate::Answer& answer = doubted_->answer;
  const bool is_match = session_.current_form().answer == AnswerKind::kMatch;
  const std::string value = is_match       ? std::string(as_is("\"it matches\""))
                            : answer.value ? fmt::format("{:g}", *answer.value)
                                           : std::string(as_is("\"cannot tell\""));
  return fmt::format(fmt::runtime(as_is("asked about the answer {} to trial {} ({}): {}")),
                     value, answer.trial, stored_doubts(doubted_->doubts), outcome);
}

std::string given_words(const operate::Answer& answer) {
  if (!answer.value) return as_is("; the answer was \"cannot tell\"");
  return fmt::format(fmt::runtime(as_is("; the answer was {:g}")), *answer.value);
}

}  // namespace jnd::app
