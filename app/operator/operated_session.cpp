#include "app/operator/operated_session.h"

#include <algorithm>
#include <utility>

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
  }
}

void OperatedSession::carry_out_requests() {
  while (!requests_.empty() && failure_.empty() && !left_) {
    if (must_wait(requests_.front())) {
      const auto urgent = std::find_if(requests_.begin(), requests_.end(), is_urgent);
      if (urgent == requests_.end()) return;
      const auto answer = std::find_if(requests_.begin(), urgent, is_answer);
      if (answer == urgent) {
        requests_.erase(requests_.begin(), urgent);
      } else if (std::holds_alternative<operate::Undo>(*urgent)) {
        // The answer meant is the one that still waits; answers before it stay.
        requests_.erase(answer, std::next(urgent));
        continue;
      } else {
        // No answer is dropped for a change of mind, because the ramp is over soon.
        return;
      }
    }
    // The previous request may have taken as long as a disk does.
    watch_apparatus();
    const OperatorRequest next = std::move(requests_.front());
    requests_.pop_front();
    try {
      carry_out(next);
      refusal_.clear();
    } catch (const StorageError&) {
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
    requests_.clear();
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
  while (!state().ended && !state().paused && known_fault_ == core::Fault::kNone) {
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

void OperatedSession::remember_stop() const {
  jnd::app::remember_stop(parameters_.stops, row_.device);
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
