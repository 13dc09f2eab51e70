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

/// A file in the Extensible Data Format, version 1.0 (github.com/sccn/xdf/wiki/Specifications).
/// It consists of chunks, each with its length and type. Streams are numbered from 1.
/// Not real time.
class XdfFile {
 public:
  /// Throws `core::Error` if the file cannot be made.
  explicit XdfFile(std::filesystem::path file);

  /// Must come before everything else of a stream. `xml` describes the stream.
  void stream_header(std::uint32_t stream, std::string_view xml);
  /// Writes samples of one stream, each with its time.
  void samples(std::uint32_t stream, core::ChannelFormat format,
               const std::vector<core::StreamSample>& samples);
  void clock_offset(std::uint32_t stream, const core::ClockOffset& offset);
  /// Writes a mark from which a reader can continue if the file is damaged before it.
  void boundary();
  void stream_footer(std::uint32_t stream, std::string_view xml);
  /// Throws `core::Error` if something was not written.
  void finish();

 private:
  void chunk(std::uint16_t tag, std::string_view content);

  std::filesystem::path file_;
  std::ofstream stream_;
};

/// One stream of such a file. It writes its header at once, then its samples in chunks with
/// boundaries between them, and at the end the footer with their number.
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
