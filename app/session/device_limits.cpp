#include "app/session/device_limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "device/registry/device_registry.h"

namespace jnd::app {

std::optional<StabilityMap> stability_map_of(const std::string& device,
                                             const experiments::DeviceProfile& profile) {
  if (!profile.stability) return std::nullopt;
  const experiments::DeviceProfile::Stability& its = *profile.stability;
  // If the loop ends the force of a fluid because it is noisy, the device does not render that
  // fluid.
  const double quiet_pa_s = its.quiet_viscosity_pa_s.value_or(its.viscosity_pa_s.value);
  const device::ExoskeletonStability limits = {
      .viscosity_pa_s = {.value = std::min(its.viscosity_pa_s.value, quiet_pa_s),
                         .is_beyond_ladder = its.viscosity_pa_s.is_beyond_ladder &&
                                             quiet_pa_s >= its.viscosity_pa_s.value},
      .stiffness_n_per_m = {.value = its.stiffness_n_per_m.value,
                            .is_beyond_ladder = its.stiffness_n_per_m.is_beyond_ladder}};
  StabilityMap map{
      .device = device,
      .measured = fmt::format("on {} with {}{}", profile.measured_on,
                              its.phantom_mass_kg > 0.0
                                  ? fmt::format("a phantom of {:g} kg", its.phantom_mass_kg)
                                  : "nothing in it",
                              profile.simulated ? ", SIMULATED" : "")};
  // A finger that came off was not measured separately.
  for (const device::Contact contact :
       {device::Contact::kAttached, device::Contact::kDetached}) {
    map.rows.push_back(
        {.measured_case = {.rate_hz = its.rate_hz, .contact = contact}, .limits = limits});
  }
  return map;
}

DeviceLimits limits_of_device(const std::string& device, double rate_hz,
                              const std::optional<KnownProfile>& known) {
  const std::unique_ptr<device::HapticDevice> made = device::make_device(device, rate_hz);
  if (!known) {
    return {.can = made->capabilities(), .stability = shipped_stability_map(device)};
  }
  return {
      .can = device::ProfiledDevice(*made, device_parameters(known->profile)).capabilities(),
      .stability = stability_map_of(device, known->profile)};
}

}  // namespace jnd::app
