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

/// Writes a session's samples to recordings/SESSION.sqlite: fixed point (0.1 um, 0.1 mm/s, 1
/// mN), second differences, zstd, a hash a chunk. Not thread-safe; not real time.
class RecordingWriter {
 public:
  /// Opens a new segment after whatever the file holds.
  RecordingWriter(const std::filesystem::path& file, double rate_hz,
                  Durability durability = Durability::kEveryCommit);
  ~RecordingWriter();
  RecordingWriter(const RecordingWriter&) = delete;
  RecordingWriter& operator=(const RecordingWriter&) = delete;

  /// Samples come in order of their tick; a gap starts a new chunk, and what its first sample
  /// says never ran is kept as such.
  void append(const Sample& sample);
  /// Everything appended so far is on disk when this returns.
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
  bool intact = false;  ///< The hash fits the bytes, and they decode to the samples promised.
};

/// Reads a recording. Throws `Error` if the file is missing or foreign; one that was being made
/// when its program died holds nothing. Not real time.
class RecordingReader {
 public:
  explicit RecordingReader(const std::filesystem::path& file);
  ~RecordingReader();
  RecordingReader(const RecordingReader&) = delete;
  RecordingReader& operator=(const RecordingReader&) = delete;

  [[nodiscard]] double rate_hz() const noexcept;
  /// Whether the device told of joints, as the first chunk says. Throws `Error` if that is
  /// damaged.
  [[nodiscard]] bool has_joints() const;
  /// What else the device measured, as the first chunk of each segment says. Throws `Error` if
  /// one is damaged.
  [[nodiscard]] ChannelBits channels() const;
  /// Whether samples tell the monotonic time and the device's. Quick.
  [[nodiscard]] bool has_times() const;
  /// Reads and decodes everything.
  [[nodiscard]] std::vector<RecordingChunk> chunks() const;
  /// -1 if there is no sample. Quick.
  [[nodiscard]] std::int64_t last_tick() const;
  /// Ticks between the first and the last sample that ran and that no chunk holds: lost. Quick:
  /// no sample is read.
  [[nodiscard]] std::int64_t missing_ticks() const;
  /// Ticks that were due and never ran, ascending and merged. Quick.
  [[nodiscard]] std::vector<TickRange> missed() const;
  /// The ticks of the chunks and those that never ran: whatever is not among them is lost.
  [[nodiscard]] std::vector<TickRange> accounted() const;
  /// The ticks that its chunks tell, ascending and merged. Quick: no sample is read.
  [[nodiscard]] std::vector<TickRange> ticks() const;
  /// Calls `visit` for every sample with first_tick <= tick <= last_tick, in order. Throws
  /// `Error` naming the chunk whose bytes do not fit their hash, before any sample of it.
  void read(std::int64_t first_tick, std::int64_t last_tick,
            const std::function<void(const Sample&)>& visit) const;
  /// Throws `Error` as `read` does. Reads everything, decodes nothing.
  void require_intact() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace jnd::core
