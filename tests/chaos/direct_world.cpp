#include "chaos/hand_device.h"
#include "chaos/program_in_virtual_time.h"
#include "chaos/worlds.h"

namespace jnd::chaos {
namespace {

/// Plays a schedule with loop and device in one program.
class DirectWorld {
 public:
  explicit DirectWorld(const Schedule& schedule)
      : schedule_(schedule),
        oracle_(schedule),
        hand_(schedule, oracle_),
        program_(schedule, oracle_) {
    hand_.after_read = [this] { happen_within_tick(); };
  }

  Outcome play() {
    while (now_ms_ < schedule_.lasts_ms && oracle_.violation().empty()) {
      pass_millisecond();
      program_.tick_if_due(now_ms_);
    }
    oracle_.begin_millisecond(now_ms_ + 1);
    return {.violation = oracle_.violation(),
            .num_milliseconds_with_force = oracle_.num_milliseconds_with_force(),
            .most_given_j = oracle_.most_given_j()};
  }

 private:
  void pass_millisecond() {
    oracle_.begin_millisecond(++now_ms_);
    const bool is_killed = schedule_.on(Trouble::kProgramIsKilled, now_ms_) != nullptr;
    const bool is_stopped = schedule_.on(Trouble::kProgramStops, now_ms_) != nullptr;
    if (is_killed && !program_.is_within_tick()) program_.kill();
    if (!is_killed && !is_stopped && !program_.runs()) program_.start(hand_);
    hand_.pass_millisecond(now_ms_);
    program_.pass_millisecond(now_ms_);
  }

  /// This happens after the loop has read the device and before it writes its force.
  void happen_within_tick() {
    program_.press_stop_within_tick(now_ms_);
    int held_up_ms = 0;
    for (const Event& event : schedule_.events) {
      const bool begins =
          event.what == Trouble::kLoopHeldUpWithinTick && event.at_ms == now_ms_;
      if (begins) held_up_ms = static_cast<int>(event.size);
    }
    for (int i = 0; i < held_up_ms; ++i) pass_millisecond();
  }

  const Schedule& schedule_;
  Oracle oracle_;
  HandDevice hand_;
  ProgramInVirtualTime program_;
  int now_ms_ = 0;
};

}  // namespace

Outcome played_directly(const Schedule& schedule) { return DirectWorld(schedule).play(); }

}  // namespace jnd::chaos
