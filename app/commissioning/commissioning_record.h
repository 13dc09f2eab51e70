#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/commissioning/commissioning.h"

namespace jnd::app {

/// What happened to a line of a record.
enum class RecordedFate {
  kCounts,      ///< A measurement, the newest of its step.
  kSuperseded,  ///< A measurement whose step was measured again.
  kUndone,      ///< A measurement that was taken back.
  /// A measurement that used a step which was later measured again or taken back.
  kRestsOnOld,
  kFailed,     ///< An attempt that led to no measurement.
  kTakesBack,  ///< Not a measurement: it says that one is taken back.
};

/// A line of a record after the first one.
struct RecordedEntry {
  int line = 0;  ///< The line in the file, from 1.
  /// The step as it is written, even if this program does not know it.
  std::string step;
  std::string at;  ///< Such as "2026-11-25T10:12:00Z".
  RecordedFate fate = RecordedFate::kCounts;
  std::string why;               ///< Why it failed; "" otherwise.
  std::vector<FoundLine> found;  ///< What a measurement found.
  std::string operator_name;     ///< "" if nobody said it.
};

/// Everything that was ever measured of a device; the device itself is not needed.
struct CommissioningRecord {
  std::string device;  ///< The name as it is written after `--device`.
  device::DeviceIdentity identity;
  bool simulated = false;
  std::string begun_at;
  std::vector<RecordedEntry> entries;  ///< In the order of the file.
  /// What counts, with its points if they were stored.
  CommissioningResults results;
};

/// Reads a record. A line that the program did not finish writing is ignored. A step that is
/// not known becomes an entry but no result. Throws `core::Error` if the file cannot be read or
/// a line is damaged.
[[nodiscard]] CommissioningRecord read_commissioning_record(const std::filesystem::path& file);

/// Removes results that rest on a step that is measured again or taken back.
void forget_after(CommissioningResults& results, CommissioningStep changed);

}  // namespace jnd::app
