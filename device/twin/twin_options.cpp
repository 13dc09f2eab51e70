#include <Eigen/Geometry>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>

#include "core/error.h"
#include "device/twin/twin_device.h"

namespace jnd::device {
namespace {

using Parameters = TwinDevice::Parameters;

/// The numbers that can be set by name.
constexpr struct {
  std::string_view key;
  double Parameters::*field;
} kNumbers[] = {{"mass_kg", &Parameters::mass_kg},
                {"hand_mass_kg", &Parameters::hand_mass_kg},
                {"damping_n_s_per_m", &Parameters::damping_n_s_per_m},
                {"friction_n", &Parameters::friction_n},
                {"weight_n", &Parameters::weight_n},
                {"gain", &Parameters::gain},
                {"cogging_n", &Parameters::cogging_n},
                {"delay_s", &Parameters::delay_s},
                {"position_sd_m", &Parameters::position_sd_m},
                {"position_resolution_m", &Parameters::position_resolution_m},
                {"velocity_sd_m_per_s", &Parameters::velocity_sd_m_per_s},
                {"touch_sd_m", &Parameters::touch_sd_m},
                {"homing_sd_m", &Parameters::homing_sd_m}};

/// Changes since the device was measured. It stays the same device, with the same serial.
constexpr struct {
  std::string_view key;
  void (*change)(Parameters& twin, double by);
} kChanges[] = {{"drifted_gain_ratio", [](Parameters& twin, double by) { twin.gain *= by; }},
                {"added_damping_n_s_per_m",
                 [](Parameters& twin, double by) { twin.damping_n_s_per_m += by; }},
                // The device was turned on its table.
                {"turned_rad", [](Parameters& twin, double by) {
                   twin.rotation =
                       Eigen::AngleAxisd(by, Eigen::Vector3d::UnitZ()) * twin.rotation;
                 }}};

template <typename Number>
Number number_in(std::string_view option, std::string_view text) {
  Number number{};
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (problem != std::errc() || end != text.data() + text.size()) {
    throw core::Error("device twin: expected a number behind " + std::string(option) +
                      "=, found \"" + std::string(text.substr(0, 80)) + "\"");
  }
  return number;
}

/// Draws a rotation; all are equally likely (Shoemake 1992).
Eigen::Matrix3d drawn_rotation(core::RandomStream& random) {
  const double u = random.uniform();
  const double first = 2.0 * std::numbers::pi * random.uniform();
  const double second = 2.0 * std::numbers::pi * random.uniform();
  const Eigen::Quaterniond turn(
      std::sqrt(u) * std::cos(second), std::sqrt(1.0 - u) * std::sin(first),
      std::sqrt(1.0 - u) * std::cos(first), std::sqrt(u) * std::sin(second));
  return turn.normalized().toRotationMatrix();
}

}  // namespace

Parameters drawn_twin(std::uint64_t seed) {
  core::RandomStream random(seed, "twin is made");
  Parameters twin;
  twin.serial = "seed-" + std::to_string(seed);
  twin.noise_seed = seed;
  twin.mass_kg = random.uniform(0.3, 1.5);
  twin.damping_n_s_per_m = random.uniform(0.5, 5.0);
  twin.friction_n = random.uniform(0.1, 1.5);
  twin.weight_n = random.uniform(-1.0, 3.0);
  twin.gain = random.uniform(0.85, 1.15);
  twin.cogging_n = random.uniform(0.02, 0.15);
  twin.delay_s = random.uniform(0.0, 0.004);
  twin.rotation = drawn_rotation(random);
  for (int axis = 0; axis < 3; ++axis) twin.offset_m[axis] = random.uniform(-0.4, 0.4);
  twin.position_sd_m = random.uniform(2e-6, 2e-5);
  twin.position_resolution_m = random.uniform(1e-6, 2e-5);
  twin.velocity_sd_m_per_s = random.uniform(0.0005, 0.003);
  twin.touch_sd_m = random.uniform(0.0001, 0.0004);
  twin.homing_sd_m = core::RandomStream(seed, "twin homes").uniform(0.00002, 0.0002);
  return twin;
}

Parameters twin_parameters(std::string_view options) {
  Parameters twin;
  std::string changed;
  while (!options.empty()) {
    const std::string_view option = options.substr(0, options.find(','));
    options.remove_prefix(std::min(options.size(), option.size() + 1));
    const std::size_t equals = option.find('=');
    const std::string_view key = option.substr(0, equals);
    const std::string_view text =
        equals == std::string_view::npos ? std::string_view() : option.substr(equals + 1);
    if (key == "seed") {
      if (!changed.empty()) {
        throw core::Error(
            "device twin: expected seed= before every other option, found it "
            "behind" +
            changed);
      }
      twin = drawn_twin(number_in<std::uint64_t>(key, text));
      continue;
    }
    double Parameters::*field = nullptr;
    std::string known = "seed";
    for (const auto& entry : kChanges) known += ", " + std::string(entry.key);
    for (const auto& entry : kNumbers) {
      if (entry.key == key) field = entry.field;
      known += ", " + std::string(entry.key);
    }
    const auto* const changed_now =
        std::ranges::find_if(kChanges, [key](const auto& one) { return one.key == key; });
    if (changed_now != std::end(kChanges)) {
      changed_now->change(twin, number_in<double>(key, text));
      continue;
    }
    if (field == nullptr) {
      throw core::Error("device twin: expected one of " + known +
                        ", each with = and a number, "
                        "found \"" +
                        std::string(option.substr(0, 80)) + "\"");
    }
    twin.*field = number_in<double>(key, text);
    changed += " " + std::string(option);
  }
  // Another device needs another serial, because a profile belongs to one device.
  if (!changed.empty()) twin.serial += changed;
  return twin;
}

}  // namespace jnd::device
