#include "analysis/export/xdf_file.h"

#include <array>
#include <cstring>
#include <utility>

#include "core/error.h"
#include "core/streams/stream_info.h"
#include "core/streams/xml_element.h"

namespace jnd::analysis {
namespace {

// The types of chunks.
constexpr std::uint16_t kFileHeader = 1, kStreamHeader = 2, kSamples = 3, kClockOffset = 4,
                        kBoundary = 5, kStreamFooter = 6;
/// The specified mark in every boundary.
constexpr std::array<unsigned char, 16> kBoundaryMark = {0x43, 0xA5, 0x46, 0xDC, 0xCB, 0xF5,
                                                         0x41, 0x0F, 0xB3, 0x0E, 0xD5, 0x46,
                                                         0x73, 0x83, 0xCB, 0xE4};
constexpr std::size_t kSamplesOfChunk = 1000;
constexpr std::size_t kBytesOfChunk = std::size_t{1} << 20;

template <typename Number>
void put(std::string& bytes, Number value) {
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);
  bytes.append(raw, sizeof value);
}

/// Writes a length, preceded by its number of bytes: 1, 4 or 8.
void put_length(std::string& bytes, std::uint64_t length) {
  if (length <= 0xFF) {
    bytes += char{1};
    put(bytes, static_cast<std::uint8_t>(length));
  } else if (length <= 0xFFFFFFFFU) {
    bytes += char{4};
    put(bytes, static_cast<std::uint32_t>(length));
  } else {
    bytes += char{8};
    put(bytes, length);
  }
}

}  // namespace

XdfFile::XdfFile(std::filesystem::path file)
    : file_(std::move(file)), stream_(file_, std::ios::binary | std::ios::trunc) {
  if (!stream_) {
    throw core::Error(file_.string() + ": expected to make this file, found that it cannot be");
  }
  stream_ << "XDF:";
  core::XmlElement info{.name = "info"};
  info.add("version", "1.0");
  chunk(kFileHeader, core::xml_text(info));
}

void XdfFile::chunk(std::uint16_t tag, std::string_view content) {
  std::string head;
  put_length(head, content.size() + sizeof tag);
  put(head, tag);
  stream_ << head << content;
}

void XdfFile::stream_header(std::uint32_t stream, std::string_view xml) {
  std::string content;
  put(content, stream);
  content += xml;
  chunk(kStreamHeader, content);
}

void XdfFile::samples(std::uint32_t stream, core::ChannelFormat format,
                      const std::vector<core::StreamSample>& samples) {
  std::string content;
  put(content, stream);
  put_length(content, samples.size());
  for (const core::StreamSample& sample : samples) {
    content += char{sizeof sample.time_s};
    put(content, sample.time_s);
    if (format != core::ChannelFormat::kString) content += sample.values;
    for (const std::string& text : sample.texts) {
      put_length(content, text.size());
      content += text;
    }
  }
  chunk(kSamples, content);
}

void XdfFile::clock_offset(std::uint32_t stream, const core::ClockOffset& offset) {
  std::string content;
  put(content, stream);
  put(content, offset.time_s);
  put(content, offset.offset_s);
  chunk(kClockOffset, content);
}

void XdfFile::boundary() {
  chunk(kBoundary, std::string(kBoundaryMark.begin(), kBoundaryMark.end()));
}

void XdfFile::stream_footer(std::uint32_t stream, std::string_view xml) {
  std::string content;
  put(content, stream);
  content += xml;
  chunk(kStreamFooter, content);
}

void XdfFile::finish() {
  stream_.close();
  if (!stream_) {
    throw core::Error(file_.string() +
                      ": expected room for all of it, found that it could not "
                      "be written whole");
  }
}

XdfStream::XdfStream(XdfFile& file, std::uint32_t number, core::ChannelFormat format,
                     std::string_view xml)
    : file_(file), number_(number), format_(format) {
  file_.stream_header(number_, xml);
}

void XdfStream::add(core::StreamSample sample) {
  if (num_samples_++ == 0) first_time_s_ = sample.time_s;
  last_time_s_ = sample.time_s;
  num_pending_bytes_ += sample.values.size();
  for (const std::string& text : sample.texts) num_pending_bytes_ += text.size();
  pending_.push_back(std::move(sample));
  if (pending_.size() >= kSamplesOfChunk || num_pending_bytes_ >= kBytesOfChunk) flush();
}

void XdfStream::add(const core::ClockOffset& offset) {
  offsets_.push_back(offset);
  file_.clock_offset(number_, offset);
}

void XdfStream::flush() {
  if (pending_.empty()) return;
  file_.samples(number_, format_, pending_);
  file_.boundary();
  pending_.clear();
  num_pending_bytes_ = 0;
}

void XdfStream::finish() {
  flush();
  core::XmlElement info{.name = "info"};
  if (num_samples_ > 0) {
    info.add("first_timestamp", core::stream_number(first_time_s_));
    info.add("last_timestamp", core::stream_number(last_time_s_));
  }
  info.add("sample_count", std::to_string(num_samples_));
  core::XmlElement& offsets = info.add("clock_offsets");
  for (const core::ClockOffset& one : offsets_) {
    core::XmlElement& offset = offsets.add("offset");
    offset.add("time", core::stream_number(one.time_s));
    offset.add("value", core::stream_number(one.offset_s));
  }
  file_.stream_footer(number_, core::xml_text(info));
}

}  // namespace jnd::analysis
