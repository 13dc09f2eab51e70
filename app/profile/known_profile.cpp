#include "app/profile/known_profile.h"

#include <fmt/format.h>

#include <chrono>
#include <ctime>
#include <fstream>
#include <iterator>

#include "experiments/device_profile/profile_reader.h"

namespace jnd::app {
namespace {

std::chrono::sys_days day_of(const std::string& date) {
  const auto number = [&date](std::size_t begin, std::size_t length) {
    return std::stoi(date.substr(begin, length));
  };
  return std::chrono::year(number(0, 4)) / number(5, 2) / number(8, 2);
}

}  // namespace

KnownProfile read_known_profile(const std::filesystem::path& file) {
  // The reader tells about a file that cannot be opened or is much too long.
  (void)experiments::read_device_profile(file);
  std::ifstream stream(file, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(stream), {}};
  // Reads the text that is stored, and not what was in the file a moment before.
  experiments::DeviceProfile profile =
      experiments::read_device_profile_text(text, file.string());
  return {.profile = std::move(profile), .text = std::move(text), .place = file.string()};
}

KnownProfile stored_profile(const core::StudyStore& store, const std::string& sha256) {
  std::string text = store.device_profile(sha256).text;
  const std::string place = store.folder().string() + ": stored device profile";
  experiments::DeviceProfile profile = experiments::read_device_profile_text(text, place);
  return {.profile = std::move(profile), .text = std::move(text), .place = place};
}

std::string today() {
  const std::time_t now = std::time(nullptr);
  std::tm local{};
  ::localtime_r(&now, &local);
  char text[16];
  return {text, std::strftime(text, sizeof text, "%Y-%m-%d", &local)};
}

int days_between(const std::string& from, const std::string& until) {
  return static_cast<int>((day_of(until) - day_of(from)).count());
}

std::string device_words(const std::string& model, const std::string& serial) {
  return serial.empty() ? "`" + model + "`" : "`" + model + "` " + serial;
}

std::string age_words(const experiments::DeviceProfile& profile, const std::string& on_day) {
  const int days = days_between(profile.measured_on, on_day);
  const std::string age = days == 0   ? "today"
                          : days == 1 ? "yesterday"
                          : days > 1  ? fmt::format("{} days ago", days)
                                      : "by the device's calendar later than today";
  return fmt::format("{}measured on {}, {}, valid until {}",
                     profile.simulated ? "SIMULATED, " : "", profile.measured_on, age,
                     profile.valid_until);
}

std::string foreign_words(const KnownProfile& known, const device::DeviceIdentity& device,
                          bool says_simulated, bool is_open) {
  const experiments::DeviceProfile::Device& its = known.profile.device;
  const bool has_serial = is_open || !device.serial.empty();
  if (its.model != device.model || (has_serial && its.serial != device.serial)) {
    return fmt::format(
        "{}: expected the profile of the device that is used, {}, found that of {}; choose its "
        "own, or measure it with `jnd commission`",
        known.place, device_words(device.model, device.serial),
        device_words(its.model, its.serial));
  }
  if (known.profile.simulated && !says_simulated) {
    return fmt::format(
        "{}: expected a profile that was measured on the device itself, found one of a "
        "SIMULATED device; measure it with `jnd commission`",
        known.place);
  }
  return "";
}

std::string ended_words(const KnownProfile& known, const std::string& on_day) {
  if (!(known.profile.valid_until < on_day)) return "";
  return fmt::format(
      "{}: expected a profile that is valid today ({}), found that it ended on {}; measure "
      "the device again with `jnd commission`",
      known.place, on_day, known.profile.valid_until);
}

std::string outdated_words(const KnownProfile& known, const std::string& on_day) {
  if (std::string words = ended_words(known, on_day); !words.empty()) return words;
  const experiments::DeviceProfile& profile = known.profile;
  if (!profile.checks.empty() && !profile.checks.back().passed) {
    return fmt::format(
        "{}: expected a device whose last daily check was passed, found that of {} failed; "
        "look for the reason, then check it again with `jnd commission --daily`, or measure it "
        "anew with `jnd commission`",
        known.place, profile.checks.back().checked_on);
  }
  return "";
}

device::ProfiledDevice::Parameters device_parameters(
    const experiments::DeviceProfile& profile) {
  device::ProfiledDevice::Parameters parameters;
  for (int i = 0; i < 9; ++i) {
    parameters.rotation(i / 3, i % 3) = profile.frame.rotation[static_cast<std::size_t>(i)];
  }
  for (int axis = 0; axis < 3; ++axis) {
    parameters.offset_m[axis] = profile.frame.offset_m[static_cast<std::size_t>(axis)];
  }
  const experiments::DeviceProfile::Limits& limits = profile.limits;
  parameters.max_force_per_point_n = limits.max_force_per_point_n;
  parameters.max_total_force_n = limits.max_total_force_n;
  parameters.max_slew_n_per_s = limits.max_slew_n_per_s;
  parameters.max_speed_m_per_s = limits.max_speed_m_per_s;
  parameters.workspace = {.half_width_x_m = limits.workspace_half_width_m[0],
                          .half_width_y_m = limits.workspace_half_width_m[1],
                          .half_width_z_m = limits.workspace_half_width_m[2]};
  const auto value = [](const std::optional<experiments::MeasuredValue>& measured) {
    return measured ? std::optional(measured->value) : std::nullopt;
  };
  parameters.own_mass_kg = value(profile.mechanics.mass_kg);
  parameters.own_damping_n_s_per_m = value(profile.mechanics.damping_n_s_per_m);
  parameters.closed_loop_delay_s = value(profile.delay_s);
  return parameters;
}

}  // namespace jnd::app
