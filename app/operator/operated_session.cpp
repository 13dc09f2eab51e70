#include "app/operator/operated_session.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "app/language/words.h"
#include "app/operator/live_trace.h"
#include "app/operator/remembered_stop.h"
#include "app/operator/scope_trace.h"
#include "app/session/stored_session.h"
#include "core/error.h"
#include "core/random_stream.h"
#include "core/safety/fault.h"

namespace jnd::app {

using namespace experiments;

namespace {

/// Requests that must not wait behind others, because the operator has changed their mind.
bool is_urgent(const OperatorRequest& request) {
  return std::holds_alternative<operate::Pause>(request) ||
         std::holds_alternative<operate::Undo>(request) ||
         std::holds_alternative<operate::EndEarly>(request) ||
         std::holds_alternative<operate::Leave>(request) ||
         std::holds_alternative<operate::ReleaseStop>(request) ||
         std::holds_alternative<operate::Rearm>(request);
}

bool is_answer(const OperatorRequest& request) {
  return std::holds_alternative<operate::Answer>(request) ||
         std::holds_alternative<operate::UseControl>(request);
}

/// What is only about what is felt next.
bool moves_medium(const OperatorRequest& request) {
  return std::holds_alternative<operate::Present>(request) ||
         std::holds_alternative<operate::Adjust>(request);
}

/// Waits for nothing, wherever the session stands.
bool is_said(const OperatorRequest& request) {
  return std::holds_alternative<operate::AddNote>(request) ||
         std::holds_alternative<operate::ReportAdverseEvent>(request);
}

/// What somebody wrote that must not be lost; "" in other requests.
std::string written_in(const OperatorRequest& request) {
  if (const auto* note = std::get_if<operate::AddNote>(&request)) return note->text;
  if (const auto* event = std::get_if<operate::ReportAdverseEvent>(&request)) {
    return event->text;
  }
  if (const auto* correct = std::get_if<operate::Correct>(&request)) return correct->reason;
  if (const auto* why = std::get_if<operate::ExplainPause>(&request)) return why->reason;
  return "";
}

Apparatus::Parameters apparatus_parameters(const OperatedSession::Parameters& parameters,
                                           const core::SessionRow& row, bool hides_levels) {
  Apparatus::Parameters apparatus;
  apparatus.device = row.device;
  apparatus.realtime = parameters.realtime;
  apparatus.allow_no_realtime = parameters.allow_no_realtime;
  apparatus.exchange = &parameters.exchange;
  apparatus.injected_faults = parameters.injected_faults;
  if (hides_levels) return apparatus;
  apparatus.on_sample = [trace = parameters.trace, scopes = parameters.scopes,
                         on_sample = parameters.on_sample](const core::Sample& sample) {
    if (trace != nullptr) trace->take(sample);
    if (scopes != nullptr) scopes->take(sample);
    if (on_sample) on_sample(sample);
  };
  return apparatus;
}

}  // namespace

OperatedSession::OperatedSession(const Parameters& parameters)
    : parameters_(parameters),
      row_(parameters.store.session(parameters.session)),
      hides_levels_(parameters.study.blinding == Blinding::kDouble &&
                    !parameters.store.unblinded()),
      remark_(changed_study_remark(parameters.store, row_)),
      running_({.store = parameters.store,
                .session = parameters.session,
                .study = parameters.study,
                .apparatus = apparatus_parameters(parameters, row_, hides_levels_),
                .laboratory = parameters.laboratory,
                .streams = parameters.streams,
                .sound = parameters.sound,
                .markers = parameters.markers}),
      session_(running_.session()),
      presenter_(running_.apparatus(), session_, parameters.study.device, running_.sound()) {
  running_.apparatus().render(core::free_space());
  if (is_stop_remembered(parameters_.stops, row_.device)) {
    parameters_.exchange.emergency_stop.press();
  }
  // A session keeps the language in which it began.
  language_ = !state().language.empty()      ? state().language
              : !parameters.language.empty() ? parameters.language
                                             : parameters.study.languages.front();
}

const SessionState& OperatedSession::state() const { return session_.state(); }

const Stage* OperatedSession::stage() const { return session_.current_stage(); }

const Block* OperatedSession::block() const {
  return stage() == nullptr ? nullptr : std::get_if<Block>(&stage()->content);
}

double OperatedSession::now_s() const {
  return static_cast<double>(running_.apparatus().next_tick()) /
         parameters_.study.device.rate_hz;
}

void OperatedSession::request(OperatorRequest request) {
  if (const auto* adjust = std::get_if<operate::Adjust>(&request); adjust && adjust->held) {
    const bool waits =
        std::any_of(requests_.begin(), requests_.end(), [](const OperatorRequest& waiting) {
          return std::holds_alternative<operate::Adjust>(waiting);
        });
    if (waits) return;
  }
  requests_.push_back(std::move(request));
}

void OperatedSession::advance(double duration_s) {
  if (!parameters_.realtime && duration_s > 0.0) {
    try {
      running_.apparatus().run_for(duration_s);
    } catch (const core::Error&) {
      if (running_.apparatus().telemetry().fault == core::Fault::kNone) throw;
    }
  }
  try {
    watch_apparatus();
    if (presenter_.waits_for_ramp() && presenter_.ramp_has_passed()) presenter_.ramp_is_over();
    carry_out_requests();
    watch_times();
    follow_session();
    watch_sound();
  } catch (const core::Error& error) {
    give_up(error.what());
    keep_what_was_written();
  }
}

void OperatedSession::carry_out_requests() {
  while (!requests_.empty() && failure_.empty() && !left_) {
    if (must_wait(requests_.front())) {
      const auto said = std::find_if(requests_.begin(), requests_.end(), is_said);
      if (said != requests_.end()) {
        std::rotate(requests_.begin(), said, std::next(said));
      } else if (make_way_for_urgent()) {
        continue;
      } else {
        return;
      }
    }
    watch_apparatus();  // The request before may have taken as long as a disk does.
    OperatorRequest next = std::move(requests_.front());
    requests_.pop_front();
    const std::int64_t last_sequence = state().last_sequence;
    try {
      carry_out(next);
      refusal_.clear();
    } catch (const StorageError&) {
      // What the log has already must not be stored again by `keep_what_was_written`.
      if (state().last_sequence == last_sequence) requests_.push_front(std::move(next));
      throw;
    } catch (const core::Error& error) {
      refusal_ = error.what();
      ++num_refusals_;
    }
    follow_session();
  }
  // After a failure of the disk, the operator can only leave.
  if (!failure_.empty()) {
    left_ |=
        std::any_of(requests_.begin(), requests_.end(), [](const OperatorRequest& request) {
          return std::holds_alternative<operate::Leave>(request);
        });
  }
  if (left_ || !failure_.empty()) keep_what_was_written();
}

/// Lets an urgent request pass those that wait, of which goes what it makes pointless and
/// nothing that somebody wrote. False where there is none, or an answer comes before it: no
/// answer is dropped for a change of mind, and the ramp is over soon.
bool OperatedSession::make_way_for_urgent() {
  const auto urgent = std::find_if(requests_.begin(), requests_.end(), is_urgent);
  if (urgent == requests_.end()) return false;
  const auto answer = std::find_if(requests_.begin(), urgent, is_answer);
  if (answer == urgent) {
    requests_.erase(std::remove_if(requests_.begin(), urgent, moves_medium), urgent);
    return true;
  }
  const auto* undo = std::get_if<operate::Undo>(&*urgent);
  if (undo == nullptr) return false;
  // The answer meant is the one that still waits; those before it stay.
  std::vector<std::string> notes;
  for (auto request = answer; request != urgent; ++request) {
    const std::string words = taken_back_words(*request, undo->reason);
    if (!words.empty()) notes.push_back(words);
  }
  const auto behind = std::next(urgent);
  requests_.erase(std::remove_if(answer, behind,
                                 [](const OperatorRequest& request) {
                                   return is_answer(request) || moves_medium(request) ||
                                          std::holds_alternative<operate::Undo>(request);
                                 }),
                  behind);
  for (const std::string& note : notes) session_.note(note);
  return true;
}

/// Of an answer that nobody has stored yet, for the log; "" where a control meant none.
std::string OperatedSession::taken_back_words(const OperatorRequest& request,
                                              const std::string& reason) const {
  std::optional<OperatorRequest> meant = request;
  if (const auto* use = std::get_if<operate::UseControl>(&request)) meant = meaning_of(*use);
  const auto* answer = meant ? std::get_if<operate::Answer>(&*meant) : nullptr;
  if (answer == nullptr || !begun_) return "";
  return as_is("an answer to trial ") + std::to_string(answer->trial) +
         as_is(" was taken back before it was stored (") + reason + ")" + given_words(*answer);
}

/// Of what is left when nobody goes on with the session: it is stored all the same, and told
/// where it cannot be.
void OperatedSession::keep_what_was_written() {
  for (const OperatorRequest& request : std::exchange(requests_, {})) {
    const std::string written = written_in(request);
    if (written.empty()) continue;
    try {
      carry_out(request);
    } catch (const core::Error& error) {
      const std::string told = tr("not stored: “{}” ({})", written, error.what());
      if (!failure_.empty()) failure_ += "; " + told;
      refusal_ = told;
      ++num_refusals_;
    }
  }
}

bool OperatedSession::must_wait(const OperatorRequest& request) const {
  if (state().paused || known_fault_ != core::Fault::kNone) return false;
  if (const auto* use = std::get_if<operate::UseControl>(&request)) {
    const std::optional<OperatorRequest> meant = meaning_of(*use);
    return meant && must_wait(*meant);
  }
  if (std::holds_alternative<operate::Present>(request)) {
    return step() == Step::kRest || presenter_.waits_for_ramp();
  }
  if (std::holds_alternative<operate::Answer>(request) ||
      std::holds_alternative<operate::Adjust>(request)) {
    return presenter_.waits_for_ramp();
  }
  return false;
}

/// Takes the medium away first, because everything after that waits for the disk.
void OperatedSession::abandon_presentation() {
  running_.apparatus().render(core::free_space());
  running_.apparatus().go_home();
  feeling_.reset();
  doubted_.reset();
  presenter_.abandon();
  if (begun_ && !state().ended && failure_.empty()) presenter_.tell_exposure();
}

void OperatedSession::end_feeling(bool counts) {
  const Feeling felt = *feeling_;
  const std::int64_t last_tick = running_.apparatus().next_tick() - 1;
  feeling_.reset();
  running_.apparatus().render(core::free_space());
  running_.apparatus().go_home();
  if (counts) {
    session_.explored(felt.setting.medium, felt.setting.intensity, felt.first_tick, last_tick);
  }
  presenter_.tell_exposure();
}

/// Does what follows without a request: the next stage, the rest before the next trial, the
/// end.
void OperatedSession::follow_session() {
  if (!begun_ || left_ || !failure_.empty()) return;
  while (!state().ended && !state().paused && !is_held_up()) {
    if (stage() == nullptr) {
      running_.keep_timing();
      running_.close_streams();
      running_.close_sound();
      session_.complete();
      return;
    }
    if (!state().stage_open) {
      enter_stage();
    } else if (stage_is_complete() && !std::holds_alternative<Break>(stage()->content) &&
               !std::holds_alternative<Questionnaire>(stage()->content) && block() == nullptr) {
      session_.finish_stage();
      running_.keep_timing();
    } else {
      break;
    }
  }
  if (!state().ended && !state().paused && block() != nullptr) rest_before_trial();
}

void OperatedSession::enter_stage() {
  session_.enter_stage();
  resting_for_trial_ = 0;
  if (const auto* rest = std::get_if<Break>(&stage()->content)) {
    break_until_s_ = now_s() + rest->duration_s;
  }
}

void OperatedSession::rest_before_trial() {
  const std::optional<std::int64_t> trial = state().current_trial();
  if (!trial || state().trial(*trial).under_way || resting_for_trial_ == *trial) return;
  // The rest begins when the question is answered.
  if (session_.open_question()) return;
  resting_for_trial_ = *trial;
  is_ready_told_ = false;
  rest_until_s_ = now_s() + block()->free_space_between_s;
  running_.apparatus().go_home();
}

void OperatedSession::give_up(const std::string& why) {
  if (!failure_.empty()) return;
  failure_ = why;
  running_.apparatus().disarm();
  try {
    abandon_presentation();
  } catch (const core::Error&) {
    // A second failure must not hide the first one.
  }
}

/// Whatever else is wrong, and whatever the loop tells: nothing hides a stop.
void OperatedSession::remember_new_stop() {
  const core::EmergencyStop& stop = parameters_.exchange.emergency_stop;
  const std::uint64_t num_presses = stop.num_presses();
  if (num_presses == known_stop_presses_ || !stop.is_pressed()) return;
  known_stop_presses_ = num_presses;
  remember_stop(parameters_.stops, row_.device);
}

void OperatedSession::forget_stop() const {
  jnd::app::forget_stop(parameters_.stops, row_.device);
}

/// Moves a device that moves by itself; others ignore it.
void OperatedSession::move_simulated_hand(double height_m) {
  running_.apparatus().begin_strokes(
      {.height_m = height_m},
      core::RandomStream(row_.seed, "stroke",
                         {state().stage, running_.apparatus().next_tick()}));
}

}  // namespace jnd::app
