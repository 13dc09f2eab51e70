#include "core/storage/sample_codec.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/error.h"
#include "core/random_stream.h"

namespace jnd::core {
namespace sample_codec_test {

/// Returns the samples of a hand that sweeps back and forth in a viscous fluid.
std::vector<Sample> sweep(int num_samples, std::int64_t first_tick) {
  std::vector<Sample> samples;
  for (int i = 0; i < num_samples; ++i) {
    const double t = 0.001 * i;
    Sample sample;
    sample.tick = first_tick + i;
    sample.command_sequence = 7;
    sample.attached_bits = 0b11111;
    sample.immersed_bits = 0b11011;
    for (int point = 0; point < kNumContactPoints; ++point) {
      sample.tip_position_m[point] = {0.13 * std::sin(3.4 * t) + 0.0123 * point, 0.01 * t,
                                      -0.4 + 0.02 * std::cos(3.4 * t)};
      sample.tip_velocity_m_per_s[point] = {0.442 * std::cos(3.4 * t), 0.01,
                                            -0.068 * std::sin(3.4 * t)};
      sample.tip_force_n[point] = {-3.3 * kAreaShareRatio[point] * std::cos(3.4 * t), -0.001,
                                   0.2 * std::sin(3.4 * t)};
    }
    sample.end_effector_position_m = {0.13 * std::sin(3.4 * t), 0.01 * t - 0.1, -0.3};
    samples.push_back(sample);
  }
  return samples;
}

void expect_near(const Sample& found, const Sample& expected) {
  ASSERT_EQ(found.tick, expected.tick);
  EXPECT_EQ(found.command_sequence, expected.command_sequence);
  EXPECT_EQ(found.attached_bits, expected.attached_bits);
  EXPECT_EQ(found.immersed_bits, expected.immersed_bits);
  for (int point = 0; point < kNumContactPoints; ++point) {
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(found.tip_position_m[point][axis], expected.tip_position_m[point][axis],
                  0.501 * kPositionUnitM);
      EXPECT_NEAR(found.tip_velocity_m_per_s[point][axis],
                  expected.tip_velocity_m_per_s[point][axis], 0.501 * kVelocityUnitMPerS);
      EXPECT_NEAR(found.tip_force_n[point][axis], expected.tip_force_n[point][axis],
                  0.501 * kForceUnitN);
    }
  }
}

/// Returns the same hand on a device with joints.
std::vector<Sample> sweep_with_joints(int num_samples) {
  std::vector<Sample> samples = sweep(num_samples, 0);
  for (Sample& sample : samples) {
    const double t = 0.001 * static_cast<double>(sample.tick);
    for (int joint = 0; joint < kNumJoints; ++joint) {
      sample.joint_position_rad[joint] =
          static_cast<float>(0.3 * joint - 2.0 + 0.2 * std::sin(3.4 * t));
      sample.joint_torque_n_m[joint] = static_cast<float>(0.5 * std::cos(3.4 * t + joint));
    }
  }
  return samples;
}

TEST(SampleCodec, BringsJointsBackWhereThereAreAny) {
  for (const int length : {1, 2, 3, 1000}) {
    const std::vector<Sample> samples = sweep_with_joints(length);
    const std::vector<Sample> found =
        decode_samples(encode_samples(samples), 0, length, "test");
    ASSERT_EQ(found.size(), samples.size());
    for (std::size_t i = 0; i < samples.size(); ++i) {
      expect_near(found[i], samples[i]);
      for (int joint = 0; joint < kNumJoints; ++joint) {
        EXPECT_NEAR(found[i].joint_position_rad[joint], samples[i].joint_position_rad[joint],
                    0.8 * kJointPositionUnitRad);
        EXPECT_NEAR(found[i].joint_torque_n_m[joint], samples[i].joint_torque_n_m[joint],
                    0.501 * kJointTorqueUnitNM);
      }
    }
  }
}

TEST(SampleCodec, JointsThatAreNoNumbersComeBackAsNaN) {
  std::vector<Sample> samples = sweep(3, 0);
  samples[1].joint_torque_n_m[21] = std::numeric_limits<float>::quiet_NaN();
  const std::vector<Sample> found = decode_samples(encode_samples(samples), 0, 3, "test");
  EXPECT_TRUE(std::isnan(found[1].joint_torque_n_m[21]));
  EXPECT_EQ(found[2].joint_torque_n_m[21], 0.0F);
}

TEST(SampleCodec, BringsEveryValueBackToHalfAUnit) {
  for (const int length : {1, 2, 3, 1000}) {
    const std::vector<Sample> samples = sweep(length, 500);
    const std::vector<Sample> found =
        decode_samples(encode_samples(samples), 500, length, "test");
    ASSERT_EQ(found.size(), samples.size());
    for (std::size_t i = 0; i < samples.size(); ++i) expect_near(found[i], samples[i]);
  }
}

TEST(SampleCodec, NeedsAtMostFifteenBytesForASampleOfASmoothSweep) {
  const std::vector<Sample> samples = sweep(4096, 0);
  EXPECT_LE(static_cast<double>(encode_samples(samples).size()) / 4096.0, 15.0);
}

TEST(SampleCodec, KeepsWhatIsNotANumberAndClampsWhatIsTooLarge) {
  std::vector<Sample> samples = sweep(5, 0);
  samples[2].tip_force_n[1][0] = std::numeric_limits<double>::quiet_NaN();
  samples[3].tip_force_n[1][0] = std::numeric_limits<double>::infinity();
  samples[3].tip_position_m[0][2] = -1e12;
  const std::vector<Sample> found = decode_samples(encode_samples(samples), 0, 5, "test");
  EXPECT_TRUE(std::isnan(found[2].tip_force_n[1][0]));
  EXPECT_DOUBLE_EQ(found[3].tip_force_n[1][0], 2147483.647);
  EXPECT_DOUBLE_EQ(found[3].tip_position_m[0][2], -214.7483647);
  expect_near(found[4], samples[4]);
}

TEST(SampleCodec, RefusesDamagedBytesInsteadOfInventingSamples) {
  const std::string bytes = encode_samples(sweep(100, 0));
  EXPECT_THROW((void)decode_samples(bytes.substr(0, bytes.size() / 2), 0, 100, "test"), Error);
  EXPECT_THROW((void)decode_samples(bytes, 0, 99, "test"), Error);
  EXPECT_THROW((void)decode_samples("not zstd at all", 0, 100, "test"), Error);
  EXPECT_THROW((void)decode_samples("", 0, 100, "test"), Error);
  RandomStream stream(1, "damage");
  for (int attempt = 0; attempt < 200; ++attempt) {
    std::string damaged = bytes;
    damaged[stream.below(damaged.size())] ^= static_cast<char>(1 + stream.below(255));
    try {
      EXPECT_EQ(decode_samples(damaged, 0, 100, "test").size(), 100U);
    } catch (const Error& error) {
      EXPECT_EQ(std::string(error.what()),
                "test: expected a chunk of samples, found damaged bytes");
    }
  }
}

TEST(SampleCodec, RefusesNumbersOfADamagedRowInsteadOfAskingForAllMemory) {
  const std::string bytes = encode_samples(std::vector<Sample>(10));
  constexpr std::int64_t kLargest = std::numeric_limits<std::int64_t>::max();
  EXPECT_THROW((void)decode_samples(bytes, 0, kLargest, "test"), Error);
  EXPECT_THROW((void)decode_samples(bytes, 0, std::int64_t{1} << 40, "test"), Error);
  EXPECT_THROW((void)decode_samples(bytes, kLargest - 5, 10, "test"), Error);
}

/// Gives the samples the times of a real loop: each tick is late by some microseconds, and the
/// device's clock has its own origin.
std::vector<Sample> timed(std::vector<Sample> samples) {
  RandomStream random(3, "lateness", {});
  for (Sample& sample : samples) {
    const std::int64_t due_ns = 86'400'000'000'000 + 1'000'000 * sample.tick;
    sample.monotonic_ns = due_ns + std::llround(20'000.0 * random.uniform());
    sample.device_time_ns = -5'000'000'000 + 1'000'000 * sample.tick;
  }
  return samples;
}

TEST(SampleCodec, TimesComeBackToTheMicrosecond) {
  const std::vector<Sample> samples = timed(sweep(4096, 100));
  const std::vector<Sample> found = decode_samples(encode_samples(samples), 100, 4096, "chunk");
  ASSERT_EQ(found.size(), samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    expect_near(found[i], samples[i]);
    ASSERT_GE(samples[i].monotonic_ns - found[i].monotonic_ns, 0);
    ASSERT_LT(samples[i].monotonic_ns - found[i].monotonic_ns, 1000);
    ASSERT_EQ(found[i].device_time_ns, samples[i].device_time_ns);
  }
}

TEST(SampleCodec, TimesOfAnySizeComeBack) {
  std::vector<Sample> samples = sweep(4, 0);
  const std::int64_t far_ns = std::numeric_limits<std::int64_t>::max() / 1000 * 1000;
  const std::int64_t times_ns[] = {far_ns, -far_ns, 0, 7000};
  for (std::size_t i = 0; i < samples.size(); ++i) {
    samples[i].monotonic_ns = 1000 + static_cast<std::int64_t>(i);
    samples[i].device_time_ns = times_ns[i];
  }
  const std::vector<Sample> found = decode_samples(encode_samples(samples), 0, 4, "chunk");
  for (std::size_t i = 0; i < samples.size(); ++i) {
    EXPECT_EQ(found[i].device_time_ns, times_ns[i]);
  }
}

TEST(SampleCodec, TimesCostAtMostTwoBytesASample) {
  const std::vector<Sample> samples = sweep(4096, 0);
  const std::size_t without = encode_samples(samples).size();
  EXPECT_LE(encode_samples(timed(samples)).size(), without + 2 * samples.size());
}

TEST(SampleCodec, TimesThatAreDamagedAreRefused) {
  const std::vector<Sample> samples = sweep(64, 0);
  const std::size_t without = encode_samples(samples).size();
  const std::string bytes = encode_samples(timed(samples));
  ASSERT_GT(bytes.size(), without);
  for (std::size_t size = without + 1; size < bytes.size(); ++size) {
    EXPECT_THROW((void)decode_samples(bytes.substr(0, size), 0, 64, "chunk"), Error) << size;
  }
  EXPECT_EQ(decode_samples(bytes.substr(0, without), 0, 64, "chunk")[5].monotonic_ns, 0);
}

/// Returns the same hand on a device that measures more.
std::vector<Sample> sweep_with_channels(int num_samples, ChannelBits bits) {
  std::vector<Sample> samples = sweep(num_samples, 5);
  for (Sample& sample : samples) {
    const double t = 0.001 * static_cast<double>(sample.tick);
    DeviceChannels& channels = sample.channels;
    channels.bits = bits;
    if (channels.has(kMeasuredForce)) channels.force_n[4] = {1.5 * std::sin(t), -2.0, 0.25};
    if (channels.has(kOrientation)) {
      channels.orientation_wxyz = {std::cos(t), 0.0, 0.0, std::sin(t)};
    }
    if (channels.has(kTorque)) channels.torque_n_m = {0.01 * t, 0.0, -0.5};
    if (channels.has(kGripper)) channels.gripper_m = 0.02 + 1e-3 * t;
    if (channels.has(kButtons)) channels.buttons = 0x80000001U + static_cast<unsigned>(t);
  }
  return samples;
}

TEST(SampleCodec, KeepsWhateverElseADeviceMeasuresAndNothingMore) {
  for (int bits = 1; bits <= kAllChannels; ++bits) {
    const auto channels = static_cast<ChannelBits>(bits);
    const std::vector<Sample> samples = sweep_with_channels(300, channels);
    const std::vector<Sample> back = decode_samples(encode_samples(samples), 5, 300, "here");
    ASSERT_EQ(back.size(), samples.size());
    for (std::size_t i = 0; i < back.size(); ++i) {
      expect_near(back[i], samples[i]);
      const DeviceChannels& found = back[i].channels;
      const DeviceChannels& expected = samples[i].channels;
      ASSERT_EQ(found.bits, bits);
      EXPECT_EQ(found.buttons, expected.buttons);
      EXPECT_NEAR(found.gripper_m, expected.gripper_m, 0.501 * kPositionUnitM);
      for (std::size_t part = 0; part < 4; ++part) {
        EXPECT_NEAR(found.orientation_wxyz[part], expected.orientation_wxyz[part],
                    0.501 * kOrientationUnit);
      }
      for (std::size_t axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(found.force_n[4][axis], expected.force_n[4][axis], 0.501 * kForceUnitN);
        EXPECT_NEAR(found.torque_n_m[axis], expected.torque_n_m[axis],
                    0.501 * kJointTorqueUnitNM);
      }
      EXPECT_EQ(back[i].monotonic_ns, 0) << "it was in simulated time";
    }
  }
}

TEST(DeviceChannels, AreSoundWhereTheDeviceTellsZerosOfWhatItHasNot) {
  DeviceChannels channels{.bits = kMeasuredForce | kButtons,
                          .orientation_wxyz = {0.0, 0.0, 0.0, 0.0}};
  EXPECT_TRUE(is_sound(channels)) << "it has no orientation";
  channels.bits |= kOrientation;
  EXPECT_FALSE(is_sound(channels)) << "none is an orientation of no length";
  channels.orientation_wxyz = {0.6, 0.0, 0.8, 0.0};
  EXPECT_TRUE(is_sound(channels));
  channels.force_n[4][2] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(is_sound(channels));
  channels.force_n[4][2] = 0.0;
  channels.bits = kMeasuredForce;
  channels.orientation_wxyz[1] = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(is_sound(channels)) << "no number, whatever it is of";
}

TEST(SampleCodec, AChannelThatNobodyKnowsIsDamage) {
  std::vector<Sample> samples = sweep_with_channels(10, kButtons);
  for (Sample& sample : samples) sample.channels.bits = 1 << 5;
  EXPECT_THROW((void)decode_samples(encode_samples(samples), 5, 10, "here"), Error);
  const std::string good = encode_samples(sweep_with_channels(10, kAllChannels));
  for (std::size_t cut = 0; cut < good.size(); ++cut) {
    // Without its last frames it is a chunk of a device without channels, or without times.
    try {
      const std::vector<Sample> back = decode_samples(good.substr(0, cut), 5, 10, "here");
      EXPECT_EQ(back.front().channels.bits, 0) << cut;
    } catch (const Error&) {
      continue;
    }
  }
}

}  // namespace sample_codec_test
}  // namespace jnd::core
