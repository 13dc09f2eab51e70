#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>

#include "experiments/session/session.h"

namespace jnd::app {

/// What the operator asks of a session. A view returns requests, and the session carries them
/// out in their order. One that is no longer possible is refused with a sentence, and never
/// carried out by half.
namespace operate {

/// Starts the session, or resumes it after an interruption: "repeat", "restart" or "end".
struct Begin {
  std::string choice = "repeat";
};

/// Ticks the item, gives the consent, or answers the question. `item` is what the view showed,
/// so that a key pressed twice does not answer the next item, too.
struct AnswerItem {
  std::int64_t stage = 0;
  std::string item;
  std::string answer;
  /// For a question that follows a trial's answer, the trial; otherwise 0.
  std::int64_t trial = 0;
};

/// Begins or ends feeling the medium that waits, in an exploring stage, a training or a
/// post-experiment item.
struct FeelMedium {};
struct FinishMedium {};

/// Leaves the stage when everything in it is done. Leaving a break before its rest is over
/// needs a reason.
struct FinishStage {
  std::int64_t stage = 0;
  std::string reason;
};

/// Switches the medium: "reference", "test" or "free_space"; "first", "second" or "third" where
/// the order is drawn.
struct Present {
  std::int64_t trial = 0;
  std::string interval;
};

/// Answers by a percentage, by 1 or 0, or by the chosen interval. In a production, `value` is
/// ignored, and the answer means that it matches. No value means "cannot tell".
struct Answer {
  std::int64_t trial = 0;
  std::optional<double> value = 0.0;
  std::string control{};  ///< The control that gave it; "" for the window.
  /// When it was pressed, by CLOCK_MONOTONIC; 0 for the window, which means now.
  std::int64_t pressed_ns = 0;
};

/// A mapped pedal or button was pressed. Its meaning depends on what the session waits for; it
/// may mean nothing.
struct UseControl {
  std::string action;  ///< One of `core::kControlActions`.
  std::string control;
  /// When it was pressed, by CLOCK_MONOTONIC, as the kernel says it.
  std::int64_t pressed_ns = 0;
};

/// Confirms an answer that was asked about (`SessionView::doubt`). It is stored as it was
/// given, with the time that it took.
struct StoreDoubted {
  std::int64_t trial = 0;
};
/// Takes back an answer that was asked about; the trial goes on.
struct GoBack {
  std::int64_t trial = 0;
};

struct Adjust {
  std::int64_t trial = 0;
  experiments::Direction direction = experiments::Direction::kRaise;
  experiments::StepSize size = experiments::StepSize::kCoarse;
  /// The key is held down; such a step is skipped while the one before it is not done.
  bool held = false;
};

/// Undoes the last answer of the block; its trial is run again.
struct Undo {
  std::string reason;
};
/// Does the same with the last answer, or with any other of the block under way whose loss
/// changes nothing about the rest.
struct RunAgain {
  std::int64_t trial = 0;
  std::string reason;
};
/// Corrects an answer of any block and leaves its presentations as they are.
struct Correct {
  std::int64_t trial = 0;
  std::optional<double> value = 0.0;  ///< No value means "cannot tell".
  std::string reason;
};
struct AddNote {
  std::string text;
};
/// The report is kept forever, even if the person withdraws.
struct ReportAdverseEvent {
  std::string text;
};
/// Pauses at once; the reason may follow later.
struct Pause {
  std::string reason;
};
struct ExplainPause {
  std::string reason;
};
struct GoOn {};
/// Points that came off remain off, as for a sore finger. A note about it is stored, and nobody
/// waits for these points any more. The session goes on after a pause.
struct GoOnWithout {
  std::uint8_t point_bits = 0;  ///< All points that the operator saw to be loose.
  std::string reason;
};
/// Releases the emergency stop. There is no force yet, because `Rearm` is a separate act. Does
/// nothing if the stop was pressed again since `num_stop_presses` was seen.
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
/// Takes the force away and leaves the session, which stays open and can be resumed.
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
