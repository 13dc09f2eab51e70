#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/stream_sample.h"
#include "core/streams/stream_info.h"

namespace jnd::core {

/// Thrown when the other side says that the stream no longer exists.
struct StreamGone {};

/// Reads what an outlet sends, from its answer to the last sample: bytes of a connection go in,
/// samples come out. Not real time.
class FeedReader {
 public:
  explicit FeedReader(StreamInfo info) : info_(std::move(info)) {}

  void take(std::string_view bytes) { bytes_.append(bytes); }
  /// Returns the next sample with its time, which is computed if it was not sent. Returns none
  /// if more bytes have to come. Throws `Error` for bytes that cannot be a feed of this stream,
  /// and `StreamGone`.
  [[nodiscard]] std::optional<StreamSample> next();
  /// Whether the answer and both test samples were read and are correct.
  [[nodiscard]] bool is_open() const noexcept { return num_tests_ == 2; }

 private:
  [[nodiscard]] bool read_answer();
  [[nodiscard]] bool read_header();
  std::optional<StreamSample> take_one();
  void require_not_too_large() const;

  StreamInfo info_;
  std::string bytes_;
  std::size_t at_ = 0;  ///< How much of `bytes_` was read.
  bool has_answer_ = false;
  bool is_archived_ = false;  ///< The feed is of texts, by protocol 1.00.
  bool has_header_ = false;   ///< The header of such a feed was read.
  bool big_endian_ = false;
  int num_tests_ = 0;
  double last_time_s_ = 0.0;
};

}  // namespace jnd::core
