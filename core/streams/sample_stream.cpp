#include "core/streams/sample_stream.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <string_view>

#include "core/error.h"
#include "core/sample_table.h"

namespace jnd::core {
namespace {

constexpr std::size_t kNumUsual = 10;
constexpr std::string_view kUsual[kNumUsual] = {
    "hand_position_x_m",       "hand_position_y_m",
    "hand_position_z_m",       "hand_velocity_x_m_per_s",
    "hand_velocity_y_m_per_s", "hand_velocity_z_m_per_s",
    "hand_force_x_n",          "hand_force_y_n",
    "hand_force_z_n",          "command"};

/// All columns that any device has. Channels that this device lacks are 0.
constexpr SampleColumns kAllColumns{
    .times = false, .joints = true, .channels = static_cast<ChannelBits>(~ChannelBits{0})};

struct UnitOfName {
  std::string_view ending, unit, type;
};
/// Longer endings come first.
constexpr UnitOfName kUnits[] = {
    {"_m_per_s", "m/s", "Velocity"}, {"torque_n_m", "N m", "Torque"},
    {"_x_n_m", "N m", "Torque"},     {"_y_n_m", "N m", "Torque"},
    {"_z_n_m", "N m", "Torque"},     {"_rad", "rad", "Orientation"},
    {"_m", "m", "Position"},         {"_n", "N", "Force"}};

StreamChannel channel_named(const std::string& name) {
  for (const UnitOfName& one : kUnits) {
    if (name.ends_with(one.ending)) {
      return {name, std::string(one.unit), std::string(one.type)};
    }
  }
  return {name, "", "Misc"};
}

std::array<double, kNumUsual> usual_values(const Sample& sample) {
  std::array<double, kNumUsual> values{};
  const unsigned bits = measured_bits(sample);
  const double share = 1.0 / num_measured_points(sample);
  const auto& force_n = delivered_force_n(sample);
  for (int point = 0; point < kNumContactPoints; ++point) {
    if (bits != 0 && (bits >> point & 1U) == 0) continue;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      values[axis] += share * sample.tip_position_m[point][axis];
      values[3 + axis] += share * sample.tip_velocity_m_per_s[point][axis];
      values[6 + axis] += force_n[point][axis];
    }
  }
  values[9] = sample.command_sequence;
  return values;
}

}  // namespace

const std::vector<std::string>& SampleStream::usual_channels() {
  static const std::vector<std::string> names(std::begin(kUsual), std::end(kUsual));
  return names;
}

SampleStream::SampleStream(const std::vector<std::string>& names) {
  const std::vector<SampleColumn> columns = sample_columns(kAllColumns);
  for (const std::string& name : names.empty() ? usual_channels() : names) {
    const std::size_t num_before = channels_.size();
    for (std::size_t i = 0; i < kNumUsual; ++i) {
      if (kUsual[i] == name) channels_.push_back({.name = name, .usual = static_cast<int>(i)});
    }
    for (std::size_t i = 0; i < columns.size(); ++i) {
      if (columns[i].name != name && columns[i].array != name) continue;
      channels_.push_back({.name = columns[i].name, .column = i});
      has_columns_ = true;
    }
    if (channels_.size() > num_before) continue;
    std::string known;
    for (const std::string_view one : kUsual) known += std::string(one) + ", ";
    throw Error("channels: expected one of " + known +
                "or a column of samples as palm_inner_position_x_m or position_m, found `" +
                name.substr(0, 60) + "`");
  }
}

StreamInfo SampleStream::info(const SessionStreamFacts& facts, double rate_hz) const {
  StreamInfo info{
      .name = "jnd-samples",
      .type = "Haptics",
      .channel_count = static_cast<int>(channels_.size()),
      .nominal_rate_hz = rate_hz,
      .format = ChannelFormat::kFloat32,
      .source_id = "jnd-samples-" + facts.study_id + "-" + std::to_string(facts.session),
      .facts = {{"manufacturer", "jnd"},
                {"program_version", facts.program_version},
                {"study", facts.study},
                {"session", std::to_string(facts.session)},
                {"frame", "workspace: x right, y away, z up; forces are those on the hand"}}};
  for (const Channel& channel : channels_) info.channels.push_back(channel_named(channel.name));
  return info;
}

StreamSample SampleStream::sample(const Sample& sample, double time_s) const {
  const std::array<double, kNumUsual> usual = usual_values(sample);
  const std::vector<double> columns =
      has_columns_ ? sample_values(sample, kAllColumns) : std::vector<double>();
  StreamSample streamed{.time_s = time_s};
  streamed.values.resize(sizeof(float) * channels_.size());
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    const Channel& channel = channels_[i];
    const auto value =
        static_cast<float>(channel.usual >= 0 ? usual[static_cast<std::size_t>(channel.usual)]
                                              : columns[channel.column]);
    std::memcpy(streamed.values.data() + i * sizeof value, &value, sizeof value);
  }
  return streamed;
}

}  // namespace jnd::core
