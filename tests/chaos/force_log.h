#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "core/hand.h"

namespace jnd::chaos {

/// What one device was given from its opening to its end, as the device itself recorded it.
/// Times are those of CLOCK_MONOTONIC.
struct ForceLog {
  struct Record {
    std::int64_t time_ns = 0;
    core::PointVectors force_n;  ///< The force that stands from this time on.
  };
  std::vector<Record> records;
  /// Times in ascending order at which the process with the device certainly ran. They show
  /// whether a force stood because nobody ended it, or because the machine let no process run.
  std::vector<std::int64_t> beats_ns;
  /// Whether no other program can reach the device. This is so for a driver that is the child
  /// of a program.
  bool is_of_one_program = false;
};

/// Reads the file that a reference device or the observing driver wrote. Without a file of
/// beats, each record is a beat, because such a device writes one in each tick. An incomplete
/// record at the end is left out.
[[nodiscard]] ForceLog read_force_log(const std::filesystem::path& file,
                                      const std::filesystem::path& beats = {});

/// Watches a file that is still being written, from an offset on.
class ForceWatch {
 public:
  explicit ForceWatch(std::uintmax_t offset_bytes = 0) : offset_bytes_(offset_bytes) {}

  /// Returns whether there is force now and there was none at some time since the beginning. So
  /// the force of an earlier program does not count.
  [[nodiscard]] bool has_new_force(const std::filesystem::path& file);

 private:
  std::uintmax_t offset_bytes_;
  bool was_without_ = false, has_force_ = false;
};

/// A reason for which there must be no force at a device until a program is started again.
struct Revocation {
  /// What shows that the process that has to end the force was able to run.
  enum class Clock { kBeats, kRecords };
  static constexpr std::int64_t kNever_ns = std::numeric_limits<std::int64_t>::max();

  std::string cause;
  std::int64_t from_ns = 0;
  /// The time within which the force must be gone. Only time in which `clock` shows that the
  /// process could act counts.
  int within_ms = 0;
  Clock clock = Clock::kBeats;
  /// If the cause is over before this time, nothing is due.
  std::int64_t over_by_ns = kNever_ns;
};

/// What a device promises, and what the schedule did.
struct Happenings {
  double most_per_point_n = 0.0;
  double most_in_all_n = 0.0;
  /// The largest change at one point from one record to the next. An end of the force may be
  /// any step.
  double most_step_n = 0.0;
  /// How long a force may stand without being renewed. This does not apply to a device that
  /// writes a record in each tick.
  int longest_standing_ms = 0;
  /// These are in ascending order. Each program arms the device that it finds.
  std::vector<std::int64_t> program_starts_ns;
  std::vector<Revocation> revocations;
};

/// Returns what is wrong with the forces of a device, or "" if nothing is. The judge knows what
/// arrived and what the schedule did, and nothing that a program says about itself.
[[nodiscard]] std::string judged(const ForceLog& log, const Happenings& happenings);

/// Returns for how many ms there was force.
[[nodiscard]] int milliseconds_with_force(const ForceLog& log);

}  // namespace jnd::chaos
