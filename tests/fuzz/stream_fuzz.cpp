#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>

#include "core/clock_offsets.h"
#include "core/error.h"
#include "core/streams/clock_probe.h"
#include "core/streams/feed_reader.h"
#include "core/streams/stream_messages.h"
#include "core/streams/stream_query.h"
#include "core/streams/stream_wire.h"
#include "fuzz/fuzz_check.h"

namespace {

using namespace jnd;
using core::ChannelFormat;

template <typename Act>
void refused_or_read(const Act& act) {
  try {
    act();
  } catch (const core::Error& error) {
    fuzz::check_sentence(error.what());
  }
}

void check_description(const std::string& text) {
  refused_or_read([&text] {
    const core::XmlElement xml = core::parse_xml(text, "stream");
    (void)core::matches_query(xml, text);
    const core::StreamInfo info = core::stream_info_from(xml, "stream");
    fuzz::property(info.channel_count >= 1 && info.channel_count <= core::kMostStreamChannels,
                   "a stream has channels, and not too many");
    fuzz::property(std::isfinite(info.nominal_rate_hz) && info.nominal_rate_hz >= 0.0,
                   "a rate is a number");
    fuzz::property(!info.uid.empty() && !info.name.empty(), "a stream has a name");
    const core::StreamInfo again =
        core::stream_info_from(core::xml_text(core::stream_xml(info, true)), "stream");
    fuzz::property(again.channel_count == info.channel_count && again.format == info.format &&
                       again.nominal_rate_hz == info.nominal_rate_hz,
                   "what was read is written and read again");
  });
}

/// Takes the text as a query to an existing stream.
void check_question(const std::string& text) {
  const core::XmlElement xml =
      core::stream_xml({.name = "a", .type = "EEG", .uid = "1"}, false);
  (void)core::matches_query(xml, text);
  fuzz::property(core::matches_query(xml, "name=" + core::quoted_for_query("a")),
                 "a stream answers to its name");
  if (const auto search = core::search_of(text)) {
    fuzz::property(search->return_port > 0 && search->id.size() <= 64,
                   "an answer goes somewhere, and is no larger for what was asked");
    (void)core::matches_query(xml, search->query);
  }
  if (const auto question = core::time_question_of(text)) {
    fuzz::property(std::isfinite(question->t0_s), "a time is a number");
  }
  core::ClockProbe probe(1);
  const auto asked = core::time_question_of(probe.due_question(1.0));
  fuzz::property(asked.has_value(), "our own question is one");
  for (int i = 0; i < 8; ++i) {
    probe.take_answer(text, 1.01 + 0.1 * i);
    (void)probe.due_question(1.1 + 0.1 * i);
  }
  if (const auto offset = probe.finished(10.0)) {
    fuzz::property(std::isfinite(offset->offset_s) && offset->round_trip_s >= 0.0,
                   "an offset is a number");
    fuzz::property(std::isfinite(core::ClockCorrection({*offset}).corrected_s(5.0)),
                   "a corrected time is one");
  }
  const core::StreamRequest request = core::request_of(text);
  if (const auto* feed = std::get_if<core::AsksFeed>(&request)) {
    fuzz::property(feed->version >= 110 && feed->version < 200, "a version that we speak");
  }
}

/// Takes the text as what an outlet sends after the beginning of a feed, and as a whole feed.
void check_feed(const std::string& text) {
  for (const ChannelFormat format :
       {ChannelFormat::kFloat32, ChannelFormat::kString, ChannelFormat::kInt8}) {
    for (const int channel_count : {1, 3}) {
      const core::StreamInfo info{.name = "a",
                                  .channel_count = channel_count,
                                  .nominal_rate_hz = 100.0,
                                  .format = format,
                                  .uid = "1"};
      std::string begin = core::feed_answer_message("1");
      for (const int offset : {4, 2}) {
        core::append_sample(begin, core::test_sample(format, channel_count, offset), format);
      }
      const std::string archived =
          "LSL/110 200 OK\r\nData-Protocol-Version: 100\r\n\r\n" + text;
      for (const std::string& bytes : {begin + text, text, archived}) {
        try {
          refused_or_read([&] {
            core::FeedReader reader(info);
            for (std::size_t at = 0; at < bytes.size(); at += 1000) {
              reader.take(std::string_view(bytes).substr(at, 1000));
              while (const auto sample = reader.next()) {
                fuzz::property(std::isfinite(sample->time_s), "a sample has a time");
                const std::size_t width = core::value_bytes(format);
                fuzz::property(
                    width > 0 ? sample->values.size() ==
                                    width * static_cast<std::size_t>(channel_count)
                              : sample->texts.size() == static_cast<std::size_t>(channel_count),
                    "a sample has a value for every channel");
              }
            }
          });
        } catch (const core::StreamGone&) {
          // The outlet says that the stream does not exist.
        }
      }
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text = fuzz::text_of(data, size);
  check_description(text);
  check_question(text);
  check_feed(text);
  return 0;
}
