#include "core/streams/stream_wire.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <string>

#include "core/error.h"
#include "core/streams/feed_reader.h"
#include "core/streams/stream_messages.h"

namespace jnd::core {
namespace stream_wire_test {

constexpr ChannelFormat kAllFormats[] = {ChannelFormat::kFloat32, ChannelFormat::kDouble64,
                                         ChannelFormat::kString,  ChannelFormat::kInt32,
                                         ChannelFormat::kInt16,   ChannelFormat::kInt8,
                                         ChannelFormat::kInt64};

std::string bytes_of(const StreamSample& sample, ChannelFormat format) {
  std::string bytes;
  append_sample(bytes, sample, format);
  return bytes;
}

TEST(StreamWire, EverySampleIsReadBackFromAnyBeginningOfItsBytes) {
  for (const ChannelFormat format : kAllFormats) {
    StreamSample sample = test_sample(format, 3, 4);
    sample.time_s = -1.5e6;
    if (format == ChannelFormat::kString) sample.texts[1] = std::string(300, 'x');
    const std::string bytes = bytes_of(sample, format);
    for (std::size_t size = 0; size < bytes.size(); ++size) {
      EXPECT_FALSE(take_sample(std::string_view(bytes).substr(0, size), format, 3, false));
    }
    const auto taken = take_sample(bytes + "more", format, 3, false);
    ASSERT_TRUE(taken) << name(format);
    EXPECT_EQ(taken->sample, sample) << name(format);
    EXPECT_EQ(taken->num_bytes, bytes.size());
    EXPECT_TRUE(taken->has_time);
  }
}

/// These bytes come from a machine with the other byte order.
TEST(StreamWire, NumbersOfTheOtherByteOrderAreTurnedRound) {
  const std::string bytes("\x02\x40\x09\x21\xFB\x54\x44\x2D\x18\x00\x01\xFF\xFE", 13);
  const auto taken = take_sample(bytes, ChannelFormat::kInt16, 2, /*big_endian=*/true);
  ASSERT_TRUE(taken);
  EXPECT_DOUBLE_EQ(taken->sample.time_s, 3.141592653589793);
  EXPECT_EQ(taken->sample.values, std::string("\x01\x00\xFE\xFF", 4));
}

TEST(StreamWire, TheTestSamplesAreThoseOfTheProtocol) {
  // By definition, a value is channel plus offset, and every other one is negative.
  float floats[3];
  std::memcpy(floats, test_sample(ChannelFormat::kFloat32, 3, 4).values.data(), sizeof floats);
  EXPECT_EQ(floats[0], 4.0F);
  EXPECT_EQ(floats[1], -5.0F);
  EXPECT_EQ(floats[2], 6.0F);
  std::int16_t shorts[2];
  std::memcpy(shorts, test_sample(ChannelFormat::kInt16, 2, 2).values.data(), sizeof shorts);
  EXPECT_EQ(shorts[0], 259);
  EXPECT_EQ(shorts[1], -260);
  EXPECT_EQ(test_sample(ChannelFormat::kString, 2, 4).texts,
            (std::vector<std::string>{"10", "-11"}));
  EXPECT_EQ(test_sample(ChannelFormat::kInt8, 200, 4).values.size(), 200U);
}

TEST(StreamWire, WhatIsNoSampleIsRefused) {
  const auto take = [](const std::string& bytes, ChannelFormat format) {
    return take_sample(bytes, format, 1, false);
  };
  EXPECT_THROW((void)take("\x03", ChannelFormat::kInt8), Error);
  EXPECT_THROW((void)take("\x01\x03", ChannelFormat::kString), Error) << "a length of 3 bytes";
  EXPECT_THROW((void)take(std::string("\x01\x08\xFF\xFF\xFF\xFF\xFF\xFF\xFF\xFF", 10),
                          ChannelFormat::kString),
               Error);
  EXPECT_THROW((void)take(std::string("\x01\x04\x00\x00\x00\x7F", 6), ChannelFormat::kString),
               Error);
  StreamSample timeless = test_sample(ChannelFormat::kInt8, 1, 4);
  timeless.time_s = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW((void)take(bytes_of(timeless, ChannelFormat::kInt8), ChannelFormat::kInt8),
               Error);
}

StreamInfo fast_info() {
  return {.name = "a",
          .channel_count = 1,
          .nominal_rate_hz = 4.0,
          .format = ChannelFormat::kInt8,
          .uid = "me"};
}

std::string begin_of_feed(const StreamInfo& info) {
  return feed_answer_message(info.uid) +
         bytes_of(test_sample(info.format, info.channel_count, 4), info.format) +
         bytes_of(test_sample(info.format, info.channel_count, 2), info.format);
}

TEST(FeedReader, ReadsAFeedByteByByteAndWorksTimesOut) {
  const StreamInfo info = fast_info();
  StreamSample told{.time_s = 10.0, .values = "a"};
  const std::string bytes =
      begin_of_feed(info) + bytes_of(told, info.format) + "\x01" + "b" + "\x01" + "c";
  FeedReader reader(info);
  std::vector<StreamSample> came;
  for (const char byte : bytes) {
    reader.take(std::string_view(&byte, 1));
    while (auto sample = reader.next()) came.push_back(*sample);
  }
  EXPECT_TRUE(reader.is_open());
  ASSERT_EQ(came.size(), 3U);
  EXPECT_EQ(came[0].time_s, 10.0);
  EXPECT_EQ(came[1].time_s, 10.25);
  EXPECT_EQ(came[2].time_s, 10.5);
  EXPECT_EQ(came[2].values, "c");
}

/// liblsl 1.10 sent this to a consumer whose texts have another size in memory than its own.
/// The description is shortened, with its length.
TEST(FeedReader, ReadsTextsByTheOlderProtocol) {
  const StreamInfo info{
      .name = "xs", .channel_count = 2, .format = ChannelFormat::kString, .uid = "224e592d"};
  const std::string xml =
      "<info><name>xs</name><channel_count>2</channel_count><nominal_srate>0</nominal_srate>"
      "<channel_format>string</channel_format><version>1.1000000000000001</version>"
      "<created_at>3062.1561970610001</created_at><uid>224e592d</uid></info>";
  const std::string test(
      "\x01\x02\x08\xc9v\xbe\x9f\x0c$\xfe@\x01\x02"
      "10\x01\x03-11",
      20);
  std::string bytes =
      "LSL/110 200 OK\r\nUID: 224e592d\r\nByte-Order: 0\r\nSuppress-Subnormals: 0\r\n"
      "Data-Protocol-Version: 100\r\n\r\n\x7f\x01\t\x01";
  bytes += static_cast<char>(xml.size());
  bytes += xml + std::string(2, '\0') + test + test;
  bytes += std::string(
      "\x01\x02\x08\x00\x00\x00\x00\x00\x00\xe0?\x01\x01"
      "a\x00",
      15);
  bytes += std::string("\x01\x02\x08\x00\x00\x00\x00\x00\x00\x08\xc0\x02,\x01", 14) +
           std::string(300, 'x') + "\x01\x02yz";
  FeedReader reader(info);
  std::vector<StreamSample> came;
  for (const char byte : bytes) {
    reader.take(std::string_view(&byte, 1));
    while (auto sample = reader.next()) came.push_back(*sample);
  }
  ASSERT_EQ(came.size(), 2U);
  EXPECT_EQ(came[0], (StreamSample{.time_s = 0.5, .values = {}, .texts = {"a", ""}}));
  EXPECT_EQ(came[1].time_s, -3.0);
  EXPECT_EQ(came[1].texts[0], std::string(300, 'x'));
  EXPECT_EQ(came[1].texts[1], "yz");
  FeedReader other(
      {.name = "xs", .channel_count = 2, .format = ChannelFormat::kString, .uid = "another"});
  other.take(bytes);
  EXPECT_THROW((void)other.next(), StreamGone);
}

TEST(FeedReader, RefusesWhatIsNoFeedOfThisStream) {
  const StreamInfo info = fast_info();
  const auto read = [&info](const std::string& bytes) {
    FeedReader reader(info);
    reader.take(bytes);
    while (reader.next()) {
    }
  };
  EXPECT_NO_THROW(read(begin_of_feed(info)));
  EXPECT_THROW(read("HTTP/1.1 200 OK\r\n\r\n"), Error);
  EXPECT_THROW(read("LSL/110 505 Version not supported\r\n\r\n"), Error);
  EXPECT_THROW(read("LSL/110 404 Not found\r\n\r\n"), StreamGone);
  EXPECT_THROW(read("LSL/110 200 OK\r\nUID: other\r\n\r\n"), StreamGone);
  EXPECT_THROW(read("LSL/110 200 OK\r\nByte-Order: 2143\r\n\r\n"), Error);
  EXPECT_THROW(read("LSL/110 200 OK\r\nData-Protocol-Version: 100\r\n\r\n"), Error);
  EXPECT_THROW(read(std::string(100'000, 'x')), Error) << "a line without an end";
  EXPECT_THROW(read("LSL/110 200 OK\r\n" + std::string(100'000, 'x')), Error);
  std::string other = feed_answer_message(info.uid);
  other += bytes_of(test_sample(info.format, 1, 3), info.format);
  EXPECT_THROW(read(other), Error) << "another test sample";
}

TEST(StreamMessages, AreReadBackAsTheyWereWritten) {
  const auto search =
      search_of(search_message({.query = "name='a'", .return_port = 4711, .id = "77"}));
  ASSERT_TRUE(search);
  EXPECT_EQ(search->query, "name='a'");
  EXPECT_EQ(search->return_port, 4711);
  EXPECT_EQ(search->id, "77");
  EXPECT_EQ(found_of(found_message("77", "<info/>"), "77"), "<info/>");
  EXPECT_FALSE(found_of(found_message("78", "<info/>"), "77"));
  const auto question = time_question_of(time_question_message({.wave = 5, .t0_s = 0.1}));
  ASSERT_TRUE(question);
  EXPECT_EQ(question->wave, 5);
  EXPECT_EQ(question->t0_s, 0.1);
  const auto answer = time_answer_of(
      time_answer_message({.wave = 5, .t0_s = 0.1, .t1_s = 1.0 / 3.0, .t2_s = -2.5}));
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->t1_s, 1.0 / 3.0);
  EXPECT_EQ(answer->t2_s, -2.5);
}

TEST(StreamMessages, WhatIsNoneIsLeftUnanswered) {
  for (const char* datagram :
       {"", "LSL:shortinfo", "LSL:shortinfo\r\n", "LSL:shortinfo\r\n\r\n",
        "LSL:shortinfo\r\nname='a'\r\n0 7\r\n", "LSL:shortinfo\r\nname='a'\r\n70000 7\r\n",
        "LSL:shortinfo\r\nname='a'\r\n4711\r\n", "LSL:shortinfo\r\nname='a'\r\n-1 7\r\n"}) {
    EXPECT_FALSE(search_of(datagram)) << datagram;
  }
  for (const char* datagram : {"LSL:timedata\r\n", "LSL:timedata\r\n1", "LSL:timedata\r\n1 nan",
                               "LSL:timedata\r\n1 1e300", "LSL:timedata\r\nx 1"}) {
    EXPECT_FALSE(time_question_of(datagram)) << datagram;
  }
  for (const char* datagram : {"", "1 2 3", "1 2 3 inf", "1 2 3 x", "1e3 2 3 4"}) {
    EXPECT_FALSE(time_answer_of(datagram)) << datagram;
  }
}

TEST(StreamMessages, RequestsAreToldApart) {
  EXPECT_TRUE(std::holds_alternative<AsksForMore>(request_of("LSL:fulli")));
  EXPECT_TRUE(std::holds_alternative<AsksFullInfo>(request_of("LSL:fullinfo\r\n")));
  EXPECT_TRUE(std::holds_alternative<AsksForMore>(request_of("LSL:shortinfo\r\n")));
  const StreamRequest info = request_of("LSL:shortinfo\r\nname='a'\r\n");
  EXPECT_EQ(std::get<AsksShortInfo>(info).query, "name='a'");
  EXPECT_TRUE(std::holds_alternative<AsksForMore>(request_of("LSL:streamfeed/110 me\r\n")));
  const StreamRequest feed = request_of(
      "LSL:streamfeed/110 me\r\nVALUE-SIZE: 4 ; bytes\r\nmax-buffer-length:12\r\nx\r\n\r\n");
  EXPECT_EQ(std::get<AsksFeed>(feed).uid, "me");
  EXPECT_EQ(std::get<AsksFeed>(feed).value_bytes, 4);
  EXPECT_EQ(std::get<AsksFeed>(feed).max_buffered, 12);
  for (const std::string& nonsense :
       {std::string("GET / HTTP/1.1\r\n"), std::string("LSL:streamfeed\r\n360 0\r\n"),
        std::string("LSL:streamfeed/9 me\r\n\r\n"), std::string("LSL:streamfeed/x me\r\n"),
        std::string("LSL:streamfeed/210 me\r\n\r\n"), std::string(20'000, 'x')}) {
    EXPECT_TRUE(std::holds_alternative<AsksNonsense>(request_of(nonsense)))
        << nonsense.substr(0, 40);
  }
  const StreamRequest ours = request_of(feed_request_message(fast_info(), 99));
  EXPECT_EQ(std::get<AsksFeed>(ours).max_buffered, 99);
  EXPECT_EQ(std::get<AsksFeed>(ours).uid, "me");
}

}  // namespace stream_wire_test
}  // namespace jnd::core
