#include "device/network/datagram.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iterator>
#include <limits>
#include <string>

#include "core/random_stream.h"
#include "device/network/crc32.h"
#include "simulated_network.h"
#include "support/files.h"
#include "support/places.h"

namespace jnd::device {
namespace datagram_test {

using wire::Datagram;
using wire::Problem;

std::vector<Datagram> one_of_each_kind(std::uint64_t seed) {
  core::RandomStream random(seed, "datagrams");
  const wire::Header header{.stream_id = random.next_bits(),
                            .sequence = static_cast<std::uint32_t>(random.next_bits()),
                            .sent_ns = static_cast<std::int64_t>(random.next_bits()),
                            .echo_ns = static_cast<std::int64_t>(random.next_bits())};
  wire::Welcome welcome{.token = random.next_bits(),
                        .capabilities = {.share_ratio = core::area_shares(0b10101),
                                         .rate_hz = random.uniform(1.0, 5000.0),
                                         .max_force_per_point_n = random.uniform(0.1, 9.0),
                                         .max_total_force_n = random.uniform(0.1, 9.0),
                                         .max_stale_s = random.uniform(0.0, 0.1),
                                         .simulated = random.with_probability(0.5),
                                         .num_joints = 22,
                                         .moves_by_itself = random.with_probability(0.5),
                                         .max_slew_n_per_s = random.uniform(100.0, 900.0),
                                         .workspace = {1.0, 0.5, core::kInfinity},
                                         .channels = core::kAllChannels,
                                         .has_enable_switch = random.with_probability(0.5),
                                         .own_mass_kg = random.uniform(),
                                         .closed_loop_delay_s = random.uniform()}};
  std::copy_n("exoskeleton", 11, welcome.name.begin());
  std::copy_n("17b", 3, welcome.serial.begin());
  std::copy_n("2.1", 3, welcome.firmware.begin());
  welcome.challenge = random.next_bits();
  wire::State state;
  state.measured.device_time_ns = static_cast<std::int64_t>(random.next_bits());
  state.measured.enabled = random.with_probability(0.5);
  wire::Command command{.arm_number = static_cast<std::uint32_t>(random.next_bits()),
                        .answered_sequence = static_cast<std::uint32_t>(random.next_bits())};
  for (int point = 0; point < core::kNumContactPoints; ++point) {
    for (int axis = 0; axis < 3; ++axis) {
      state.measured.tip_position_m[point][axis] = random.normal();
      state.measured.tip_velocity_m_per_s[point][axis] = -1e-310 * random.uniform();
      state.measured.acted_n[point][axis] = random.normal();
      command.force_on_hand_n[point][axis] = random.normal();
    }
    state.measured.attached[point] = random.with_probability(0.5);
  }
  core::DeviceChannels& channels = state.measured.channels;
  for (core::PlainVector& force_n : channels.force_n) force_n.fill(random.normal());
  channels.orientation_wxyz = {random.normal(), 0.0, 0.5, random.normal()};
  channels.torque_n_m = {random.normal(), 1.0, -0.0};
  channels.gripper_m = random.normal();
  channels.buttons = 0x80000001;
  for (double& angle : state.measured.joint_position_rad) angle = random.normal();
  for (double& torque : state.measured.joint_torque_n_m) torque = 1e300 * random.normal();
  state.contact_sums = {.num_ticks = 7, .opposing_n = -0.0, .speed_m_per_s = random.uniform()};
  state.strokes_finished = 12;
  state.armed_number = static_cast<std::uint32_t>(random.next_bits());
  state.armed = random.with_probability(0.5);
  state.is_measured = random.with_probability(0.5);
  state.is_home = random.with_probability(0.5);
  state.fault = core::Fault::kWatchdog;
  state.level = LinkLevel::kGood;
  const wire::Order order{.number = 3,
                          .movement_number = 2,
                          .num_put_back = 1,
                          .stroke = true,
                          .plan = {.amplitude_m = random.uniform(0.1, 0.3), .num_strokes = 4},
                          .random = random};
  return {{header, wire::Hello{.token = random.next_bits(),
                               .only_asks = true,
                               .challenge = random.next_bits(),
                               .rate_hz = random.uniform(100.0, 9000.0)}},
          {header, welcome},
          {header, wire::Refusal{.token = 1, .reason = wire::RefusalReason::kOtherVersion}},
          {header, state},
          {header, command},
          {header, order},
          {header, wire::Halt{}},
          {header, wire::Goodbye{}}};
}

/// Returns the bytes with a correct checksum.
Bytes sealed(Bytes bytes) {
  const std::size_t end = bytes.size() - wire::kChecksumBytes;
  const std::uint32_t checksum = crc32(std::span(bytes).first(end));
  for (std::size_t i = 0; i < 4; ++i) {
    bytes[end + i] = static_cast<std::byte>(checksum >> (8 * i) & 0xff);
  }
  return bytes;
}

void put_double(Bytes& bytes, std::size_t at, double value) {
  std::memcpy(bytes.data() + at, &value, sizeof value);
}

double double_at(const Bytes& bytes, std::size_t at) {
  double value = 0.0;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

TEST(Crc32, IsTheOneOfTheStandard) {
  const std::string text = "123456789";
  EXPECT_EQ(crc32(std::as_bytes(std::span(text))), 0xcbf43926u);
}

TEST(Datagram, EveryKindComesBackBitByBit) {
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    for (const Datagram& datagram : one_of_each_kind(seed)) {
      const Bytes bytes = encoded(datagram);
      ASSERT_LE(bytes.size(), wire::kMaxBytes);
      Datagram back;
      ASSERT_EQ(wire::decode(bytes, back), Problem::kNone) << datagram.content.index();
      EXPECT_EQ(back.content.index(), datagram.content.index());
      EXPECT_EQ(back.header.sequence, datagram.header.sequence);
      EXPECT_EQ(encoded(back), bytes) << datagram.content.index();
    }
  }
}

TEST(Datagram, ARandomStreamGoesOnWhereItWas) {
  core::RandomStream random(5, "here");
  (void)random.next_bits();
  Datagram back;
  ASSERT_EQ(wire::decode(encoded({{}, wire::Order{.number = 1, .random = random}}), back),
            Problem::kNone);
  core::RandomStream there = std::get<wire::Order>(back.content).random;
  for (int i = 0; i < 10; ++i) EXPECT_EQ(there.next_bits(), random.next_bits());
}

TEST(Datagram, AStateLiesInItsBytesAsTheTableSays) {
  wire::State state;
  state.measured.device_time_ns = 0x0102030405060708;
  state.measured.tip_position_m[0].x() = 0.25;
  state.measured.tip_velocity_m_per_s[4].z() = -1.5;
  state.measured.end_effector_position_m.y() = 0.5;
  state.measured.joint_position_rad[0] = 1.0;
  state.measured.joint_torque_n_m[21] = 2.0;
  state.measured.attached = {true, false, true, false, false};
  state.contact_sums.speed_m_per_s = 3.0;
  state.armed = true;
  state.fault = core::Fault::kLinkLost;
  state.level = LinkLevel::kGood;
  state.measured.acted_n[0].x() = 4.0;
  state.measured.acted_n[4].z() = 5.0;
  state.measured.channels.force_n[4][2] = 6.0;
  state.measured.channels.orientation_wxyz = {0.5, 0.5, 0.5, -0.5};
  state.measured.channels.torque_n_m[2] = 7.0;
  state.measured.channels.gripper_m = 8.0;
  state.measured.channels.buttons = 0x0102;
  const Bytes bytes = encoded({{.stream_id = 0x1122, .sequence = 0x33445566}, state});
  ASSERT_EQ(bytes.size(), 1031u);
  EXPECT_EQ(std::string(reinterpret_cast<const char*>(bytes.data()), 4), "JDLK");
  EXPECT_EQ(bytes[4], std::byte{3});
  EXPECT_EQ(bytes[6], std::byte{4});
  EXPECT_EQ(bytes[8], std::byte{0x22});
  EXPECT_EQ(bytes[16], std::byte{0x66});
  EXPECT_EQ(bytes[20], std::byte{1031 & 0xff});
  EXPECT_EQ(bytes[21], std::byte{1031 >> 8});
  EXPECT_EQ(bytes[40], std::byte{8});
  EXPECT_EQ(double_at(bytes, 48), 0.25);
  EXPECT_EQ(double_at(bytes, 280), -1.5);
  EXPECT_EQ(double_at(bytes, 296), 0.5);
  EXPECT_EQ(double_at(bytes, 312), 1.0);
  EXPECT_EQ(double_at(bytes, 656), 2.0);
  EXPECT_EQ(double_at(bytes, 688), 3.0);
  EXPECT_EQ(bytes[712], std::byte{0b00101});
  EXPECT_EQ(bytes[713], std::byte{1});
  EXPECT_EQ(bytes[716], std::byte{12});
  EXPECT_EQ(double_at(bytes, 718), 4.0);
  EXPECT_EQ(double_at(bytes, 830), 5.0);
  EXPECT_EQ(bytes[838], std::byte{1}) << "the enabling switch is closed";
  EXPECT_EQ(double_at(bytes, 951), 6.0);
  EXPECT_EQ(double_at(bytes, 983), -0.5);
  EXPECT_EQ(double_at(bytes, 1007), 7.0);
  EXPECT_EQ(double_at(bytes, 1015), 8.0);
  EXPECT_EQ(bytes[1023], std::byte{2});
  EXPECT_EQ(bytes[1024], std::byte{1});
}

TEST(Datagram, AWelcomeLiesInItsBytesAsTheTableSays) {
  wire::Welcome welcome{.capabilities = {.share_ratio = {0.25, 0.0, 0.0, 0.75, 0.0},
                                         .max_slew_n_per_s = 900.0,
                                         .workspace = {1.0, 2.0, core::kInfinity},
                                         .channels = core::kMeasuredForce | core::kButtons,
                                         .has_enable_switch = true,
                                         .own_mass_kg = 3.0,
                                         .own_damping_n_s_per_m = 4.0,
                                         .closed_loop_delay_s = 5.0}};
  std::copy_n("s", 1, welcome.serial.begin());
  std::copy_n("f", 1, welcome.firmware.begin());
  const Bytes bytes = encoded({{}, welcome});
  ASSERT_EQ(bytes.size(), 304u);
  EXPECT_EQ(bytes[80], std::byte{0b01001});
  EXPECT_EQ(double_at(bytes, 130), 0.25);
  EXPECT_EQ(double_at(bytes, 154), 0.75);
  EXPECT_EQ(double_at(bytes, 170), 900.0);
  EXPECT_EQ(double_at(bytes, 178), 0.0) << "it does not say";
  EXPECT_EQ(double_at(bytes, 194), 2.0);
  EXPECT_EQ(double_at(bytes, 202), 0.0);
  EXPECT_EQ(double_at(bytes, 210), 3.0);
  EXPECT_EQ(double_at(bytes, 218), 4.0);
  EXPECT_EQ(double_at(bytes, 226), 5.0);
  EXPECT_EQ(bytes[234], std::byte{17});
  EXPECT_EQ(bytes[235], std::byte{1});
  EXPECT_EQ(bytes[236], std::byte{'s'});
  EXPECT_EQ(bytes[268], std::byte{'f'});
  EXPECT_EQ(double_at(encoded({{}, wire::Hello{.rate_hz = 4000.0}}), 57), 4000.0);
}

TEST(Datagram, WhatAnotherProgramWroteAfterTheTablesIsUnderstood) {
  const auto read = [](const std::string& name) {
    const std::string text = test_support::read_file(
        test_support::source_folder() / "tests/fuzz/corpus/datagram" / (name + ".bin"));
    const auto bytes = std::as_bytes(std::span(text));
    Datagram datagram;
    EXPECT_EQ(wire::decode(bytes, datagram), Problem::kNone) << name;
    return datagram;
  };
  const auto welcome = std::get<wire::Welcome>(read("welcome").content);
  EXPECT_EQ(welcome.capabilities.num_joints, 22);
  EXPECT_EQ(std::string(welcome.name.data()), "exoskeleton");
  EXPECT_EQ(welcome.challenge, 0x0102030405060708u);
  EXPECT_EQ(std::get<wire::Hello>(read("hello").content).challenge, 77u);
  EXPECT_FALSE(std::get<wire::State>(read("state_of_an_open_switch").content).measured.enabled);
  const auto state = std::get<wire::State>(read("state_of_a_moving_hand").content);
  EXPECT_EQ(state.measured.device_time_ns, 123456789);
  EXPECT_EQ(state.measured.joint_torque_n_m[21], 0.76);
  EXPECT_EQ(state.contact_sums.speed_m_per_s, 2.0);
  EXPECT_EQ(state.order_number, 2u);
  EXPECT_EQ(state.level, LinkLevel::kExcellent);
  const Datagram command = read("command");
  EXPECT_EQ(command.header.stream_id, 0x1234u);
  EXPECT_EQ(std::get<wire::Command>(command.content).answered_sequence, 41u);
  EXPECT_EQ(std::get<wire::Order>(read("order_to_stroke").content).plan.num_strokes, 3);
  EXPECT_EQ(std::get<wire::Refusal>(read("refusal_busy").content).reason,
            wire::RefusalReason::kBusy);
}

TEST(Datagram, EveryCutIsRefused) {
  for (const Datagram& datagram : one_of_each_kind(7)) {
    Bytes bytes = encoded(datagram);
    for (std::size_t size = 0; size < bytes.size(); ++size) {
      Datagram back;
      EXPECT_NE(wire::decode(std::span(bytes).first(size), back), Problem::kNone) << size;
    }
    bytes.push_back(std::byte{0});
    Datagram back;
    EXPECT_EQ(wire::decode(bytes, back), Problem::kWrongSize);
  }
}

TEST(Datagram, EveryBitThatFlipsIsRefused) {
  for (const Datagram& datagram : one_of_each_kind(8)) {
    Bytes bytes = encoded(datagram);
    for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
      bytes[bit / 8] ^= static_cast<std::byte>(1 << bit % 8);
      Datagram back;
      EXPECT_NE(wire::decode(bytes, back), Problem::kNone) << bit;
      bytes[bit / 8] ^= static_cast<std::byte>(1 << bit % 8);
    }
  }
}

TEST(Datagram, WhatIsNoNumberIsRefusedWhereverItStands) {
  int num_refused = 0;
  for (const double poison : {std::nan(""), std::numeric_limits<double>::infinity(),
                              -std::numeric_limits<double>::infinity()}) {
    wire::State state;
    for (int i = 0; i < 77; ++i) {
      Bytes bytes = encoded({{}, state});
      put_double(bytes, static_cast<std::size_t>(48 + 8 * i), poison);
      Datagram back;
      EXPECT_EQ(wire::decode(sealed(bytes), back), Problem::kNotFinite) << i;
      ++num_refused;
    }
    for (int i = 0; i < 15; ++i) {
      Bytes bytes = encoded({{}, state});
      put_double(bytes, static_cast<std::size_t>(718 + 8 * i), poison);
      Datagram back;
      EXPECT_EQ(wire::decode(sealed(bytes), back), Problem::kNotFinite) << i;
      ++num_refused;
    }
    for (int i = 0; i < 23; ++i) {
      Bytes bytes = encoded({{}, state});
      put_double(bytes, static_cast<std::size_t>(839 + 8 * i), poison);
      Datagram back;
      EXPECT_EQ(wire::decode(sealed(bytes), back), Problem::kNotFinite) << i;
      ++num_refused;
    }
    for (int i = 0; i < 15; ++i) {
      Bytes bytes = encoded({{}, wire::Command{}});
      put_double(bytes, static_cast<std::size_t>(48 + 8 * i), poison);
      Datagram back;
      EXPECT_EQ(wire::decode(sealed(bytes), back), Problem::kNotFinite) << i;
      ++num_refused;
    }
  }
  EXPECT_EQ(num_refused, 3 * 130);
}

TEST(Datagram, EachProblemHasItsOwnName) {
  const Bytes good = encoded({{}, wire::Halt{}});
  Datagram back;
  const auto changed = [&good](std::size_t at, int value) {
    Bytes bytes = good;
    bytes[at] = static_cast<std::byte>(value);
    return sealed(bytes);
  };
  EXPECT_EQ(wire::decode({}, back), Problem::kTooShort);
  EXPECT_EQ(wire::decode(changed(0, 'X'), back), Problem::kWrongMagic);
  EXPECT_EQ(wire::decode(changed(4, 2), back), Problem::kWrongVersion);
  EXPECT_EQ(wire::version_of(changed(4, 2)), 2);
  EXPECT_EQ(wire::version_of(changed(0, 'X')), 0);
  EXPECT_EQ(wire::decode(changed(20, 45), back), Problem::kWrongSize);
  EXPECT_EQ(wire::decode(changed(6, 0), back), Problem::kUnknownKind);
  EXPECT_EQ(wire::decode(changed(6, 9), back), Problem::kUnknownKind);
  EXPECT_EQ(wire::decode(changed(6, 5), back), Problem::kWrongSize);
  EXPECT_EQ(wire::name(Problem::kWrongChecksum), "wrong_checksum");
}

TEST(Datagram, ValuesOutOfRangeAreRefused) {
  const auto refused = [](const wire::Content& content, std::size_t at, int value) {
    Bytes bytes = encoded({{}, content});
    bytes[at] = static_cast<std::byte>(value);
    Datagram back;
    return wire::decode(sealed(bytes), back) == Problem::kOutOfRange;
  };
  EXPECT_TRUE(refused(wire::State{}, 712, 0x20)) << "a sixth point";
  EXPECT_TRUE(refused(wire::State{}, 713, 2)) << "armed twice";
  const int unknown_fault = static_cast<int>(core::kLastFault) + 1;
  EXPECT_EQ(core::name(static_cast<core::Fault>(unknown_fault)), "unknown");
  EXPECT_NE(core::name(core::kLastFault), "unknown");
  EXPECT_TRUE(refused(wire::State{}, 716, unknown_fault));
  EXPECT_TRUE(refused(wire::State{}, 717, 4)) << "an unknown level";
  EXPECT_TRUE(refused(wire::Hello{}, 48, 2)) << "a flag of two";
  EXPECT_TRUE(refused(wire::Refusal{}, 48, 0)) << "a refusal for no reason";
  EXPECT_TRUE(refused(wire::Welcome{}, 80, 0x3f)) << "six contact points";
  EXPECT_TRUE(refused(wire::Welcome{}, 80, 0x0f)) << "a share without a point";
  EXPECT_TRUE(refused(wire::Welcome{}, 130 + 7, 0xbf)) << "a share below zero";
  EXPECT_TRUE(refused(wire::Welcome{}, 130 + 6, 0xe0)) << "shares of more than all";
  EXPECT_TRUE(refused(wire::Welcome{}, 234, 32)) << "a channel that nobody knows";
  EXPECT_TRUE(refused(wire::Welcome{}, 236, 7)) << "a serial that rings a bell";
  EXPECT_TRUE(refused(wire::Welcome{}, 80, 0)) << "none at all";
  EXPECT_TRUE(refused(wire::Welcome{}, 90, 7)) << "a name that rings a bell";
  EXPECT_TRUE(refused(wire::Welcome{}, 91, 'x')) << "a letter behind the end of the name";
  EXPECT_TRUE(refused(wire::Order{}, 53 + 7, 0x80)) << "a negative width";
}

TEST(Datagram, MeasurementsThatWouldStandInForTooLongAreRefused) {
  const auto problem_at = [](double max_stale_s) {
    Datagram back;
    return wire::decode(
        encoded({{}, wire::Welcome{.capabilities = {.max_stale_s = max_stale_s}}}), back);
  };
  EXPECT_EQ(problem_at(0.0), Problem::kNone);
  EXPECT_EQ(problem_at(0.1), Problem::kNone);
  EXPECT_EQ(problem_at(std::nextafter(0.1, 1.0)), Problem::kOutOfRange);
  EXPECT_EQ(problem_at(1e300), Problem::kOutOfRange);
}

TEST(Datagram, APlanThatNoArmCouldFollowIsRefused) {
  const auto problem_of = [](const StrokePlan& plan) {
    Datagram back;
    return wire::decode(encoded({{}, wire::Order{.number = 1, .stroke = true, .plan = plan}}),
                        back);
  };
  EXPECT_EQ(problem_of({}), Problem::kNone);
  EXPECT_EQ(problem_of({.amplitude_m = 1e308}), Problem::kOutOfRange);
  EXPECT_EQ(problem_of({.max_speed_m_per_s = 1e-300}), Problem::kOutOfRange);
  EXPECT_EQ(problem_of({.height_m = 1e300}), Problem::kOutOfRange);
  EXPECT_EQ(problem_of({.sideways_sd_m = 1e300}), Problem::kOutOfRange);
}

TEST(Datagram, APlanThatComesThroughIsValid) {
  core::RandomStream random(3, "plans");
  int num_passed = 0;
  for (int i = 0; i < 2000; ++i) {
    wire::Order order{.number = 1, .stroke = true};
    order.plan.amplitude_sd_ratio = random.uniform(-0.1, 0.4);
    order.plan.speed_sd_ratio = random.uniform(-0.1, 0.4);
    order.plan.amplitude_m = random.uniform(-0.1, 0.4);
    order.plan.max_speed_m_per_s = random.uniform(-0.1, 0.4);
    order.plan.height_sd_m = random.uniform(-0.1, 0.4);
    order.plan.sideways_sd_m = random.uniform(-0.1, 0.4);
    Datagram back;
    if (wire::decode(encoded({{}, order}), back) != Problem::kNone) continue;
    ++num_passed;
    EXPECT_NO_THROW(require_valid(std::get<wire::Order>(back.content).plan));
  }
  EXPECT_GT(num_passed, 100);
}

/// Whoever writes a device reads kind, field and offset of the page of datagrams.
TEST(Datagram, WhatIsWrongWithOneIsSaidInWords) {
  const std::vector<Datagram> all = one_of_each_kind(5);
  const Bytes welcome = encoded(all[1]), state = encoded(all[3]);
  EXPECT_EQ(wire::problem_words(welcome), "");
  Bytes wrong = welcome;
  put_double(wrong, 56, std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(wire::problem_words(sealed(wrong)),
            "a datagram `welcome` of 304 bytes whose most force at a point (offset 56) is not "
            "finite");
  wrong = welcome;
  put_double(wrong, 146, 0.7);
  EXPECT_EQ(
      wire::problem_words(sealed(wrong)),
      "a datagram `welcome` of 304 bytes whose share of the force at a point (together 1) "
      "(offset 162) is out of its range");
  wrong = welcome;
  wrong[80] = std::byte{0};
  EXPECT_NE(wire::problem_words(sealed(wrong)).find("set of contact points (offset 80)"),
            std::string::npos);
  wrong = state;
  put_double(wrong, 168 + 8 * 4, std::numeric_limits<double>::infinity());
  EXPECT_EQ(wire::problem_words(sealed(wrong)),
            "a datagram `state` of 1031 bytes whose velocity of a point (offset 200) is not "
            "finite");
  wrong = state;
  wrong[716] = std::byte{255};
  EXPECT_NE(wire::problem_words(sealed(wrong)).find("number of a fault (offset 716)"),
            std::string::npos);
  EXPECT_NE(wire::problem_words(wrong).find("whose last four bytes are not its CRC-32"),
            std::string::npos);
  wrong = welcome;
  wrong.resize(200);
  EXPECT_EQ(wire::problem_words(wrong),
            "a datagram `welcome` of 200 bytes whose header says 304");
  wrong = welcome;
  wrong[0] = std::byte{'X'};
  EXPECT_NE(wire::problem_words(wrong).find("the letters JDLK"), std::string::npos);
  EXPECT_NE(wire::problem_words(std::span(welcome).first(9)).find("9 bytes"),
            std::string::npos);
}

}  // namespace datagram_test
}  // namespace jnd::device
