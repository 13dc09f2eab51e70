#include <gtest/gtest.h>
#include <poll.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/streams/feed_reader.h"
#include "core/streams/stream_inlet.h"
#include "core/streams/stream_messages.h"
#include "core/streams/stream_outlet.h"
#include "core/streams/stream_search.h"
#include "core/streams/stream_wire.h"
#include "loopback_network.h"

namespace jnd::core {
namespace own_stream_test {

StreamInfo numbers(const std::string& name, const std::string& source_id = "") {
  return {.name = name,
          .type = "Test",
          .channel_count = 2,
          .nominal_rate_hz = 1000.0,
          .format = ChannelFormat::kInt32,
          .source_id = source_id,
          .channels = {{"a", "N", "Force"}, {"b", "", ""}}};
}

StreamSample counted(int count) {
  return {.time_s = 100.0 + 0.001 * count, .values = raw(std::vector<int>{count, -count})};
}

int count_of(const StreamSample& sample) {
  int count = 0;
  std::memcpy(&count, sample.values.data(), sizeof count);
  return count;
}

void push(StreamOutlet& outlet, int first, int end) {
  std::vector<StreamSample> samples;
  for (int i = first; i < end; ++i) samples.push_back(counted(i));
  outlet.push(samples);
}

std::unique_ptr<StreamInlet> inlet_of(const StreamOutlet& outlet,
                                      const StreamNetwork& network) {
  const auto found = find_streams(network, "uid='" + outlet.info().uid + "'", 5.0, 1);
  if (found.empty()) throw Error("not found");
  return open_own_inlet(found.front(), network);
}

TEST(OwnStream, IsFoundByNameAndSessionAlone) {
  const StreamNetwork network = loopback_network();
  const auto outlet = open_own_outlet(numbers("of " + network.session_id), network);
  const auto found =
      find_streams(network, query_for(network, "name", "of " + network.session_id), 5.0, 1);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].uid, outlet->info().uid);
  EXPECT_EQ(found[0].v4_address, "127.0.0.1");
  EXPECT_EQ(found[0].v4_data_port, outlet->info().v4_data_port);
  EXPECT_EQ(found[0].hostname, own_hostname());
  EXPECT_EQ(
      find_streams(network, query_for(network, "name", "of " + network.session_id), 0.8).size(),
      1U)
      << "each once, though it is asked twice";
  EXPECT_TRUE(find_streams(network, query_for(network, "name", "another"), 0.3).empty());
  EXPECT_TRUE(
      find_streams(loopback_network(), query_for(loopback_network(), "type", "Test"), 0.3)
          .empty())
      << "of another session";
}

/// Other programs look for streams by a multicast group, on an interface of this machine.
TEST(OwnStream, IsFoundByAGroupWhereTheMachineHasOne) {
  StreamNetwork network = loopback_network();
  network.peers.clear();
  network.groups = {"239.255.172.215"};
  network.search_port = 16581;
  network.num_hops = 0;  // Nothing leaves this machine.
  const auto outlet = open_own_outlet(numbers("group"), network);
  const auto found = find_streams(network, query_for(network, "name", "group"), 2.0, 1);
  if (found.empty()) GTEST_SKIP() << "this machine lets no group through";
  EXPECT_EQ(found[0].uid, outlet->info().uid);
}

TEST(OwnStream, EveryFormatComesThroughAsItWasSent) {
  const StreamNetwork network = loopback_network();
  for (const ChannelFormat format :
       {ChannelFormat::kFloat32, ChannelFormat::kDouble64, ChannelFormat::kString,
        ChannelFormat::kInt32, ChannelFormat::kInt16, ChannelFormat::kInt8,
        ChannelFormat::kInt64}) {
    StreamInfo info = numbers("formats");
    info.format = format;
    info.channel_count = 3;
    info.channels.clear();
    const auto outlet = open_own_outlet(info, network);
    const auto inlet = inlet_of(*outlet, network);
    ASSERT_TRUE(comes_about([&] { return outlet->num_consumers() == 1; }));
    std::vector<StreamSample> sent;
    for (int i = 0; i < 5; ++i) {
      sent.push_back(test_sample(format, 3, i));
      sent.back().time_s = 5.0 + i;
      if (format == ChannelFormat::kString) {
        sent.back().texts[1] = std::string(static_cast<std::size_t>(i) * 200, '\x07');
      }
    }
    outlet->push(sent);
    EXPECT_EQ(take_from(*inlet, 5), sent) << name(format);
    EXPECT_EQ(inlet->state(), StreamInlet::State::kReceiving);
  }
}

