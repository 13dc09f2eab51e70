#include "app/session/person_bench.h"

#include <fmt/format.h>

#include <charconv>
#include <istream>
#include <ostream>
#include <utility>

#include "app/session/attachment_watch.h"
#include "core/error.h"

namespace jnd::app {
namespace {

constexpr double kMeasured_s = 10.0;
constexpr double kHeaviest_g = 2000.0;

std::string words_of(device::FingerPose pose) {
  using device::FingerPose;
  switch (pose) {
    case FingerPose::k0:
      return "horizontal, at 0 degrees (the weight extends it)";
    case FingerPose::k90:
      return "horizontal, at 90 degrees (the weight pulls it aside)";
    case FingerPose::k180:
      return "horizontal, at 180 degrees (the weight bends it)";
    case FingerPose::k270:
      return "horizontal, at 270 degrees (the weight pulls it to the other side)";
    case FingerPose::kInclined:
      return "inclined by 45 degrees, at 0 degrees";
  }
  return "";
}

/// The weight in grams; 0 if the text is no valid weight.
double grams_in(const std::string& line) {
  double grams = 0.0;
  const char* end = line.data() + line.size();
  const auto [stop, error] = std::from_chars(line.data(), end, grams);
  const bool is_weight = error == std::errc() && stop == end && !line.empty();
  return is_weight && grams > 0.0 && grams <= kHeaviest_g ? grams : 0.0;
}

}  // namespace

PersonBench::PersonBench(std::istream& in, std::ostream& out, int point, int num_repetitions,
                         Measure measure)
    : in_(in),
      out_(out),
      point_(point),
      num_repetitions_(num_repetitions),
      measure_(std::move(measure)) {}

std::string PersonBench::next_line() {
  out_ << std::flush;
  std::string line;
  if (std::getline(in_, line)) return line;
  throw core::Error(
      "stdin: expected an answer to each step, found its end; characterise again with somebody "
      "at the keyboard");
}

void PersonBench::wait_for(const std::string& what_to_do) {
  out_ << what_to_do << ".\n";
  (void)next_line();
}

double PersonBench::break_away_weight_n(device::FingerPose pose, int repetition) {
  if (repetition == 1) {
    wait_for(fmt::format("Bring the device's finger for {} into its pose, {}, then press Enter",
                         words_of_points(static_cast<std::uint8_t>(1 << point_)),
                         words_of(pose)));
  }
  while (true) {
    out_ << fmt::format(
        "{} of {}: fill the container at its tip until the finger moves; its weight in g: ",
        repetition, num_repetitions_);
    if (const double grams = grams_in(next_line()); grams > 0.0) {
      return 1e-3 * grams * device::kGravityMPerS2;
    }
    out_ << fmt::format("Expected a weight in g, above 0 and at most {:g}.\n", kHeaviest_g);
  }
}

device::TorqueReading PersonBench::torques_under(device::FingerPose pose, double weight_n) {
  wait_for(fmt::format(
      "Hang {:.0f} g at the tip of {}, {}, then press Enter and keep it still for {:g} s",
      1e3 * weight_n / device::kGravityMPerS2,
      words_of_points(static_cast<std::uint8_t>(1 << point_)), words_of(pose), kMeasured_s));
  device::TorqueReading sum;
  double num_samples = 0.0;
  measure_(kMeasured_s, [&](const core::Sample& sample) {
    device::JointVector position_rad;
    for (int joint = 0; joint < core::kNumJoints; ++joint) {
      position_rad[joint] = static_cast<double>(sample.joint_position_rad[joint]);
    }
    const auto expected_n_m =
        device::expected_torque_n_m(position_rad, point_, {0.0, 0.0, -weight_n});
    for (std::size_t joint = 0; joint < expected_n_m.size(); ++joint) {
      const int index = core::finger_joint(point_, static_cast<int>(joint));
      sum.measured_n_m[joint] += static_cast<double>(sample.joint_torque_n_m[index]);
      sum.expected_n_m[joint] += expected_n_m[joint];
    }
    ++num_samples;
  });
  if (num_samples == 0.0) {
    throw core::Error("device: expected samples for 10 s, found none; look at its connection");
  }
  for (double& value : sum.measured_n_m) value /= num_samples;
  for (double& value : sum.expected_n_m) value /= num_samples;
  return sum;
}

}  // namespace jnd::app
