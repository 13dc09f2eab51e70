#include "core/storage/sample_codec.h"

#include <zstd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>

#include "core/error.h"
#include "core/sample_table.h"

namespace jnd::core {
namespace {

constexpr int kVectorsPerPoint = 3;  // Position, velocity, force.
constexpr int kVectorChannels = kNumContactPoints * kVectorsPerPoint * 3;
constexpr int kEndEffector = kVectorChannels;
constexpr int kFlags = kEndEffector + 3;  // Command, attached, immersed, limited, fault.
constexpr int kNumChannels = kFlags + 5;
constexpr int kNumJointChannels = 2 * kNumJoints;  // Position, torque.
constexpr int kNumTimeChannels = 2;                // Monotonic time, device's time.
// The largest number of channels: force at each point, orientation, torque, gripper, buttons.
constexpr int kMostChannels = 3 * kNumContactPoints + 4 + 3 + 1 + 1;
constexpr std::int64_t kNsPerUs = 1000;

// Arithmetic is modulo 2^32, so differences wrap and come back exactly.
using Word = std::uint32_t;
using Row = std::array<Word, kNumChannels>;
using JointRow = std::array<Word, kNumJointChannels>;

// Times are stored modulo 2^64, in microseconds.
using LongWord = std::uint64_t;
using TimeRow = std::array<LongWord, kNumTimeChannels>;

constexpr Word kNotANumber = 0x80000000U;

Word fixed_point(double value, double units) noexcept {
  const double scaled = value * units;
  if (!(std::abs(scaled) < 2147483647.0)) {
    if (std::isnan(scaled)) return kNotANumber;
    return scaled > 0 ? 0x7fffffffU : static_cast<Word>(-0x7fffffff);
  }
  // Adding 1.5 * 2^52 rounds to the nearest integer in the low bits. This is several times
  // faster than a call of lrint.
  const double shifted = scaled + 6755399441055744.0;
  std::uint64_t bits = 0;
  std::memcpy(&bits, &shifted, sizeof bits);
  return static_cast<Word>(bits);
}

double number(Word word, double unit) noexcept {
  if (word == kNotANumber) return std::numeric_limits<double>::quiet_NaN();
  return static_cast<double>(static_cast<std::int32_t>(word)) * unit;
}

Row row_of(const Sample& sample) noexcept {
  Row row;
  int channel = 0;
  for (int point = 0; point < kNumContactPoints; ++point) {
    for (int axis = 0; axis < 3; ++axis) {
      const Word position = fixed_point(sample.tip_position_m[point][axis], 1e7);
      const Word velocity = fixed_point(sample.tip_velocity_m_per_s[point][axis], 1e4);
      // Relative to the first tip, the other tips of a rigid hand do not change at all.
      row[channel] = point == 0 ? position : position - row[axis];
      row[channel + 3] = point == 0 ? velocity : velocity - row[axis + 3];
      row[channel + 6] = fixed_point(sample.tip_force_n[point][axis], 1e3);
      ++channel;
    }
    channel += 6;
  }
  for (int axis = 0; axis < 3; ++axis) {
    row[kEndEffector + axis] =
        fixed_point(sample.end_effector_position_m[axis], 1e7) - row[axis];
  }
  row[kFlags] = sample.command_sequence;
  row[kFlags + 1] = sample.attached_bits;
  row[kFlags + 2] = sample.immersed_bits;
  row[kFlags + 3] = sample.limited;
  row[kFlags + 4] = sample.fault;
  return row;
}

Sample sample_of(const Row& row, std::int64_t tick) noexcept {
  Sample sample;
  sample.tick = tick;
  int channel = 0;
  for (int point = 0; point < kNumContactPoints; ++point) {
    for (int axis = 0; axis < 3; ++axis) {
      const Word base_position = point == 0 ? 0 : row[axis];
      const Word base_velocity = point == 0 ? 0 : row[axis + 3];
      sample.tip_position_m[point][axis] = number(row[channel] + base_position, kPositionUnitM);
      sample.tip_velocity_m_per_s[point][axis] =
          number(row[channel + 3] + base_velocity, kVelocityUnitMPerS);
      sample.tip_force_n[point][axis] = number(row[channel + 6], kForceUnitN);
      ++channel;
    }
    channel += 6;
  }
  for (int axis = 0; axis < 3; ++axis) {
    sample.end_effector_position_m[axis] =
        number(row[kEndEffector + axis] + row[axis], kPositionUnitM);
  }
  sample.command_sequence = row[kFlags];
  sample.attached_bits = static_cast<std::uint8_t>(row[kFlags + 1]);
  sample.immersed_bits = static_cast<std::uint8_t>(row[kFlags + 2]);
  sample.limited = static_cast<std::uint8_t>(row[kFlags + 3]);
  sample.fault = static_cast<std::uint8_t>(row[kFlags + 4]);
  return sample;
}

JointRow joint_row_of(const Sample& sample) noexcept {
  JointRow row;
  for (int joint = 0; joint < kNumJoints; ++joint) {
    row[joint] = fixed_point(sample.joint_position_rad[joint], 1e6);
    row[kNumJoints + joint] = fixed_point(sample.joint_torque_n_m[joint], 1e4);
  }
  return row;
}

void take_joints(const JointRow& row, Sample& sample) noexcept {
  for (int joint = 0; joint < kNumJoints; ++joint) {
    sample.joint_position_rad[joint] =
        static_cast<float>(number(row[joint], kJointPositionUnitRad));
    sample.joint_torque_n_m[joint] =
        static_cast<float>(number(row[kNumJoints + joint], kJointTorqueUnitNM));
  }
}

/// Rounds down, also before the clock's zero.
LongWord microseconds(std::int64_t time_ns) noexcept {
  const std::int64_t below = time_ns % kNsPerUs < 0 ? 1 : 0;
  return static_cast<LongWord>(time_ns / kNsPerUs - below);
}

std::int64_t nanoseconds(LongWord time_us) noexcept {
  return static_cast<std::int64_t>(time_us * LongWord{kNsPerUs});
}

TimeRow time_row_of(const Sample& sample) noexcept {
  return {microseconds(sample.monotonic_ns), microseconds(sample.device_time_ns)};
}

/// Calls `visit(value, units)` for each number of the channels in `bits`, in their order.
template <typename Channels, typename Visit>
void for_each_channel(ChannelBits bits, Channels& channels, const Visit& visit) {
  const auto all = [&visit](auto& numbers, double units) {
    for (auto& number : numbers) visit(number, units);
  };
  if ((bits & kMeasuredForce) != 0) {
    for (auto& force_n : channels.force_n) all(force_n, 1e3);
  }
  if ((bits & kOrientation) != 0) all(channels.orientation_wxyz, 1e6);
  if ((bits & kTorque) != 0) all(channels.torque_n_m, 1e4);
  if ((bits & kGripper) != 0) visit(channels.gripper_m, 1e7);
}

/// Returns the words of a sample. The buttons' bits are taken as they are.
std::vector<Word> channel_row_of(ChannelBits bits, const DeviceChannels& channels) {
  std::vector<Word> row;
  row.reserve(kMostChannels);
  for_each_channel(bits, channels, [&row](double value, double units) {
    row.push_back(fixed_point(value, units));
  });
  if ((bits & kButtons) != 0) row.push_back(channels.buttons);
  return row;
}

void take_channels(ChannelBits bits, const std::vector<Word>& row, DeviceChannels& channels) {
  channels.bits = bits;
  std::size_t place = 0;
  for_each_channel(bits, channels, [&](double& value, double units) {
    value = number(row[place++], 1.0 / units);
  });
  if ((bits & kButtons) != 0) channels.buttons = row[place];
}

template <typename SomeWord>
constexpr int kBitsOf = 8 * static_cast<int>(sizeof(SomeWord));

/// Maps small magnitudes of either sign to small numbers.
template <typename SomeWord>
SomeWord zigzag(SomeWord difference) noexcept {
  return (difference << 1) ^ (SomeWord{0} - (difference >> (kBitsOf<SomeWord> - 1)));
}
template <typename SomeWord>
SomeWord unzigzag(SomeWord coded) noexcept {
  return (coded >> 1) ^ (SomeWord{0} - (coded & SomeWord{1}));
}

template <typename SomeWord>
void put_word(std::string& bytes, SomeWord word) {
  for (std::size_t byte = 0; byte < sizeof word; ++byte) {
    bytes += static_cast<char>((word >> (8 * byte)) & 0xffU);
  }
}

/// Writes each channel as its first two values, the width of its differences in bytes, and
/// their byte planes, the lowest byte first.
template <typename SomeRow>
void put_planes(const std::vector<SomeRow>& rows, std::string& bytes) {
  using SomeWord = typename SomeRow::value_type;
  std::vector<SomeWord> coded(rows.size());
  for (std::size_t channel = 0; channel < rows[0].size(); ++channel) {
    put_word(bytes, rows[0][channel]);
    put_word(bytes, rows.size() > 1 ? rows[1][channel] : SomeWord{0});
    SomeWord used_bits = 0;
    for (std::size_t i = 2; i < rows.size(); ++i) {
      coded[i] = zigzag(rows[i][channel] - 2 * rows[i - 1][channel] + rows[i - 2][channel]);
      used_bits |= coded[i];
    }
    int width = 0;
    while (width < static_cast<int>(sizeof(SomeWord)) && (used_bits >> (8 * width)) != 0) {
      ++width;
    }
    bytes += static_cast<char>(width);
    for (int byte = 0; byte < width; ++byte) {
      for (std::size_t i = 2; i < rows.size(); ++i) {
        bytes += static_cast<char>((coded[i] >> (8 * byte)) & 0xffU);
      }
    }
  }
}

/// Reads what `put_planes` wrote. It checks every length, because the bytes may be damaged.
class PlaneReader {
 public:
  PlaneReader(std::string_view bytes, const std::string& place)
      : bytes_(bytes), place_(place) {}

