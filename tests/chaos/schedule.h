#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace jnd::chaos {

/// The place where a schedule is played.
enum class World {
  kDirect,   ///< Loop and device are in one program, in virtual time.
  kNetwork,  ///< A network is between them, in virtual time.
  kProcess,  ///< The real program is killed, stopped and starved while it writes a study.
};

/// What people do and what goes wrong. `kTroubles` says where each trouble can happen, for how
/// long and how strongly.
enum class Trouble : std::uint8_t {
  kArm,
  kDisarm,
  kPressStop,
  kReleaseStop,
  /// The stop is pressed after the device was read and before its force is written.
  kPressStopWithinTick,
  kNewMedium,
  kBrokenMedium,  ///< A command with an amount that is not a number.
  kLoopStalls,
  kLoopHeldUpWithinTick,  ///< The loop is delayed between reading and writing.
  kWindowStalls,
  kServerStalls,
  kProgramStops,     ///< SIGSTOP: stops loop, watchdog and window at once.
  kProgramIsKilled,  ///< The program is killed, and started anew afterwards.
  kServerRestarts,
  kUnplugged,  ///< Nothing gets through to the device or back.
  kNoNumber,   ///< NaN in one field of the measurement.
  kInfinity,   ///< Infinity in one field of the measurement.
  kPositionsFreeze,
  kReadingFreezes,  ///< The whole measurement freezes, its time included.
  kVelocitySign,
  kReadingLate,
  kForceLate,
  kReadsFail,
  kWritesFail,
  kPointComesOff,
  kLeap,     ///< A point leaps by `size` metres.
  kTooFast,  ///< A point's velocity is off by `size`, in m/s.
  kLoses,    ///< The share `size` of the datagrams is lost.
  kDoubles,
  kDelays,    ///< All datagrams are late by `size` ms.
  kReorders,  ///< Each datagram is late by up to `size` ms.
  kCorrupts,
  kReplays,  ///< Old datagrams are sent again.
};

/// One trouble, from `at_ms` on. Acts of people last no time.
struct Event {
  int at_ms = 0;
  int lasts_ms = 0;
  Trouble what = Trouble::kArm;
  int point = 0;      ///< Point of the hand, for troubles of one point.
  int field = 0;      ///< Field of the measurement, for troubles of one field.
  double size = 0.0;  ///< Strength, in the unit that `Trouble` says.

  [[nodiscard]] bool is_on(int now_ms) const noexcept {
    return now_ms >= at_ms && now_ms < at_ms + lasts_ms;
  }
  [[nodiscard]] bool overlaps(int from_ms, int to_ms) const noexcept {
    return at_ms <= to_ms && at_ms + lasts_ms >= from_ms;
  }
};

/// All that happens in one run. It is a pure function of its seed.
struct Schedule {
  std::uint64_t seed = 0;
  World world = World::kDirect;
  int lasts_ms = 0;
  double hand_mass_kg = 0.3;
  double stroke_m = 0.1;    ///< Amplitude of the person's strokes.
  double stroke_hz = 1.0;   ///< Strokes to and fro.
  double filter_hz = 0.0;   ///< Cutoff of the filter of the device's velocity; 0: none.
  int reading_late_ms = 0;  ///< This lateness is always there; events come on top.
  int force_late_ms = 0;
  double viscosity_pa_s = 8.0;
  /// Whether the device zeroes its force 20 ms after the last write.
  bool zeroes_by_itself = true;
  std::vector<Event> events;  ///< Sorted by time.

  /// The first event of this kind that is on now; nullptr if there is none.
  [[nodiscard]] const Event* on(Trouble what, int now_ms) const noexcept;
  /// Whether something that holds up or loses what goes between loop and device was on.
  [[nodiscard]] bool is_disturbed(int from_ms, int to_ms) const noexcept;
  /// Whether datagrams may have come late, or twice.
  [[nodiscard]] bool has_late_datagrams(int from_ms, int to_ms) const noexcept;
  /// Whether a force that was meant for a moment may stand for a while: until a watchdog ends
  /// it, or until the loop sees that readings stand still.
  [[nodiscard]] bool may_let_a_force_stand() const noexcept;
  /// The most by which reading and force together are ever late on the way to the device.
  [[nodiscard]] int most_late_ms() const noexcept;
};

[[nodiscard]] Schedule drawn_schedule(std::uint64_t seed);

/// Describes what is played in a few lines for a person, one event a line.
[[nodiscard]] std::string told(const Schedule& schedule);

[[nodiscard]] std::string_view name(Trouble what) noexcept;

}  // namespace jnd::chaos
