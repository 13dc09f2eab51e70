#include "device/exoskeleton/exoskeleton_options.h"

#include <charconv>
#include <cmath>
#include <string>

#include "core/error.h"

namespace jnd::device {
namespace {

constexpr std::string_view kGain = "feed-forward=";

double gain_of(std::string_view text) {
  double gain = 0.0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), gain);
  if (problem == std::errc() && end == text.data() + text.size() && gain >= 0.0 &&
      std::isfinite(gain)) {
    return gain;
  }
  throw core::Error("device exoskeleton: feed-forward: expected a number >= 0, found \"" +
                    std::string(text) + "\"");
}

void apply(std::string_view option, ExoskeletonDevice::Parameters& parameters) {
  if (option.starts_with(kGain)) {
    parameters.control.feed_forward_gain_ratio = gain_of(option.substr(kGain.size()));
  } else if (option == "compensated") {
    parameters.control.compensates_feed_forward = true;
  } else if (option == "arm-locked") {
    parameters.arm_joint_locked.fill(true);
  } else {
    throw core::Error(
        "device exoskeleton: expected feed-forward=K, compensated or arm-locked, with commas "
        "between, found \"" +
        std::string(option) + "\"");
  }
}

}  // namespace

ExoskeletonDevice::Parameters exoskeleton_parameters(std::string_view options) {
  ExoskeletonDevice::Parameters parameters;
  while (!options.empty()) {
    const std::size_t comma = options.find(',');
    apply(options.substr(0, comma), parameters);
    options = comma == std::string_view::npos ? std::string_view() : options.substr(comma + 1);
  }
  return parameters;
}

}  // namespace jnd::device
