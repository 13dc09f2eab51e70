#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/commissioning/commissioning.h"

namespace jnd::app {

/// What became of a line of a record.
enum class RecordedFate {
  kCounts,      ///< A measurement, the newest of its step.
  kSuperseded,  ///< A measurement; its step was measured anew.
  kUndone,      ///< A measurement that was taken back.
  kRestsOnOld,  ///< A measurement; a step that it uses was measured anew or taken back.
  kFailed,      ///< No measurement came of it.
  kTakesBack,   ///< No measurement: it says that one is taken back.
};

/// A line of a record after the first.
struct RecordedEntry {
  int line = 0;      ///< Of the file, from 1.
  std::string step;  ///< As it is written, also where this program does not know it.
  std::string at;    ///< "2026-11-25T10:12:00Z".
  RecordedFate fate = RecordedFate::kCounts;
  std::string why;               ///< It failed; "" otherwise.
  std::vector<FoundLine> found;  ///< Of a measurement.
  std::string operator_name;     ///< "": not said.
};

/// All that was ever measured of a device, without the device.
struct CommissioningRecord {
  std::string device;  ///< As after `--device`.
  device::DeviceIdentity identity;
  bool simulated = false;
  std::string begun_at;
  std::vector<RecordedEntry> entries;  ///< In their order.
  CommissioningResults results;        ///< What counts, with its points where they are kept.
};

/// A line that a program died in is none. A step that is not known is an entry and no result.
/// Throws `core::Error`: it cannot be read, or a line is damaged.
[[nodiscard]] CommissioningRecord read_commissioning_record(const std::filesystem::path& file);

/// What rests on a step that is measured anew, or taken back, counts no more.
void forget_after(CommissioningResults& results, CommissioningStep changed);

}  // namespace jnd::app
