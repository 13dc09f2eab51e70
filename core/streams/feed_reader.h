#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/stream_sample.h"
#include "core/streams/stream_info.h"

namespace jnd::core {

/// The other side says that the stream is not there any more.
struct StreamGone {};

/// What an outlet sends, from its answer to the last sample, as it comes in from a connection:
/// bytes in, samples out. Not real time.
class FeedReader {
 public:
  explicit FeedReader(StreamInfo info) : info_(std::move(info)) {}

  void take(std::string_view bytes) { bytes_.append(bytes); }
  /// The next sample with its time, worked out where it was not told; none where the rest is
  /// still to come. Throws `Error` for what cannot be a feed of this stream, and `StreamGone`.
  [[nodiscard]] std::optional<StreamSample> next();
  /// The answer and both test samples were read and are as they should be.
  [[nodiscard]] bool is_open() const noexcept { return num_tests_ == 2; }

 private:
  [[nodiscard]] bool read_answer();
  [[nodiscard]] bool read_header();
  std::optional<StreamSample> take_one();
  void require_not_too_large() const;

  StreamInfo info_;
  std::string bytes_;
  std::size_t at_ = 0;  ///< Of `bytes_`, what was read.
  bool has_answer_ = false;
  bool is_archived_ = false;  ///< Texts by protocol 1.00.
  bool has_header_ = false;   ///< Of such a feed.
  bool big_endian_ = false;
  int num_tests_ = 0;
  double last_time_s_ = 0.0;
};

}  // namespace jnd::core