TEST(OwnStream, DescribesItselfToWhoeverAsks) {
  const StreamNetwork network = loopback_network();
  const auto outlet = open_own_outlet(numbers("described"), network);
  const auto inlet = inlet_of(*outlet, network);
  const XmlElement full = parse_xml(inlet->full_xml(), "test");
  EXPECT_EQ(full.child("desc")->child("channels")->children[0].child_text("unit"), "N");
}

TEST(OwnStream, SeveralConsumersGetAllOfIt) {
  const StreamNetwork network = loopback_network();
  const auto outlet = open_own_outlet(numbers("several"), network);
  std::vector<std::unique_ptr<StreamInlet>> inlets;
  for (int i = 0; i < 5; ++i) inlets.push_back(inlet_of(*outlet, network));
  ASSERT_TRUE(comes_about([&] { return outlet->num_consumers() == 5; }));
  for (int i = 0; i < 2000; i += 100) push(*outlet, i, i + 100);
  for (const auto& inlet : inlets) {
    const auto came = take_from(*inlet, 2000);
    ASSERT_EQ(came.size(), 2000U);
    for (int i = 0; i < 2000; ++i) EXPECT_EQ(came[static_cast<std::size_t>(i)], counted(i));
  }
  EXPECT_EQ(outlet->num_dropped(), 0);
}

TEST(OwnStream, WhoLeavesIsForgottenAndMayComeBack) {
  const StreamNetwork network = loopback_network();
  const auto outlet = open_own_outlet(numbers("leaving"), network);
  for (int round = 0; round < 3; ++round) {
    auto inlet = inlet_of(*outlet, network);
    ASSERT_TRUE(comes_about([&] { return outlet->num_consumers() == 1; })) << round;
    push(*outlet, 10 * round, 10 * round + 10);
    const auto came = take_from(*inlet, 10);
    ASSERT_EQ(came.size(), 10U);
    EXPECT_EQ(count_of(came[0]), 10 * round) << "nothing of before";
    inlet.reset();
    ASSERT_TRUE(comes_about([&] { return outlet->num_consumers() == 0; })) << round;
    push(*outlet, 1000, 1010);  // Nobody is connected.
  }
}

/// The program on the other side was restarted, with other ports and another identity.
TEST(OwnStream, AnInletFindsAStreamAgainThatWentAway) {
  const StreamNetwork network = loopback_network();
  auto outlet = open_own_outlet(numbers("returning", "source"), network);
  const auto inlet = inlet_of(*outlet, network);
  ASSERT_TRUE(comes_about([&] { return outlet->num_consumers() == 1; }));
  push(*outlet, 0, 10);
  ASSERT_EQ(take_from(*inlet, 10).size(), 10U);
  outlet.reset();
  ASSERT_TRUE(comes_about([&] { return inlet->state() == StreamInlet::State::kLost; }));
  EXPECT_NE(inlet->problem(), "");
  outlet = open_own_outlet(numbers("returning", "source"), network);
  ASSERT_TRUE(comes_about([&] { return outlet->num_consumers() == 1; }));
  push(*outlet, 10, 20);
  const auto came = take_from(*inlet, 10);
  ASSERT_EQ(came.size(), 10U);
  EXPECT_EQ(count_of(came[0]), 10);
  EXPECT_EQ(inlet->state(), StreamInlet::State::kReceiving);
}