  std::string_view take(std::size_t num_bytes) {
    if (num_bytes > bytes_.size()) fail();
    const std::string_view taken = bytes_.substr(0, num_bytes);
    bytes_.remove_prefix(num_bytes);
    return taken;
  }
  template <typename SomeWord>
  SomeWord word() {
    const std::string_view bytes = take(sizeof(SomeWord));
    SomeWord value = 0;
    for (std::size_t byte = 0; byte < sizeof(SomeWord); ++byte) {
      value |= static_cast<SomeWord>(static_cast<unsigned char>(bytes[byte])) << (8 * byte);
    }
    return value;
  }
  int width(std::size_t widest) {
    const int value = static_cast<unsigned char>(take(1)[0]);
    if (value > static_cast<int>(widest)) fail();
    return value;
  }
  [[nodiscard]] bool is_at_end() const noexcept { return bytes_.empty(); }
  void finish() const {
    if (!is_at_end()) fail();
  }
  [[noreturn]] void fail() const {
    throw Error(place_ + ": expected a chunk of samples, found damaged bytes");
  }

 private:
  std::string_view bytes_;
  const std::string& place_;
};

/// The words of all samples, channel after channel. Decoding runs along a channel, which is
/// much faster if its words are adjacent.
template <typename SomeRow>
class Columns {
 public:
  /// `like` is a row with the right number of channels.
  Columns(PlaneReader& reader, std::size_t count, SomeRow like = SomeRow())
      : count_(count), like_(std::move(like)), words_(like_.size() * count) {
    for (std::size_t channel = 0; channel < like_.size(); ++channel) {
      take(reader, &words_[channel * count]);
    }
  }

