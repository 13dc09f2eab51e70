#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>

#include "experiments/session/session.h"

namespace jnd::app {

/// What the operator asks of a session. A view returns them, the session carries them out in
/// their order; one that is not possible any more is refused with a sentence, never half done.
namespace operate {

/// Starts the session, or goes on after an interruption: "repeat", "restart" or "end".
struct Begin {
  std::string choice = "repeat";
};

/// Ticks the item, gives the consent, answers the question. `item` is what the view showed, so
/// that a key pressed twice does not answer the next one, too.
struct AnswerItem {
  std::int64_t stage = 0;
  std::string item;
  std::string answer;
  std::int64_t trial = 0;  ///< Of a question that follows a trial's answer; else 0.
};

/// Explore, training, post-experiment: feel the medium that waits, or end feeling it.
struct FeelMedium {};
struct FinishMedium {};

/// Leaves the stage when everything in it is done; a break earlier than its rest with a reason.
struct FinishStage {
  std::int64_t stage = 0;
  std::string reason;
};

/// The medium switched: "reference", "test" or "free_space"; "first" or "second" where the
/// order is drawn.
struct Present {
  std::int64_t trial = 0;
  std::string interval;
};

/// Percent, 1 and 0, or the interval that was chosen. In a production `value` is ignored: it
/// matches. None is "cannot tell".
struct Answer {
  std::int64_t trial = 0;
  std::optional<double> value = 0.0;
  std::string control{};        ///< That it was given by; "": in the window.
  std::int64_t pressed_ns = 0;  ///< When, of CLOCK_MONOTONIC; 0: in the window, so now.
};

/// A mapped pedal or button was pressed. What it means follows from what the session waits for
/// then; nothing where that is something else.
struct UseControl {
  std::string action;  ///< One of `core::kControlActions`.
  std::string control;
  std::int64_t pressed_ns = 0;  ///< Of CLOCK_MONOTONIC, as the kernel has it.
};

/// Of an answer that was asked about (`SessionView::doubt`): it is stored as it was given, with
/// the time that it took.
struct StoreDoubted {
  std::int64_t trial = 0;
};
/// It was none: the trial goes on.
struct GoBack {
  std::int64_t trial = 0;
};

struct Adjust {
  std::int64_t trial = 0;
  experiments::Direction direction = experiments::Direction::kRaise;
  experiments::StepSize size = experiments::StepSize::kCoarse;
  bool held = false;  ///< A held key goes on: left out while the step before is not done yet.
};

/// Takes the last answer of the block back; its trial is run again.
struct Undo {
  std::string reason;
};
/// The same for any answer of the block under way whose loss decides nothing about the others,
/// and for the last one.
struct RunAgain {
  std::int64_t trial = 0;
  std::string reason;
};
/// Sets an answer of any block right, its presentations untouched.
struct Correct {
  std::int64_t trial = 0;
  std::optional<double> value = 0.0;  ///< None: "cannot tell".
  std::string reason;
};
struct AddNote {
  std::string text;
};
/// Kept for good, also if the person withdraws.
struct ReportAdverseEvent {
  std::string text;
};
/// Holds at once; why may be said afterwards.
struct Pause {
  std::string reason;
};
struct ExplainPause {
  std::string reason;
};
struct GoOn {};
/// Points that came off are left off, as for a sore finger: stored as a note, and nobody waits
/// for them any more. Goes on after a pause.
struct GoOnWithout {
  std::uint8_t point_bits = 0;  ///< All that the operator saw to be loose.
  std::string reason;
};
/// The emergency stop is released, and there is no force yet: `Rearm` is an act of its own.
/// Nothing of it if the stop was pressed again since `num_stop_presses` was seen.
struct ReleaseStop {
  std::uint64_t num_stop_presses = 0;
};
/// At first, and after a fault or a stop that was released: force, and the trial is run again.
/// Nothing of it if another fault has come since `num_faults_seen`, of `Telemetry::num_faults`,
/// was seen, nor within half a second after the stop was released.
struct Rearm {
  std::uint64_t num_faults_seen = 0;
};
/// For good: not resumable.
struct EndEarly {
  std::string reason;
};
/// The session stays open and can be resumed; force to zero.
struct Leave {
  std::string reason;
};

}  // namespace operate

using OperatorRequest =
    std::variant<operate::Begin, operate::AnswerItem, operate::FeelMedium,
                 operate::FinishMedium, operate::FinishStage, operate::Present, operate::Answer,
                 operate::UseControl, operate::StoreDoubted, operate::GoBack, operate::Adjust,
                 operate::Undo, operate::RunAgain, operate::Correct, operate::AddNote,
                 operate::ReportAdverseEvent, operate::Pause, operate::ExplainPause,
                 operate::GoOn, operate::GoOnWithout, operate::ReleaseStop, operate::Rearm,
                 operate::EndEarly, operate::Leave>;

}  // namespace jnd::app
