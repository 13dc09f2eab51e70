#include <fmt/format.h>

#include "app/language/words.h"
#include "app/operator/given_answer.h"
#include "app/operator/operated_session.h"

// Answers that the operator is asked about before they are stored, and what is said about them
// afterwards.

namespace jnd::app {

using namespace experiments;

/// The circumstances of an answer that is given now to the trial under way, or of the answer
/// that the trial has.
GivenAnswer OperatedSession::given_answer(const TrialState& trial, AnswerKind kind,
                                          const std::optional<double>& value) const {
  const AnswerGiven given{
      .state = state(),
      .trial = trial,
      .block =
          std::get<Block>(session_.stages().at(static_cast<std::size_t>(trial.stage))->content),
      .rate_hz = parameters_.study.device.rate_hz,
      .hides_levels = hides_levels_,
      .felt = {.num_strokes = running_.apparatus().num_metered_strokes(),
               .next_tick = running_.apparatus().next_tick()}};
  return given.with(kind, value);
}

bool OperatedSession::doubt_stands() const {
  if (!doubted_ || state().paused || known_fault_ != core::Fault::kNone) return false;
  const std::optional<std::int64_t> trial = state().current_trial();
  return trial == doubted_->answer.trial && state().trial(*trial).under_way &&
         state().trial(*trial).attempt == doubted_->attempt;
}

/// An answer that was given but not stored, for the reason why the attempt is given up; "" if
/// there is none.
std::string OperatedSession::doubted_words() const {
  return doubt_stands() ? given_words(doubted_->answer) : "";
}

std::optional<DoubtView> OperatedSession::doubt_view() const {
  if (!doubt_stands()) return std::nullopt;
  const AnswerKind kind = session_.current_form().answer;
  const std::string words = kind == AnswerKind::kMatch
                                ? std::string(tr("“it matches”"))
                                : answer_in_words(*block(), doubted_->answer.value);
  return DoubtView{
      .trial = doubted_->answer.trial,
      .sentence = tr("The answer is {}: {}.", words, shown_doubts(doubted_->doubts))};
}

/// What happened to a doubtful answer, in words of the log.
std::string OperatedSession::note_of_doubt(const char* outcome) const {
  const operate::Answer& answer = doubted_->answer;
  const bool is_match = session_.current_form().answer == AnswerKind::kMatch;
  const std::string value = is_match       ? std::string(as_is("\"it matches\""))
                            : answer.value ? fmt::format("{:g}", *answer.value)
                                           : std::string(as_is("\"cannot tell\""));
  return fmt::format(fmt::runtime(as_is("{}{} to trial {} ({}): {}")), kNoteOfDoubt, value,
                     answer.trial, stored_doubts(doubted_->doubts), outcome);
}

std::string given_words(const operate::Answer& answer) {
  if (!answer.value) return as_is("; the answer was \"cannot tell\"");
  return fmt::format(fmt::runtime(as_is("; the answer was {:g}")), *answer.value);
}

}  // namespace jnd::app
