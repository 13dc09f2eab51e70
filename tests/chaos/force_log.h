#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "core/hand.h"

namespace jnd::chaos {

/// What one device was given from its opening to its end, by its own record. Times are by
/// CLOCK_MONOTONIC.
struct ForceLog {
  struct Record {
    std::int64_t time_ns = 0;
    core::PointVectors force_n;  ///< The force from then on.
  };
  std::vector<Record> records;
  /// The times at which the process that has the device surely ran, rising. They tell whether a
  /// force stood because nobody ended it or because the machine let nobody run.
  std::vector<std::int64_t> beats_ns;
  /// True if no other program can reach the device, as with a driver that is the child of one
  /// program.
  bool is_of_one_program = false;
};

/// Reads the file that a reference device or the observing driver wrote. Without a file of
/// beats each record counts as a beat: the device writes one in each tick. An incomplete record
/// at the end is left out.
[[nodiscard]] ForceLog read_force_log(const std::filesystem::path& file,
                                      const std::filesystem::path& beats = {});

/// Looks at a file that is still being written, from a given offset on.
class ForceWatch {
 public:
  explicit ForceWatch(std::uintmax_t offset_bytes = 0) : offset_bytes_(offset_bytes) {}

  /// Whether there is force now and was none at some time since the offset: a force that an
  /// earlier program left standing does not count.
  [[nodiscard]] bool has_new_force(const std::filesystem::path& file);

 private:
  std::uintmax_t offset_bytes_;
  bool was_without_ = false, has_force_ = false;
};

/// A reason for which there must be no force at a device until a program is started again.
struct Revocation {
  /// Which times show that whoever has to end the force was able to run.
  enum class Clock { kBeats, kRecords };
  static constexpr std::int64_t kNever_ns = std::numeric_limits<std::int64_t>::max();

  std::string cause;
  std::int64_t from_ns = 0;
  /// The time within which the force has to be gone. Only time in which `clock` shows activity
  /// counts.
  int within_ms = 0;
  Clock clock = Clock::kBeats;
  /// If the cause is over before this time, nothing is due.
  std::int64_t over_by_ns = kNever_ns;
};

/// The limits that a device promises, and what the schedule did.
struct Happenings {
  double most_per_point_n = 0.0;
  double most_in_all_n = 0.0;
  /// The largest step at one point from one record to the next. The end of a force is no step.
  double most_step_n = 0.0;
  /// The longest time for which a force that nobody renews may stand. It says nothing of a
  /// device that writes its records in each tick.
  int longest_standing_ms = 0;
  /// Rising. Each program arms the devices that it finds.
  std::vector<std::int64_t> program_starts_ns;
  std::vector<Revocation> revocations;
};

/// Says what is wrong about the forces of a device; "" if nothing is. It knows what arrived and
/// what the schedule did, and nothing that any program says of itself.
[[nodiscard]] std::string judged(const ForceLog& log, const Happenings& happenings);

/// The time during which there was force, in ms.
[[nodiscard]] int milliseconds_with_force(const ForceLog& log);

}  // namespace jnd::chaos
