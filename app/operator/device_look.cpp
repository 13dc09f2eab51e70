#include "app/operator/device_look.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <utility>

#include "app/commissioning/daily_check.h"
#include "app/language/words.h"
#include "app/profile/profile_choice.h"
#include "core/device_channels.h"
#include "core/error.h"
#include "device/registry/device_registry.h"

namespace jnd::app {
namespace {

using experiments::DeviceProfile;
using experiments::MeasuredValue;
using Status = PreflightLine::Status;

std::string limit_words(double value, const char* unit) {
  return std::isfinite(value) ? fmt::format("{:g} {}", value, unit)
                              : std::string(tr("not limited by it"));
}

std::string points_words(const device::DeviceCapabilities& can) {
  std::string names;
  for (int i = 0; i < core::kNumContactPoints; ++i) {
    if (can.has_point(i)) {
      names += (names.empty() ? "" : ", ") + std::string(core::kContactPointNames[i]);
    }
  }
  return fmt::format("{} ({})", can.num_contact_points(), names);
}

/// What the device says about itself.
std::vector<DeviceLine> facts_of(const device::HapticDevice& device) {
  const device::DeviceCapabilities can = device.capabilities();
  const device::DeviceIdentity identity = device.identity();
  std::vector<DeviceLine> facts = {
      {tr("Model"), identity.model},
      {tr("Serial"), identity.serial.empty() ? tr("not told") : identity.serial},
      {tr("Firmware"), identity.firmware.empty() ? tr("not told") : identity.firmware},
      {tr("Kind"), can.simulated ? tr("SIMULATED") : tr("real")},
      {tr("Contact points"), points_words(can)},
      {tr("Rate"), fmt::format("{:g} Hz", can.rate_hz)},
      {tr("Force at one point"), limit_words(can.max_force_per_point_n, "N")},
      {tr("Force in all"), limit_words(can.max_total_force_n, "N")},
      {tr("Speed"), limit_words(can.max_speed_m_per_s, "m/s")},
      {tr("Enabling switch"), can.has_enable_switch ? tr("yes: hold it while the device moves")
                                                    : tr("none that it tells of")}};
  if ((can.channels & core::kButtons) != 0) {
    facts.push_back({tr("Buttons"), tr("told, and recorded")});
  }
  if (const auto link = device.link()) {
    facts.push_back({tr("Link"), tr("{}, there and back in {:.2f} ms, {:.1f} % lost",
                                    std::string(link->level), 1e3 * link->round_trip_s,
                                    100.0 * link->lost_ratio)});
  }
  return facts;
}

void add_number(std::vector<DeviceLine>& lines, const char* what,
                const std::optional<MeasuredValue>& value, double scale, const char* unit) {
  if (!value) return;
  const double half_width = 0.5 * scale * std::abs(value->ci95[1] - value->ci95[0]);
  const int decimals =
      half_width > 0.0
          ? std::clamp(1 - static_cast<int>(std::floor(std::log10(half_width))), 0, 6)
          : 3;
  lines.push_back({what, fmt::format("{:.{}f} [{:.{}f}, {:.{}f}] {}", scale * value->value,
                                     decimals, scale * value->ci95[0], decimals,
                                     scale * value->ci95[1], decimals, unit)});
}

std::vector<DeviceLine> numbers_of(const DeviceProfile& profile) {
  std::vector<DeviceLine> lines;
  add_number(lines, tr("Gain"), profile.force.gain, 1.0, "N/N");
  add_number(lines, tr("Weight not carried"), profile.tool.weight_n, 1.0, "N");
  add_number(lines, tr("Own damping"), profile.mechanics.damping_n_s_per_m, 1.0, "N s/m");
  add_number(lines, tr("Dry friction"), profile.mechanics.friction_n, 1.0, "N");
  add_number(lines, tr("Mass"), profile.mechanics.mass_kg, 1.0, "kg");
  add_number(lines, tr("Delay"), profile.delay_s, 1e3, "ms");
  if (profile.noise.position_sd_m) {
    lines.push_back({tr("Noise of a position"),
                     fmt::format("{:.2g} µm", 1e6 * *profile.noise.position_sd_m)});
  }
  if (profile.frame.offset_ci95_m && profile.frame.rotation_ci95_rad) {
    lines.push_back(
        {tr("Frame known to"), tr("{:.2f} mm, {:.2f}°", 1e3 * *profile.frame.offset_ci95_m,
                                  57.29577951 * *profile.frame.rotation_ci95_rad)});
  }
  return lines;
}

std::string age_in_days(const DeviceProfile& profile) {
  const int days = days_between(profile.measured_on, today());
  return days == 0 ? std::string(tr("today")) : trn("{} day ago", "{} days ago", days);
}

DeviceView::Check check_line(const experiments::DailyCheck& check) {
  std::string words = check.passed ? tr("passed") : tr("failed");
  if (check.gain) words += tr(" · gain {:.3f}", check.gain->value);
  if (check.damping_n_s_per_m) {
    words += tr(" · {:.2f} N s/m", check.damping_n_s_per_m->value);
  }
  return {.day = check.checked_on, .words = std::move(words), .passed = check.passed};
}

void add_profile(DeviceView& view, const KnownProfile& known) {
  const DeviceProfile& profile = known.profile;
  view.profile_file = known.place;
  view.profile_facts = {{tr("File"), known.place},
                        {tr("Measured"), profile.measured_on + ", " + age_in_days(profile)},
                        {tr("Valid until"), profile.valid_until}};
  view.profile_numbers = numbers_of(profile);
  std::ranges::transform(profile.checks.rbegin(), profile.checks.rend(),
                         std::back_inserter(view.checks), check_line);
}

/// Adds what a session would say about the profile now, and what is known in any case.
void look_at_profile(DeviceView& view, const DeviceOfProfile& device, const std::string& file) {
  view.profile.name = tr("Profile");
  std::vector<std::filesystem::path> folders = profile_folders();
  if (device.is_simulated) {
    folders.insert(folders.begin(), folder_for_profile({}, usual_record(device.name), true));
  }
  try {
    if (!file.empty()) {
      add_profile(view, read_known_profile(file));
    } else if (const FoundProfile found = find_profile(device, folders, today()); found.known) {
      add_profile(view, *found.known);
    }
    const ProfileChoice choice = choose_profile(device, file, profile_folders(), today());
    if (!choice.lack.empty()) {
      view.profile.status = Status::kFailed;
      view.profile.found = view.profile_file.empty() ? tr("no force: it has no profile")
                                                     : tr("no force: its profile is refused");
      view.profile.remedy = choice.lack;
    } else if (choice.known) {
      view.profile.status = Status::kOk;
      view.profile.found =
          tr("ready: its profile is valid until {}", choice.known->profile.valid_until);
    } else {
      view.profile.status = Status::kOk;
      view.profile.found = tr("ready: a simulated device needs no profile");
    }
  } catch (const core::Error& error) {
    view.profile.status = Status::kFailed;
    view.profile.found = tr("no force: its profile is refused");
    view.profile.remedy = error.what();
  }
}

void look_at_record(DeviceView& view, const CommissionedDevice& device,
                    const MeasuringPlan& plan) {
  const std::filesystem::path record = usual_record(view.name);
  view.record = record.string();
  CommissioningResults results;
  view.next_step = 0;
  std::error_code ignored;
  if (std::filesystem::exists(record, ignored)) {
    try {
      const Commissioning begun(record, device, plan);
      results = begun.results();
    } catch (const core::Error& error) {
      view.record_problem = error.what();
    }
  }
  view.next_step.reset();
  for (const CommissioningStep step : kCommissioningSteps) {
    const auto place = static_cast<std::size_t>(step);
    view.steps[place] = step_line(step, results);
    if (!results.has(step) && !view.next_step) view.next_step = place;
  }
}

}  // namespace

DeviceView::Step step_line(CommissioningStep step, const CommissioningResults& results) {
  DeviceView::Step line{.title = tr(words_of(step).title), .to_do = tr(words_of(step).to_do)};
  const std::string& at = results.measured_at[static_cast<std::size_t>(step)];
  constexpr std::size_t kDate = 10, kTime = 5;
  if (at.size() > kDate + kTime) {
    line.measured_at = at.substr(0, kDate) + " " + at.substr(kDate + 1, kTime) + " UTC";
  }
  for (const FoundLine& found : found_in(step, results)) {
    line.found.push_back({tr(found.what.c_str()), found.value + " " + found.unit});
  }
  const std::vector<CommissioningStep> before = steps_before(step);
  line.waits =
      std::ranges::any_of(before, [&](CommissioningStep other) { return !results.has(other); });
  return line;
}

DeviceView look_at_device(const std::string& name, const std::string& profile,
                          const MeasuringPlan& plan) {
  DeviceView view{.name = name};
  view.marks_m = plan.marks_m.empty() ? default_marks_m() : plan.marks_m;
  view.daily_marks_m = daily_marks_m(view.marks_m);
  view.daily_to_do = tr(daily_check_to_do());
  for (const CommissioningStep step : kCommissioningSteps) {
    view.steps[static_cast<std::size_t>(step)] = step_line(step, {});
  }
  try {
    const std::unique_ptr<device::HapticDevice> device =
        device::make_device(name, kDeviceRate_hz);
    view.is_simulated = device->capabilities().simulated;
    view.facts = facts_of(*device);
    look_at_profile(view, device_of_profile(name, *device), profile);
    look_at_record(
        view, {.name = name, .identity = device->identity(), .can = device->capabilities()},
        plan);
    view.is_known = true;
  } catch (const core::Error& error) {
    view.problem = error.what();
    view.profile = {.name = tr("Profile"), .found = tr("not known")};
  }
  return view;
}

PreflightLine waiting_device_line(const std::string& name, const std::string& profile) {
  const std::string title = tr("Chosen device");
  if (device::kind_of(name) == "network") {
    return {.name = title, .status = Status::kOk, .found = name};
  }
  return line_from(title, tr("{}: cannot be used", name), [&]() -> PreflightLine {
    const DeviceOfProfile device = device_of_profile(name, kDeviceRate_hz);
    const ProfileChoice choice = choose_profile(device, profile, profile_folders(), today());
    PreflightLine line{.name = title, .status = Status::kOk};
    if (!choice.lack.empty()) {
      line.status = Status::kFailed;
      line.found = tr("{}, without a valid profile", name);
      line.remedy = choice.lack;
    } else if (choice.known) {
      line.found = tr("{}, profile valid until {}", name, choice.known->profile.valid_until);
    } else {
      line.found = tr("{}, simulated: needs no profile", name);
    }
    return line;
  });
}

}  // namespace jnd::app
