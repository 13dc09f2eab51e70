#include "app/commands/device_problems.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>
#include <utility>

#include "app/session/device_checks.h"
#include "app/session/device_limits.h"
#include "app/session/stability_limits.h"
#include "experiments/protocol/located_json.h"
#include "experiments/protocol/stimulus_place.h"
#include "experiments/protocol/study_reader.h"
#include "experiments/session/plan.h"

namespace jnd::app {
namespace {

using experiments::StudyProblem;

std::string too_strong(const experiments::RangeEntry& entry, const std::string& device,
                       const experiments::RangeLimits& limits, const std::string& own_limit) {
  return fmt::format(
      "expected a stimulus that `{}` can render at {:g} m/s (at most {:g} N at a point and "
      "{:g} N in all{}), found {:.3g} N at a point and {:.3g} N in all{}",
      device, limits.expected_speed_m_per_s, limits.max_force_per_point_n,
      limits.max_total_force_n, own_limit.empty() ? "" : "; " + own_limit,
      entry.largest_point_force_n, entry.total_force_n,
      entry.fits_up_to_m_per_s
          ? fmt::format("; it fits up to {:.2g} m/s", *entry.fits_up_to_m_per_s)
          : "");
}

std::string unstable(const StabilityCheck& check, const std::string& device) {
  return fmt::format(
      "expected a stimulus that {} ({} {} and {}), found one beyond; weaken it, or raise the "
      "study's rate",
      stably_words(check, device), check.measured.empty() ? "on the hand up to" : "up to",
      words_of(check.attached.viscosity_pa_s, "Pa s"),
      words_of(check.attached.stiffness_n_per_m, "N/m"));
}

/// Twice the total force of 30 N that the simulated devices give.
constexpr double kHardlyMeant_n = 60.0;

}  // namespace

std::vector<StudyProblem> force_doubts(const std::filesystem::path& study_file,
                                       double expected_speed_m_per_s) {
  const experiments::Study study = experiments::read_study(study_file);
  std::vector<StudyProblem> doubts;
  std::vector<StudyProblem> problems;
  const experiments::LocatedJson located(study.text, study_file.string(), problems);
  const experiments::RangeLimits limits{.max_force_per_point_n = kHardlyMeant_n,
                                        .max_total_force_n = kHardlyMeant_n,
                                        .expected_speed_m_per_s = expected_speed_m_per_s};
  for (const experiments::RangeEntry& entry : experiments::planned_range(study, limits)) {
    if (entry.fits) continue;
    const std::string pointer = stimulus_pointer(located.root(), entry.stage, entry.setting);
    const experiments::TextPosition at = located.value_position(pointer);
    doubts.push_back(
        {located.file(), at.line, at.column, pointer,
         fmt::format("this takes {:.3g} N on the whole hand{}, more than {:g} N; check "
                     "amount and unit, or by --device NAME whether a device can "
                     "render it",
                     entry.total_force_n,
                     entry.fits_up_to_m_per_s
                         ? fmt::format(" at {:g} m/s", expected_speed_m_per_s)
                         : "",
                     kHardlyMeant_n)});
  }
  return doubts;
}

std::vector<StudyProblem> device_problems(const std::filesystem::path& study_file,
                                          const std::string& device,
                                          const std::optional<KnownProfile>& profile,
                                          double expected_speed_m_per_s) {
  const experiments::Study study = experiments::read_study(study_file);
  std::vector<StudyProblem> problems;
  const experiments::LocatedJson located(study.text, study_file.string(), problems);
  const auto add = [&](const std::string& pointer, std::string message) {
    const experiments::TextPosition at = located.value_position(pointer);
    problems.push_back({located.file(), at.line, at.column, pointer, std::move(message)});
  };
  const DeviceLimits of_device = limits_of_device(device, study.device.rate_hz, profile);
  const device::DeviceCapabilities& capabilities = of_device.can;
  if (std::string missing =
          missing_points_words(device, capabilities, study.device.min_contact_points);
      !missing.empty()) {
    add("/device/min_contact_points", std::move(missing));
  }
  const experiments::RangeLimits limits = range_limits_of(capabilities, expected_speed_m_per_s);
  const std::vector<experiments::RangeEntry> range = experiments::planned_range(study, limits);
  const std::string own_limit = own_limit_words(device, capabilities);
  std::optional<StabilityCheck> stability;
  if (of_device.stability) {
    stability = check_stability(*of_device.stability, study, range, expected_speed_m_per_s);
  }
  for (std::size_t i = 0; i < range.size(); ++i) {
    const std::string pointer =
        stimulus_pointer(located.root(), range[i].stage, range[i].setting);
    if (!range[i].fits) add(pointer, too_strong(range[i], device, limits, own_limit));
    if (stability && !stability->is_stable[i]) add(pointer, unstable(*stability, device));
  }
  std::stable_sort(problems.begin(), problems.end(),
                   [](const StudyProblem& a, const StudyProblem& b) {
                     return std::tie(a.line, a.column) < std::tie(b.line, b.column);
                   });
  return problems;
}

}  // namespace jnd::app
