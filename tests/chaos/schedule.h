#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace jnd::chaos {

/// The place where a schedule is played.
enum class World {
  kDirect,   ///< Loop and device run in one program, in virtual time.
  kNetwork,  ///< A network lies between them, in virtual time.
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
  kBrokenMedium,  ///< A command whose amount is no number.
  kLoopStalls,
  kLoopHeldUpWithinTick,  ///< The loop is delayed between reading and writing.
  kWindowStalls,
  kServerStalls,
  kProgramStops,     ///< SIGSTOP stops loop, watchdog and window at once.
  kProgramIsKilled,  ///< The program is started again afterwards.
  kServerRestarts,
  kUnplugged,  ///< Nothing gets through to the device or back.
  kNoNumber,   ///< One field of the measurement is NaN.
  kInfinity,   ///< One field of the measurement is infinite.
  kPositionsFreeze,
  kReadingFreezes,  ///< The reading freezes together with its time.
  kVelocitySign,
  kReadingLate,
  kForceLate,
  kReadsFail,
  kWritesFail,
  kPointComesOff,
  kLeap,     ///< A point is displaced, in metres.
  kTooFast,  ///< A point's velocity is wrong, in m/s.
  kLoses,    ///< The network loses this share of the datagrams.
  kDoubles,
  kDelays,    ///< All datagrams are late by this many ms.
  kReorders,  ///< Each datagram is late by up to this many ms.
  kCorrupts,
  kReplays,  ///< Old datagrams are sent again.
};

/// One trouble, from `at_ms` on. Acts of people take no time.
struct Event {
  int at_ms = 0;
  int lasts_ms = 0;
  Trouble what = Trouble::kArm;
  int point = 0;      ///< The point of the hand, if the trouble is about one.
  int field = 0;      ///< The field of the measurement, if the trouble is about one.
  double size = 0.0;  ///< The strength, in the unit that `Trouble` says.

  [[nodiscard]] bool is_on(int now_ms) const noexcept {
    return now_ms >= at_ms && now_ms < at_ms + lasts_ms;
  }
  [[nodiscard]] bool overlaps(int from_ms, int to_ms) const noexcept {
    return at_ms <= to_ms && at_ms + lasts_ms >= from_ms;
  }
};

/// Everything of one run, as a pure function of its seed.
struct Schedule {
  std::uint64_t seed = 0;
  World world = World::kDirect;
  int lasts_ms = 0;
  double hand_mass_kg = 0.3;
  double stroke_m = 0.1;   ///< The amplitude of the person's strokes.
  double stroke_hz = 1.0;  ///< The frequency of strokes to and fro.
  /// The cut-off frequency of the device's velocity filter, or 0 for none.
  double filter_hz = 0.0;
  int reading_late_ms = 0;  ///< The constant delay. Events add to it.
  int force_late_ms = 0;
  double viscosity_pa_s = 8.0;
  /// Whether the device ends the force by itself, 20 ms after the last write.
  bool zeroes_by_itself = true;
  std::vector<Event> events;  ///< The events are in the order of their time.

  /// Returns the first event of this kind that is on at this time, or nullptr if there is none.
  [[nodiscard]] const Event* on(Trouble what, int now_ms) const noexcept;
  /// Returns whether a trouble was on that delays or loses what goes between loop and device.
  [[nodiscard]] bool is_disturbed(int from_ms, int to_ms) const noexcept;
  /// Returns whether datagrams may have come late or repeatedly.
  [[nodiscard]] bool has_late_datagrams(int from_ms, int to_ms) const noexcept;
  /// Returns whether a force that was meant for a moment may stand longer: until a watchdog
  /// ends it, or until the program sees that readings stand still.
  [[nodiscard]] bool may_let_a_force_stand() const noexcept;
  /// Returns the longest total delay of reading and force on the way to the device.
  [[nodiscard]] int most_late_ms() const noexcept;
};

[[nodiscard]] Schedule drawn_schedule(std::uint64_t seed);

/// Describes the schedule in a few lines for a person, with one event in each line.
[[nodiscard]] std::string told(const Schedule& schedule);

[[nodiscard]] std::string_view name(Trouble what) noexcept;

}  // namespace jnd::chaos
