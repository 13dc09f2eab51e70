#include "core/streams/feed_reader.h"

#include "core/error.h"
#include "core/streams/archived_text.h"
#include "core/streams/stream_messages.h"
#include "core/streams/stream_wire.h"

namespace jnd::core {
namespace {

constexpr std::size_t kMostSampleBytes = std::size_t{1} << 24;
/// Bytes that were read are discarded once they are this many.
constexpr std::size_t kKeptBytes = std::size_t{1} << 16;

}  // namespace

bool FeedReader::read_answer() {
  const auto answer = feed_answer_of(std::string_view(bytes_).substr(at_));
  if (!answer) return false;
  if (answer->code == 404) throw StreamGone{};
  if (answer->code != 200) {
    throw Error("stream: expected the code 200 of an outlet, found " +
                std::to_string(answer->code));
  }
  constexpr int kArchived = 100;
  is_archived_ = answer->data_version == kArchived && info_.format == ChannelFormat::kString;
  if (answer->data_version != kStreamProtocol && !is_archived_) {
    throw Error("stream: expected samples by protocol " + std::to_string(kStreamProtocol) +
                ", found " + std::to_string(answer->data_version));
  }
  if (!answer->uid.empty() && answer->uid != info_.uid) throw StreamGone{};
  big_endian_ = answer->big_endian;
  at_ += answer->num_bytes;
  return true;
}

bool FeedReader::read_header() {
  const auto header = take_archived_header(std::string_view(bytes_).substr(at_));
  if (!header) {
    require_not_too_large();
    return false;
  }
  if (stream_info_from(header->xml, "stream").uid != info_.uid) throw StreamGone{};
  at_ += header->num_bytes;
  return true;
}

void FeedReader::require_not_too_large() const {
  if (bytes_.size() - at_ <= kMostSampleBytes) return;
  throw Error("stream: expected samples of at most " + std::to_string(kMostSampleBytes) +
              " bytes, found a larger one");
}

std::optional<StreamSample> FeedReader::take_one() {
  const std::string_view rest = std::string_view(bytes_).substr(at_);
  auto taken = is_archived_ ? take_archived_sample(rest, info_.channel_count)
                            : take_sample(rest, info_.format, info_.channel_count, big_endian_);
  if (!taken) {
    require_not_too_large();
    bytes_.erase(0, at_);
    at_ = 0;
    return std::nullopt;
  }
  at_ += taken->num_bytes;
  if (at_ > kKeptBytes) {
    bytes_.erase(0, at_);
    at_ = 0;
  }
  if (!taken->has_time) {
    taken->sample.time_s =
        last_time_s_ + (info_.nominal_rate_hz > 0.0 ? 1.0 / info_.nominal_rate_hz : 0.0);
  }
  return std::move(taken->sample);
}

std::optional<StreamSample> FeedReader::next() {
  if (!has_answer_ && !(has_answer_ = read_answer())) return std::nullopt;
  if (is_archived_ && !has_header_ && !(has_header_ = read_header())) return std::nullopt;
  for (; num_tests_ < 2; ++num_tests_) {
    const auto sample = take_one();
    if (!sample) return std::nullopt;
    if (*sample != test_sample(info_.format, info_.channel_count, num_tests_ == 0 ? 4 : 2)) {
      throw Error("stream: expected the two test samples of every feed first, found others");
    }
  }
  auto sample = take_one();
  if (sample) last_time_s_ = sample->time_s;
  return sample;
}

}  // namespace jnd::core