TEST(OwnStream, WhatIsStillToBeSentIsSentAtTheEnd) {
  const StreamNetwork network = loopback_network();
  auto outlet = open_own_outlet(numbers("ending"), network);
  const auto inlet = inlet_of(*outlet, network);
  ASSERT_TRUE(comes_about([&] { return outlet->num_consumers() == 1; }));
  push(*outlet, 0, 20'000);
  outlet.reset();
  EXPECT_EQ(take_from(*inlet, 20'000).size(), 20'000U);
}

/// A consumer that reads only when the test says so.
class SlowConsumer {
 public:
  SlowConsumer(const StreamInfo& info, int max_buffered)
      : socket_(connecting_socket(*numeric_address("127.0.0.1", info.v4_data_port))) {
    (void)comes_about([&] {
      pollfd waits{.fd = socket_.descriptor(), .events = POLLOUT, .revents = 0};
      return ::poll(&waits, 1, 10) > 0;
    });
    (void)send_bytes(socket_, feed_request_message(info, max_buffered));
  }
  [[nodiscard]] const StreamSocket& socket() const noexcept { return socket_; }

 private:
  StreamSocket socket_;
};

TEST(OwnStream, OfASlowConsumerTheOldestSamplesAreDroppedAndCounted) {
  const StreamNetwork network = loopback_network();
  StreamInfo info = numbers("slow");
  // The samples are large, so that the buffers of the system hold few of them.
  info.channel_count = 200;
  info.channels.clear();
  const auto outlet = open_own_outlet(info, network, /*seconds_kept=*/2.0);
  const auto quick = inlet_of(*outlet, network);
  const SlowConsumer slow(outlet->info(), 1 << 20);
  ASSERT_TRUE(comes_about([&] { return outlet->num_consumers() == 2; }));
  constexpr int kNumSent = 60'000;
  std::size_t num_quick = 0;
  for (int i = 0; i < kNumSent; i += 1000) {
    std::vector<StreamSample> samples;
    for (int j = i; j < i + 1000; ++j) {
      samples.push_back({.time_s = static_cast<double>(j),
                         .values = raw(std::vector<int>(200, j)),
                         .texts = {}});
    }
    outlet->push(samples);
    ASSERT_TRUE(comes_about([&] {
      num_quick += quick->take_samples().size();
      return num_quick == static_cast<std::size_t>(i) + 1000;
    })) << "the slow one keeps nobody else from anything";
  }
  EXPECT_GT(outlet->num_dropped(), 0);
  // What the consumer gets in the end is in order and ends with the newest sample, with a gap
  // where it was too slow.
  FeedReader reader(outlet->info());
  int last = -1;
  std::int64_t num_came = 0;
  (void)comes_about([&] {
    while (true) {
      const auto some = receive_bytes(slow.socket());
      if (!some || some->empty()) break;
      reader.take(*some);
    }
    while (const auto sample = reader.next()) {
      EXPECT_GT(count_of(*sample), last);
      last = count_of(*sample);
      ++num_came;
    }
    return last == kNumSent - 1;
  });
  EXPECT_EQ(last, kNumSent - 1);
  EXPECT_EQ(num_came + outlet->num_dropped(), kNumSent);
}

TEST(OwnStream, WhoWantsNoSamplesGetsTheBeginningAlone) {
  const StreamNetwork network = loopback_network();
  const auto outlet = open_own_outlet(numbers("glance"), network);
  const SlowConsumer glance(outlet->info(), 0);
  std::string bytes;
  EXPECT_TRUE(comes_about([&] {
    const auto some = receive_bytes(glance.socket());
    if (some) bytes += *some;
    return !some.has_value();
  })) << "the outlet ends it";
  EXPECT_EQ(outlet->num_consumers(), 0);
  EXPECT_TRUE(bytes.starts_with("LSL/110 200 OK\r\n"));
}

TEST(OwnStream, NonsenseIsSentAwayAndTheStreamGoesOn) {
  const StreamNetwork network = loopback_network();
  const auto outlet = open_own_outlet(numbers("robust"), network);
  const auto inlet = inlet_of(*outlet, network);
  ASSERT_TRUE(comes_about([&] { return outlet->num_consumers() == 1; }));
  const StreamAddress data = *numeric_address("127.0.0.1", outlet->info().v4_data_port);
  for (const std::string& request :
       {std::string("GET / HTTP/1.1\r\n\r\n"), std::string("LSL:streamfeed\r\n360 0\r\n"),
        std::string(
            "LSL:streamfeed/110 someone-else\r\nValue-Size: 4\r\nMax-Buffer-Length: 5\r\n\r\n"),
        std::string(100'000, '\xFF'),
        std::string("LSL:streamfeed/110\r\nValue-Size: 8\r\nMax-Buffer-Length: 5\r\n\r\n"),
        std::string("LSL:streamfeed/110\r\nHas-IEEE754-Floats: 0\r\nValue-Size: 4\r\n\r\n")}) {
    const StreamSocket socket = connecting_socket(data);
    std::string answer;
    bool is_sent = false;
    EXPECT_TRUE(comes_about([&] {
      pollfd waits{.fd = socket.descriptor(), .events = POLLOUT | POLLIN, .revents = 0};
      (void)::poll(&waits, 1, 10);
      if (!is_sent) is_sent = send_bytes(socket, request).value_or(1) > 0;
      const auto bytes = receive_bytes(socket);
      if (bytes) answer += *bytes;
      return !bytes.has_value();
    })) << request.substr(0, 40);
    EXPECT_EQ(answer.find(" 200 "), std::string::npos) << answer;
  }
  const StreamSocket datagrams = datagram_socket();
  const StreamAddress service = *numeric_address("127.0.0.1", outlet->info().v4_service_port);
  for (const std::string& datagram :
       {std::string("x"), std::string("LSL:shortinfo\r\n\r\n0 1\r\n"),
        std::string("LSL:timedata\r\nnan nan\r\n"), std::string(60'000, 'x')}) {
    EXPECT_TRUE(send_datagram(datagrams, datagram, service));
  }
  push(*outlet, 0, 10);
  EXPECT_EQ(take_from(*inlet, 10).size(), 10U);
}

TEST(OwnStream, AnOutletThatSpeaksOtherwiseIsNotReadAndDoesNoHarm) {
  StreamNetwork network = loopback_network();
  const StreamSocket listener = listening_socket(network);
  StreamInfo info = numbers("impostor");
  info.uid = "1";
  info.v4_address = "127.0.0.1";
  info.v4_data_port = listener.port();
  info.v4_service_port = listener.port();
  EXPECT_THROW((void)open_own_inlet(info, network, 0.5), Error) << "says nothing";
  info.v4_data_port = 1;
  EXPECT_THROW((void)open_own_inlet(info, network, 0.5), Error) << "nobody there";
}

TEST(OwnStream, ClocksAreComparedWhileItRuns) {
  StreamNetwork there = loopback_network();
  constexpr double kBehind_s = 5000.0;
  there.clock_s = [] { return stream_clock_s() - kBehind_s; };
  StreamNetwork here = there;
  here.clock_s = stream_clock_s;
  const auto outlet = open_own_outlet(numbers("clocks"), there);
  const auto inlet = inlet_of(*outlet, here);
  std::vector<ClockOffset> offsets;
  ASSERT_TRUE(comes_about([&] {
    for (const ClockOffset& one : inlet->take_offsets()) offsets.push_back(one);
    return !offsets.empty();
  }));
  // Whatever the machine does in the meantime, half of the round trip bounds the error.
  EXPECT_NEAR(offsets[0].offset_s, kBehind_s, 0.5 * offsets[0].round_trip_s + 1e-9);
  EXPECT_LT(offsets[0].time_s, stream_clock_s() - kBehind_s);
}

}  // namespace own_stream_test
}  // namespace jnd::core