  [[nodiscard]] SomeRow row(std::size_t sample) const {
    SomeRow row = like_;
    for (std::size_t channel = 0; channel < row.size(); ++channel) {
      row[channel] = words_[channel * count_ + sample];
    }
    return row;
  }

 private:
  using SomeWord = typename SomeRow::value_type;

  void take(PlaneReader& reader, SomeWord* column) const {
    column[0] = reader.word<SomeWord>();
    const SomeWord second = reader.word<SomeWord>();
    const int width = reader.width(sizeof(SomeWord));
    if (count_ == 1) return;
    column[1] = second;
    const std::size_t num_coded = count_ - 2;
    for (int byte = 0; byte < width && num_coded > 0; ++byte) {
      const std::string_view plane = reader.take(num_coded);
      for (std::size_t i = 0; i < num_coded; ++i) {
        column[i + 2] |= static_cast<SomeWord>(static_cast<unsigned char>(plane[i]))
                         << (8 * byte);
      }
    }
    for (std::size_t i = 2; i < count_; ++i) {
      column[i] = unzigzag(column[i]) + 2 * column[i - 1] - column[i - 2];
    }
  }

  std::size_t count_;
  SomeRow like_;
  std::vector<SomeWord> words_;
};

std::string compressed(const std::string& raw) {
  std::string bytes(ZSTD_compressBound(raw.size()), '\0');
  const std::size_t size =
      ZSTD_compress(bytes.data(), bytes.size(), raw.data(), raw.size(), /*compressionLevel=*/1);
  if (ZSTD_isError(size) != 0) {
    throw Error(std::string("recording: expected zstd to compress, found: ") +
                ZSTD_getErrorName(size));
  }
  bytes.resize(size);
  return bytes;
}

/// Returns the content of a zstd frame. The frame must not hold more than `largest` bytes.
std::string decompressed(std::string_view frame, unsigned long long largest,
                         const PlaneReader& damaged) {
  const unsigned long long size = ZSTD_getFrameContentSize(frame.data(), frame.size());
  if (size > largest) damaged.fail();  // The two error codes of zstd are larger still.
  std::string raw(size, '\0');
  if (ZSTD_decompress(raw.data(), raw.size(), frame.data(), frame.size()) != size) {
    damaged.fail();
  }
  return raw;
}

}  // namespace

std::string encode_samples(const std::vector<Sample>& samples) {
  if (samples.empty()) return {};
  std::vector<Row> rows;
  rows.reserve(samples.size());
  for (const Sample& sample : samples) rows.push_back(row_of(sample));
  std::string raw;
  raw.reserve(rows.size() * 24);
  put_planes(rows, raw);
  if (std::ranges::any_of(samples, has_joints)) {
    std::vector<JointRow> joints;
    joints.reserve(samples.size());
    for (const Sample& sample : samples) joints.push_back(joint_row_of(sample));
    put_planes(joints, raw);
  }
  std::string bytes = compressed(raw);
  const ChannelBits channels = samples.front().channels.bits;
  if (channels != 0 || std::ranges::any_of(samples, has_times)) {
    std::vector<TimeRow> times;
    times.reserve(samples.size());
    for (const Sample& sample : samples) times.push_back(time_row_of(sample));
    raw.clear();
    put_planes(times, raw);
    bytes += compressed(raw);
  }
  if (channels != 0) {
    std::vector<std::vector<Word>> rows_of_channels;
    rows_of_channels.reserve(samples.size());
    for (const Sample& sample : samples) {
      rows_of_channels.push_back(channel_row_of(channels, sample.channels));
    }
    raw.assign(1, static_cast<char>(channels));
    put_planes(rows_of_channels, raw);
    bytes += compressed(raw);
  }
  return bytes;
}

std::vector<Sample> decode_samples(std::string_view bytes, std::int64_t first_tick,
                                   std::int64_t num_samples, const std::string& place) {
  if (num_samples <= 0) return {};
  PlaneReader damaged({}, place);
  // This is far above any chunk that was ever written, so that a damaged row cannot ask for all
  // memory.
  constexpr std::int64_t kMostSamples = 1 << 20;
  if (num_samples > kMostSamples || first_tick < 0 ||
      first_tick > std::numeric_limits<std::int64_t>::max() - num_samples) {
    damaged.fail();
  }
  const auto count = static_cast<std::size_t>(num_samples);
  const auto next_frame = [&](unsigned long long largest) {
    const std::size_t size = ZSTD_findFrameCompressedSize(bytes.data(), bytes.size());
    if (ZSTD_isError(size) != 0) damaged.fail();
    std::string raw = decompressed(bytes.substr(0, size), largest, damaged);
    bytes.remove_prefix(size);
    return raw;
  };
  const std::string raw =
      next_frame((kNumChannels + kNumJointChannels) * (9ULL + 4ULL * count));
  PlaneReader reader(raw, place);
  const Columns<Row> columns(reader, count);
  std::optional<Columns<JointRow>> joints;
  if (!reader.is_at_end()) joints.emplace(reader, count);
  reader.finish();

  std::optional<Columns<TimeRow>> times;
  if (!bytes.empty()) {
    const std::string raw_times = next_frame(kNumTimeChannels * (17ULL + 8ULL * count));
    PlaneReader time_reader(raw_times, place);
    times.emplace(time_reader, count);
    time_reader.finish();
  }
  ChannelBits channel_bits = 0;
  std::optional<Columns<std::vector<Word>>> channels;
  if (!bytes.empty()) {
    const std::string raw_channels = next_frame(1 + kMostChannels * (9ULL + 4ULL * count));
    PlaneReader channel_reader(raw_channels, place);
    channel_bits = static_cast<ChannelBits>(channel_reader.take(1)[0]);
    if (channel_bits == 0 || (channel_bits & ~kAllChannels) != 0) damaged.fail();
    channels.emplace(channel_reader, count, channel_row_of(channel_bits, {}));
    channel_reader.finish();
  }
  if (!bytes.empty()) damaged.fail();
  std::vector<Sample> samples;
  samples.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    samples.push_back(sample_of(columns.row(i), first_tick + static_cast<std::int64_t>(i)));
    Sample& sample = samples.back();
    if (joints) take_joints(joints->row(i), sample);
    if (channels) take_channels(channel_bits, channels->row(i), sample.channels);
    if (!times) continue;
    const TimeRow row = times->row(i);
    sample.monotonic_ns = nanoseconds(row[0]);
    sample.device_time_ns = nanoseconds(row[1]);
  }
  return samples;
}

}  // namespace jnd::core
