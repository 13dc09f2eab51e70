#include "app/results/measured_devices.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "analysis/results/inverted_answers.h"
#include "analysis/results/number_words.h"
#include "app/profile/known_profile.h"
#include "app/results/results_output.h"

namespace jnd::app {
namespace {

using analysis::DevicePart;
using analysis::Estimate;

/// Values by name, because sections may differ if an estimate does not exist at one end.
std::map<std::string, double> values_of(const analysis::StudyResults& results) {
  std::map<std::string, double> values;
  for (const analysis::ResultsSection& section : results.sections) {
    for (const Estimate& estimate : section.estimates) {
      if (estimate.value) values[section.name + "/" + estimate.name] = *estimate.value;
    }
  }
  return values;
}

}  // namespace

MeasuredDevices measured_devices(const core::StudyStore& store,
                                 const analysis::StudyData& data) {
  std::set<std::int64_t> sessions;
  for (const analysis::ParticipantData& participant : data.participants) {
    for (const core::TrialRow& trial : participant.trials) sessions.insert(trial.session);
  }
  MeasuredDevices devices;
  for (const core::SessionRow& session : store.sessions()) {
    if (!sessions.contains(session.session) || session.device_profile_sha256.empty()) continue;
    const experiments::DeviceProfile profile =
        stored_profile(store, session.device_profile_sha256).profile;
    const auto& gain = profile.force.gain;
    const auto& damping = profile.mechanics.damping_n_s_per_m;
    if (!gain && !damping) continue;
    const DevicePart part{.gain = gain ? gain->value : 1.0,
                          .damping_n_s_per_m = damping ? damping->value : 0.0};
    devices.parts[session.session] = devices.least[session.session] =
        devices.most[session.session] = part;
    if (damping) {
      devices.least[session.session].damping_n_s_per_m = std::max(0.0, damping->ci95[0]);
      devices.most[session.session].damping_n_s_per_m = damping->ci95[1];
    }
  }
  return devices;
}

analysis::DeliveredStudy delivered_study(const core::StudyStore& store,
                                         const analysis::StudyData& as_commanded,
                                         const analysis::DeviceParts& parts,
                                         bool leaves_out_inverted) {
  analysis::DeliveredStudy study = analysis::with_delivered(as_commanded, store, parts);
  if (leaves_out_inverted) analysis::leave_out_inverted(study.data);
  return study;
}

void tell_device_part(analysis::StudyResults& results, const core::StudyStore& store,
                      const analysis::StudyData& as_commanded, const MeasuredDevices& devices,
                      const analysis::ResultsOptions& options, bool leaves_out_inverted) {
  // Only the values of these results are needed.
  analysis::ResultsOptions quick = options;
  constexpr int kFewestResamples = 100;
  quick.num_resamples = kFewestResamples;
  const auto at = [&](const analysis::DeviceParts& parts) {
    return results_of_data(
        delivered_study(store, as_commanded, parts, leaves_out_inverted).data, quick);
  };
  tell_device_part(results, at(devices.least), at(devices.most));
}

std::vector<std::string> measured_device_words(const core::StudyStore& store,
                                               const MeasuredDevices& devices) {
  std::map<std::string, int> num_sessions;  // By the SHA-256 of the profile.
  for (const core::SessionRow& session : store.sessions()) {
    if (devices.parts.contains(session.session)) ++num_sessions[session.device_profile_sha256];
  }
  const auto value = [](const std::optional<experiments::MeasuredValue>& measured,
                        const char* unit) {
    if (!measured) return std::string("not measured");
    return fmt::format("{:.4g} ({:.4g} to {:.4g}){}", measured->value, measured->ci95[0],
                       measured->ci95[1], unit);
  };
  std::vector<std::string> words;
  for (const auto& [sha256, num] : num_sessions) {
    const experiments::DeviceProfile profile = stored_profile(store, sha256).profile;
    words.push_back(fmt::format(
        "{}{}{}, measured on {}: gain {}, own damping {}; {}.",
        profile.simulated ? "SIMULATED " : "", profile.device.model,
        profile.device.serial.empty() ? "" : " " + profile.device.serial, profile.measured_on,
        value(profile.force.gain, ""), value(profile.mechanics.damping_n_s_per_m, " N s/m"),
        analysis::counted_words(num, "session")));
  }
  return words;
}

void tell_device_part(analysis::StudyResults& results, const analysis::StudyResults& at_least,
                      const analysis::StudyResults& at_most) {
  const std::map<std::string, double> least = values_of(at_least), most = values_of(at_most);
  for (analysis::ResultsSection& section : results.sections) {
    for (Estimate& estimate : section.estimates) {
      const std::string name = section.name + "/" + estimate.name;
      const auto one = least.find(name), other = most.find(name);
      if (one == least.end() || other == most.end()) continue;
      estimate.device_ci95 = {.low = std::min(one->second, other->second),
                              .high = std::max(one->second, other->second)};
    }
  }
}

std::string device_part_table(const analysis::StudyResults& results) {
  std::string table;
  for (const analysis::ResultsSection& section : results.sections) {
    for (const Estimate& estimate : section.estimates) {
      if (!estimate.device_ci95.low || !estimate.value) continue;
      table += fmt::format("  {:<44} {:.4g} [{:.4g}, {:.4g}]\n", estimate.name, *estimate.value,
                           *estimate.device_ci95.low, *estimate.device_ci95.high);
    }
  }
  if (table.empty()) return table;
  return "\nopen through the device alone, 95 %\n" + table;
}

}  // namespace jnd::app
