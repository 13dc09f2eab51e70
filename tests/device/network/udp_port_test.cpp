#include "device/network/udp_port.h"

#include <gtest/gtest.h>

#include <memory>
#include <span>
#include <string>

#include "core/error.h"

namespace jnd::device {
namespace udp_port_test {

TEST(Endpoint, HostAndPortAreToldApart) {
  EXPECT_EQ(endpoint_of("127.0.0.1:4700").host, "127.0.0.1");
  EXPECT_EQ(endpoint_of("127.0.0.1:4700").port, 4700);
  EXPECT_EQ(endpoint_of("robot:1").host, "robot");
  EXPECT_EQ(endpoint_of("[::1]:65535").host, "::1");
}

TEST(Endpoint, WhatIsNoneIsToldHowOneLooks) {
  for (const char* text : {"", "robot", ":4700", "robot:", "robot:0", "robot:65536",
                           "robot:47x", "robot:-1", "::1:4700", "[::1:4700", "a]:1"}) {
    try {
      (void)endpoint_of(text);
      ADD_FAILURE() << text;
    } catch (const core::Error& error) {
      EXPECT_NE(std::string(error.what()).find("127.0.0.1:4700"), std::string::npos) << text;
    }
  }
}

TEST(Address, SaysWhatItIs) {
  EXPECT_EQ(text_of(resolved({"127.0.0.1", 4700})), "127.0.0.1:4700");
  EXPECT_EQ(text_of(resolved({"::1", 4700})), "[::1]:4700");
  EXPECT_FALSE(resolved({"127.0.0.1", 1}) == resolved({"127.0.0.1", 2}));
}

/// The loopback of one machine delivers at once and in order.
TEST(UdpPort, CarriesDatagramsBothWays) {
  const Address any = resolved({"127.0.0.1", 0});
  UdpPort near(any), far(any);
  EXPECT_FALSE(near.local() == far.local());
  std::array<std::byte, 16> bytes;
  Address from;
  EXPECT_EQ(far.receive(bytes, from), 0u);
  EXPECT_TRUE(near.send({}, far.local())) << "an empty one";
  const std::array<std::byte, 3> sent = {std::byte{1}, std::byte{2}, std::byte{3}};
  EXPECT_TRUE(near.send(sent, far.local()));
  ASSERT_EQ(far.receive(bytes, from), 3u);
  EXPECT_EQ(bytes[2], std::byte{3});
  EXPECT_EQ(from, near.local());
  EXPECT_TRUE(far.send(sent, from));
  EXPECT_EQ(near.receive(bytes, from), 3u);
  EXPECT_EQ(from, far.local());
}

TEST(Address, OfSeveralAnIPv4OneIsTaken) {
  EXPECT_EQ(text_of(resolved({"localhost", 4700})), "127.0.0.1:4700");
}

TEST(UdpPort, AConnectedOneHearsNobodyElse) {
  const Address any = resolved({"127.0.0.1", 0});
  UdpPort server(any), stranger(any);
  const std::unique_ptr<UdpPort> program = UdpPort::connected_to(server.local());
  const std::array<std::byte, 2> sent = {std::byte{1}, std::byte{2}};
  EXPECT_TRUE(program->send(sent, server.local()));
  std::array<std::byte, 16> bytes;
  Address from;
  ASSERT_EQ(server.receive(bytes, from), 2u);
  EXPECT_EQ(from, program->local());
  EXPECT_TRUE(stranger.send(sent, from));
  EXPECT_EQ(program->receive(bytes, from), 0u);
  EXPECT_TRUE(server.send(std::span(sent).first(1), program->local()));
  EXPECT_EQ(program->receive(bytes, from), 1u);
  EXPECT_EQ(from, server.local());
}

TEST(UdpPort, NobodyAtTheOtherEndHidesNoDatagram) {
  const Address any = resolved({"127.0.0.1", 0});
  auto server = std::make_unique<UdpPort>(any);
  const Address place = server->local();
  const std::unique_ptr<UdpPort> program = UdpPort::connected_to(place);
  const std::array<std::byte, 2> sent = {std::byte{1}, std::byte{2}};
  server.reset();
  std::array<std::byte, 16> bytes;
  Address from;
  for (int i = 0; i < 5; ++i) {
    EXPECT_TRUE(program->send(sent, place));
    EXPECT_TRUE(program->send(sent, place)) << "the refusal of the one before is not its own";
    EXPECT_EQ(program->receive(bytes, from), 0u);
  }
  server = std::make_unique<UdpPort>(place);
  EXPECT_TRUE(program->send(sent, place));
  EXPECT_EQ(server->receive(bytes, from), 2u);
  EXPECT_TRUE(server->send(sent, from));
  EXPECT_EQ(program->receive(bytes, from), 2u);
}

TEST(UdpPort, APlaceThatIsTakenIsNamed) {
  const UdpPort first(resolved({"127.0.0.1", 0}));
  try {
    const UdpPort second(first.local());
    FAIL();
  } catch (const core::Error& error) {
    EXPECT_NE(std::string(error.what()).find(text_of(first.local())), std::string::npos);
  }
}

}  // namespace udp_port_test
}  // namespace jnd::device
