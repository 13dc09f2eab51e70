#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "core/clock_offsets.h"
#include "core/stream_sample.h"

namespace jnd::analysis {

/// A file of the Extensible Data Format, version 1.0, as it is specified
/// (github.com/sccn/xdf/wiki/Specifications): chunks, each with its length and what it is.
/// Streams have numbers from 1. Not real time.
class XdfFile {
 public:
  /// Throws `core::Error` where it cannot be made.
  explicit XdfFile(std::filesystem::path file);

  /// Before anything else of a stream. `xml`: what it says of itself.
  void stream_header(std::uint32_t stream, std::string_view xml);
  /// Of one stream, each with its time.
  void samples(std::uint32_t stream, core::ChannelFormat format,
               const std::vector<core::StreamSample>& samples);
  void clock_offset(std::uint32_t stream, const core::ClockOffset& offset);
  /// From which a reader finds its way again in a file that is damaged before it.
  void boundary();
  void stream_footer(std::uint32_t stream, std::string_view xml);
  /// Throws `core::Error` where something was not written.
  void finish();

 private:
  void chunk(std::uint16_t tag, std::string_view content);

  std::filesystem::path file_;
  std::ofstream stream_;
};

/// One stream of such a file: its header at once, then samples, cut into chunks with boundaries
/// between them, and at the end the footer, which says how many there were.
class XdfStream {
 public:
  XdfStream(XdfFile& file, std::uint32_t number, core::ChannelFormat format,
            std::string_view xml);

  void add(core::StreamSample sample);
  void add(const core::ClockOffset& offset);
  void finish();
  [[nodiscard]] std::int64_t num_samples() const noexcept { return num_samples_; }

 private:
  void flush();

  XdfFile& file_;
  std::uint32_t number_;
  core::ChannelFormat format_;
  std::vector<core::StreamSample> pending_;
  std::size_t num_pending_bytes_ = 0;
  std::vector<core::ClockOffset> offsets_;
  std::int64_t num_samples_ = 0;
  double first_time_s_ = 0.0, last_time_s_ = 0.0;
};

}  // namespace jnd::analysis
