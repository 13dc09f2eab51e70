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

/// What another recorder sent beside a session, as it came, in a file of its own beside the
/// recording: recordings/0001.stream-01.sqlite is the first of session 1. Samples are in blocks
/// of zstd, each with a hash; the comparisons of its clock with ours are rows. A file is
/// written once, from its opening to its seal, and never again. Not real time.

/// What the stream said of itself.
struct StreamFileInfo {
  std::string name, type;
  ChannelFormat format = ChannelFormat::kFloat32;
  int channel_count = 1;
  double nominal_rate_hz = 0.0;  ///< 0: without one.
  std::string xml;               ///< All of it.
};

/// What stands at the end, and in the log of the session: the hash is over everything before.
struct StreamFileSeal {
  std::int64_t num_samples = 0, num_offsets = 0;
  std::string sha256;

  friend bool operator==(const StreamFileSeal&, const StreamFileSeal&) = default;
};

/// Not thread-safe. Throws `Error` naming the file.
class StreamFileWriter {
 public:
  /// Makes the file, which must not be there.
  StreamFileWriter(const std::filesystem::path& file, const StreamFileInfo& info);
  ~StreamFileWriter();
  StreamFileWriter(const StreamFileWriter&) = delete;
  StreamFileWriter& operator=(const StreamFileWriter&) = delete;

  void append(const StreamSample& sample);
  void append(const ClockOffset& offset);
  /// Everything appended so far is on disk when this returns.
  void flush();
  /// Flushes and seals: nothing more is appended.
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
  /// In the order in which they came. Throws `Error` at a block that is damaged.
  void read(const std::function<void(const StreamSample&)>& visit) const;
  [[nodiscard]] std::vector<ClockOffset> offsets() const;
  /// None where the program ended before it.
  [[nodiscard]] std::optional<StreamFileSeal> seal() const;
  /// What is damaged, a sentence each; reads everything.
  [[nodiscard]] std::vector<std::string> problems() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/// All of a session, in the order of their numbers.
[[nodiscard]] std::vector<std::filesystem::path> stream_files(
    const std::filesystem::path& recording_file);
/// The first that is not there yet.
[[nodiscard]] std::filesystem::path next_stream_file(
    const std::filesystem::path& recording_file);
/// The recording beside which a stream lies; "" for a file that is none.
[[nodiscard]] std::filesystem::path recording_beside(const std::filesystem::path& stream_file);

/// Replaces what `target` has of it, as a whole. `target` has its folder.
void copy_stream_file(const std::filesystem::path& source, const std::filesystem::path& target);

}  // namespace jnd::core
