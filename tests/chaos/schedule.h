#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace jnd::chaos {

/// Where a schedule is played.
enum class World {
  kDirect,   ///< Loop and device in one program, in virtual time.
  kNetwork,  ///< A network between them, in virtual time.
  kProcess,  ///< The real program, killed, stopped and starved while it writes a study.
};

/// What people do and what goes wrong. `kTroubles` says of each where it can happen, for how
/// long and how strongly.
enum class Trouble : std::uint8_t {
  kArm,
  kDisarm,
  kPressStop,
  kReleaseStop,
  kPressStopWithinTick,  ///< After the device was read and before its force is written.
  kNewMedium,
  kBrokenMedium,  ///< A command whose amount is no number.
  kLoopStalls,
  kLoopHeldUpWithinTick,  ///< The loop is held up between reading and writing.
  kWindowStalls,
  kServerStalls,
  kProgramStops,     ///< SIGSTOP: loop, watchdog and window at once.
  kProgramIsKilled,  ///< And started anew afterwards.
  kServerRestarts,
  kUnplugged,  ///< Nothing gets through to the device and back.
  kNoNumber,   ///< NaN in one field of the measurement.
  kInfinity,   ///< Infinity in it.
  kPositionsFreeze,
  kReadingFreezes,  ///< With its time.
  kVelocitySign,
  kReadingLate,
  kForceLate,
  kReadsFail,
  kWritesFail,
  kPointComesOff,
  kLeap,     ///< A point is elsewhere, in metres.
  kTooFast,  ///< A point's velocity is off, in m/s.
  kLoses,    ///< This share of the datagrams.
  kDoubles,
  kDelays,    ///< All datagrams, by so many ms.
  kReorders,  ///< Each datagram by up to so many ms.
  kCorrupts,
  kReplays,  ///< Old ones are sent again.
};

/// One trouble, from `at_ms` on. Acts last no time.
struct Event {
  int at_ms = 0;
  int lasts_ms = 0;
  Trouble what = Trouble::kArm;
  int point = 0;      ///< Of the hand, where one is meant.
  int field = 0;      ///< Of the measurement, where one is meant.
  double size = 0.0;  ///< As `Trouble` says.

  [[nodiscard]] bool is_on(int now_ms) const noexcept {
    return now_ms >= at_ms && now_ms < at_ms + lasts_ms;
  }
  [[nodiscard]] bool overlaps(int from_ms, int to_ms) const noexcept {
    return at_ms <= to_ms && at_ms + lasts_ms >= from_ms;
  }
};

/// All of one run. A pure function of its seed.
struct Schedule {
  std::uint64_t seed = 0;
  World world = World::kDirect;
  int lasts_ms = 0;
  double hand_mass_kg = 0.3;
  double stroke_m = 0.1;    ///< Amplitude of what the person does.
  double stroke_hz = 1.0;   ///< Strokes to and fro.
  double filter_hz = 0.0;   ///< Of the device's velocity; 0: none.
  int reading_late_ms = 0;  ///< Always; events come on top.
  int force_late_ms = 0;
  double viscosity_pa_s = 8.0;
  bool zeroes_by_itself = true;  ///< The device, 20 ms after the last write.
  std::vector<Event> events;     ///< By their time.

  /// The first event of the kind that is on now; nullptr: none.
  [[nodiscard]] const Event* on(Trouble what, int now_ms) const noexcept;
  /// Whether something was on that holds up or loses what goes between loop and device.
  [[nodiscard]] bool is_disturbed(int from_ms, int to_ms) const noexcept;
  /// Whether datagrams may have come late, or again.
  [[nodiscard]] bool has_late_datagrams(int from_ms, int to_ms) const noexcept;
  /// Whether a force may stand for a while that was meant for a moment: until a watchdog ends
  /// it, or until it is seen that readings stand still.
  [[nodiscard]] bool may_let_a_force_stand() const noexcept;
  /// The most by which reading and force together are ever late, on the way to the device.
  [[nodiscard]] int most_late_ms() const noexcept;
};

[[nodiscard]] Schedule drawn_schedule(std::uint64_t seed);

/// A few lines for a person: what is played, one event a line.
[[nodiscard]] std::string told(const Schedule& schedule);

[[nodiscard]] std::string_view name(Trouble what) noexcept;

}  // namespace jnd::chaos
