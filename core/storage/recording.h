#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/sample.h"
#include "core/storage/recorded_ticks.h"
#include "core/storage/study_store.h"

namespace jnd::core {

/// Writes a session's samples to recordings/SESSION.sqlite, as fixed-point numbers (0.1 um, 0.1
/// mm/s, 1 mN) in second differences, compressed by zstd, with a hash for each chunk. Not
/// thread-safe. Not real time.
class RecordingWriter {
 public:
  /// Opens a new segment after what the file holds.
  RecordingWriter(const std::filesystem::path& file, double rate_hz,
                  Durability durability = Durability::kEveryCommit);
  ~RecordingWriter();
  RecordingWriter(const RecordingWriter&) = delete;
  RecordingWriter& operator=(const RecordingWriter&) = delete;

  /// Appends a sample. Samples come in the order of their ticks. A gap starts a new chunk. The
  /// ticks that the sample reports as never run are stored as such.
  void append(const Sample& sample);
  /// Returns once everything appended so far is on disk.
  void flush();

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/// One stored chunk, as `verify` and readers see it.
struct RecordingChunk {
  std::int64_t segment = 0;
  std::int64_t first_tick = 0;
  std::int64_t num_samples = 0;
  std::int64_t num_bytes = 0;
  bool intact = false;  ///< The hash fits the bytes, and they decode to the promised samples.
};

/// Reads a recording. Throws `Error` if the file is missing or foreign. A recording whose
/// program died while it made the file has no samples. Not real time.
class RecordingReader {
 public:
  explicit RecordingReader(const std::filesystem::path& file);
  ~RecordingReader();
  RecordingReader(const RecordingReader&) = delete;
  RecordingReader& operator=(const RecordingReader&) = delete;

  [[nodiscard]] double rate_hz() const noexcept;
  /// Whether the device reported joints, according to the first chunk. Throws `Error` if that
  /// chunk is damaged.
  [[nodiscard]] bool has_joints() const;
  /// Returns what else the device measured, according to the first chunk of each segment.
  /// Throws `Error` if one of them is damaged.
  [[nodiscard]] ChannelBits channels() const;
  /// Whether samples have the monotonic time and the device's time. Quick.
  [[nodiscard]] bool has_times() const;
  /// Reads and decodes everything.
  [[nodiscard]] std::vector<RecordingChunk> chunks() const;
  /// Returns -1 if there is no sample. Quick.
  [[nodiscard]] std::int64_t last_tick() const;
  /// Returns the number of ticks between the first and the last sample that ran but are in no
  /// chunk, so that they are lost. Quick, because no sample is read.
  [[nodiscard]] std::int64_t missing_ticks() const;
  /// Returns the ticks that were due and never ran, ascending and merged. Quick.
  [[nodiscard]] std::vector<TickRange> missed() const;
  /// Returns the ticks of the chunks and the ticks that never ran. All others are lost.
  [[nodiscard]] std::vector<TickRange> accounted() const;
  /// Returns the ticks of its chunks, ascending and merged. Quick, because no sample is read.
  [[nodiscard]] std::vector<TickRange> ticks() const;
  /// Calls `visit` for every sample with first_tick <= tick <= last_tick, in order. Throws
  /// `Error` naming the chunk whose bytes do not fit their hash, before it visits any of its
  /// samples.
  void read(std::int64_t first_tick, std::int64_t last_tick,
            const std::function<void(const Sample&)>& visit) const;
  /// Throws `Error` like `read`. It reads everything and decodes nothing.
  void require_intact() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace jnd::core
