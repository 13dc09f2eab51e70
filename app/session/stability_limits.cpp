#include "app/session/stability_limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "app/session/shipped_files.h"
#include "core/error.h"
#include "core/media/viscous_drag.h"
#include "experiments/procedures/stimulus.h"

namespace jnd::app {
namespace {

using device::Contact;
using device::StabilityLimit;
using nlohmann::json;
using nlohmann::ordered_json;

/// Rounds down to three digits, which is more than the precision of a limit, so that the result
/// is never more than was found.
double rounded_down(double value) {
  if (value <= 0.0) return value;
  const double exponent = std::floor(std::log10(value)) - 2.0;
  // A whole number, so that 31.3 stays 31.3.
  const double power = std::pow(10.0, std::abs(exponent));
  return exponent < 0.0 ? std::floor(value * power + 1e-9) / power
                        : std::floor(value / power + 1e-9) * power;
}

void put(ordered_json& row, const std::string& quantity, const std::string& unit,
         const StabilityLimit& limit) {
  row[quantity + unit] = rounded_down(limit.value);
  row[quantity + "_is_at_least"] = limit.is_beyond_ladder;
}

double number_in(const json& row, const std::string& key) {
  const double value = row.at(key).get<double>();
  if (value >= 0.0) return value;
  throw core::Error(key + ": expected a number >= 0");
}

StabilityLimit limit_in(const json& row, const std::string& quantity, const std::string& unit) {
  return {.value = number_in(row, quantity + unit),
          .is_beyond_ladder = row.at(quantity + "_is_at_least").get<bool>()};
}

Contact contact_in(const json& row) {
  const auto name = row.at("contact").get<std::string>();
  const auto* found =
      std::find(device::kContactNames.begin(), device::kContactNames.end(), name);
  if (found != device::kContactNames.end()) {
    return static_cast<Contact>(found - device::kContactNames.begin());
  }
  throw core::Error("contact: expected attached, slipping or detached, found " + name);
}

StabilityRow row_in(const json& row) {
  return {.measured_case = {.rate_hz = number_in(row, "rate_hz"),
                            .extra_delay_s = number_in(row, "extra_delay_s"),
                            .contact = contact_in(row)},
          .limits = {.viscosity_pa_s = limit_in(row, "viscosity", "_pa_s"),
                     .stiffness_n_per_m = limit_in(row, "stiffness", "_n_per_m")}};
}

/// What a medium demands of a loop: its resistance to a small change of motion.
struct Demand {
  double viscosity_pa_s = 0.0;
  double stiffness_n_per_m = 0.0;
};

Demand demand_of(const core::MediumAmounts& amounts, const core::ForceMap* map,
                 double speed_m_per_s) {
  const double step_m_per_s = 0.01 * speed_m_per_s;
  const auto drag_n = [&](double at_m_per_s) {
    return amounts.drag_n({.speed_m_per_s = at_m_per_s, .sin_angle_of_attack = 1.0}, map);
  };
  const double slope_n_s_per_m =
      (drag_n(speed_m_per_s + step_m_per_s) - drag_n(speed_m_per_s - step_m_per_s)) /
          (2.0 * step_m_per_s) +
      std::max({amounts.ellipsoid_fingers_n_s_per_m, amounts.ellipsoid_across_n_s_per_m,
                amounts.ellipsoid_normal_n_s_per_m});
  const double per_viscosity_m = core::ViscousDrag({.viscosity_pa_s = 0.0}).shape_constant_m();
  return {.viscosity_pa_s = slope_n_s_per_m / per_viscosity_m,
          .stiffness_n_per_m =
              std::max(amounts.plane_stiffness_n_per_m, amounts.container_stiffness_n_per_m)};
}

bool holds(const device::ExoskeletonStability& limits, const Demand& demand) {
  // Allows a tiny excess, for a stimulus that is exactly at the limit.
  constexpr double kPlay = 1.0 + 1e-9;
  return demand.viscosity_pa_s <= kPlay * limits.viscosity_pa_s.value &&
         demand.stiffness_n_per_m <= kPlay * limits.stiffness_n_per_m.value;
}

/// The row with the highest rate that is not above this one, or else the row with the lowest
/// rate.
const StabilityRow* row_for(const StabilityMap& map, double rate_hz, Contact contact) {
  const StabilityRow* below = nullptr;
  const StabilityRow* lowest = nullptr;
  for (const StabilityRow& row : map.rows) {
    const device::StabilityCase& its = row.measured_case;
    if (its.contact != contact || its.extra_delay_s != 0.0) continue;
    if (lowest == nullptr || its.rate_hz < lowest->measured_case.rate_hz) lowest = &row;
    // Studies may give a rate such as 833.3.
    const bool is_below = its.rate_hz < rate_hz + 0.5;
    if (is_below && (below == nullptr || its.rate_hz > below->measured_case.rate_hz)) {
      below = &row;
    }
  }
  return below != nullptr ? below : lowest;
}

int count(const std::vector<bool>& flags, bool wanted) {
  return static_cast<int>(std::count(flags.begin(), flags.end(), wanted));
}

}  // namespace

ordered_json to_json(const StabilityMap& map) {
  auto limits = ordered_json::array();
  for (const StabilityRow& row : map.rows) {
    ordered_json entry = {
        {"rate_hz", row.measured_case.rate_hz},
        {"extra_delay_s", row.measured_case.extra_delay_s},
        {"contact",
         device::kContactNames[static_cast<std::size_t>(row.measured_case.contact)]}};
    put(entry, "viscosity", "_pa_s", row.limits.viscosity_pa_s);
    put(entry, "stiffness", "_n_per_m", row.limits.stiffness_n_per_m);
    limits.push_back(std::move(entry));
  }
  return {{"device", map.device},
          {"made_by", "jnd stability --device " + map.device},
          {"program_version", JND_VERSION},
          {"limiter_knows_attachment", false},
          {"limits", std::move(limits)}};
}

StabilityMap read_stability_map(const std::filesystem::path& file) try {
  std::ifstream stream(file);
  if (!stream) throw core::Error("expected a file that can be read");
  const json document = json::parse(stream);
  StabilityMap map{.device = document.at("device").get<std::string>()};
  for (const json& row : document.at("limits")) map.rows.push_back(row_in(row));
  return map;
} catch (const json::exception& error) {
  throw core::Error(file.string() + ": expected a map that `jnd stability` made, found: " +
                    error.what() + "; make it anew");
} catch (const core::Error& error) {
  throw core::Error(file.string() + ": " + error.what() +
                    "; make it anew with `jnd stability`");
}

std::optional<StabilityMap> shipped_stability_map(const std::string& device) {
  const std::filesystem::path file = shipped_folder() / "data/stability" / (device + ".json");
  std::error_code ignored;
  // What follows a colon is an address, which may contain anything.
  if (device.find_first_of(":/") != std::string::npos ||
      !std::filesystem::exists(file, ignored)) {
    return std::nullopt;
  }
  return read_stability_map(file);
}

int StabilityCheck::num_unstable() const { return count(is_stable, false); }

int StabilityCheck::num_needing_the_hand() const { return count(needs_the_hand, true); }

std::optional<StabilityCheck> check_stability(const StabilityMap& map,
                                              const experiments::Study& study,
                                              const std::vector<experiments::RangeEntry>& range,
                                              double expected_speed_m_per_s) {
  const double rate_hz = study.device.rate_hz;
  const StabilityRow* attached = row_for(map, rate_hz, Contact::kAttached);
  const StabilityRow* detached = row_for(map, rate_hz, Contact::kDetached);
  if (attached == nullptr || detached == nullptr) return std::nullopt;
  StabilityCheck check{.rate_hz = attached->measured_case.rate_hz,
                       .attached = attached->limits,
                       .detached = detached->limits,
                       .measured = map.measured};
  const auto force_map = experiments::force_map_of(study.device);
  const core::MediumAmounts surroundings = experiments::surroundings_of(study.device);
  for (const experiments::RangeEntry& entry : range) {
    core::MediumAmounts amounts = experiments::amounts_of(entry.setting);
    amounts += surroundings;
    const Demand demand = demand_of(amounts, force_map.get(), expected_speed_m_per_s);
    const bool is_stable = holds(check.attached, demand);
    check.is_stable.push_back(is_stable);
    check.needs_the_hand.push_back(is_stable && !holds(check.detached, demand));
  }
  return check;
}

std::string words_of(const StabilityLimit& limit, const char* unit) {
  if (limit.value == 0.0) return "none";
  const double value = rounded_down(limit.value);
  return (value >= 1000.0 ? fmt::format("{:.0f}", value) : fmt::format("{:g}", value)) + " " +
         unit + (limit.is_beyond_ladder ? " or more" : "");
}

std::string stably_words(const StabilityCheck& check, const std::string& device) {
  return fmt::format("`{}` renders stably at {:g} Hz{}", device, check.rate_hz,
                     check.measured.empty() ? "" : ", as measured " + check.measured);
}

std::string unstable_words(const StabilityCheck& check, const std::string& device) {
  return fmt::format("expected stimuli that {} ({} {} and {}), found {} of {} beyond",
                     stably_words(check, device),
                     check.measured.empty() ? "on the hand up to" : "up to",
                     words_of(check.attached.viscosity_pa_s, "Pa s"),
                     words_of(check.attached.stiffness_n_per_m, "N/m"), check.num_unstable(),
                     check.is_stable.size());
}

std::string detached_remark(const StabilityCheck& check) {
  const int count = check.num_needing_the_hand();
  if (count == 0) return "";
  return fmt::format(
      "{} of {} stimuli are stable on the hand alone: a finger that came off would be unstable "
      "above {} and {}; the limiter gives it no force",
      count, check.is_stable.size(), words_of(check.detached.viscosity_pa_s, "Pa s"),
      words_of(check.detached.stiffness_n_per_m, "N/m"));
}

}  // namespace jnd::app
