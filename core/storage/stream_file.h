#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/clock_offsets.h"
#include "core/stream_sample.h"

namespace jnd::core {

/// A stream of another recorder, as it was received during a session, in a file of its own
/// beside the recording: recordings/0001.stream-01.sqlite is the first one of session 1.
/// Samples are in blocks of zstd, each with a hash. The comparisons of the sender's clock with
/// ours are rows. A file is written once, from its opening to its seal, and never again. Not
/// real time.

/// What the stream said about itself.
struct StreamFileInfo {
  std::string name, type;
  ChannelFormat format = ChannelFormat::kFloat32;
  int channel_count = 1;
  double nominal_rate_hz = 0.0;  ///< 0 for a stream without a rate.
  std::string xml;               ///< The whole description.
};

/// The end of the file, which the log of the session repeats. The hash covers everything before
/// it.
struct StreamFileSeal {
  std::int64_t num_samples = 0, num_offsets = 0;
  std::string sha256;

  friend bool operator==(const StreamFileSeal&, const StreamFileSeal&) = default;
};

/// Not thread-safe. Throws `Error` naming the file.
class StreamFileWriter {
 public:
  /// Makes the file, which must not exist.
  StreamFileWriter(const std::filesystem::path& file, const StreamFileInfo& info);
  ~StreamFileWriter();
  StreamFileWriter(const StreamFileWriter&) = delete;
  StreamFileWriter& operator=(const StreamFileWriter&) = delete;

  void append(const StreamSample& sample);
  void append(const ClockOffset& offset);
  /// Returns once everything appended so far is on disk.
  void flush();
  /// Flushes and seals the file. Nothing may be appended afterwards.
  StreamFileSeal seal();

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/// Throws `Error` for a file that is missing or foreign.
class StreamFileReader {
 public:
  explicit StreamFileReader(const std::filesystem::path& file);
  ~StreamFileReader();
  StreamFileReader(const StreamFileReader&) = delete;
  StreamFileReader& operator=(const StreamFileReader&) = delete;

  [[nodiscard]] const StreamFileInfo& info() const noexcept;
  /// Reads samples in the order in which they came. Throws `Error` at a damaged block.
  void read(const std::function<void(const StreamSample&)>& visit) const;
  [[nodiscard]] std::vector<ClockOffset> offsets() const;
  /// Returns none if the program ended before the seal.
  [[nodiscard]] std::optional<StreamFileSeal> seal() const;
  /// Reads everything and returns a sentence for each part that is damaged.
  [[nodiscard]] std::vector<std::string> problems() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/// Returns all stream files of a session, in the order of their numbers.
[[nodiscard]] std::vector<std::filesystem::path> stream_files(
    const std::filesystem::path& recording_file);
/// Returns the first stream file that does not exist yet.
[[nodiscard]] std::filesystem::path next_stream_file(
    const std::filesystem::path& recording_file);
/// Returns the recording to which a stream file belongs, or "" for another file.
[[nodiscard]] std::filesystem::path recording_beside(const std::filesystem::path& stream_file);

/// Replaces the file at `target` as a whole. The target's folder must exist.
void copy_stream_file(const std::filesystem::path& source, const std::filesystem::path& target);

}  // namespace jnd::core
