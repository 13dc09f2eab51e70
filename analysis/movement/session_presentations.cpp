#include "analysis/movement/session_presentations.h"

#include <algorithm>
#include <charconv>
#include <map>
#include <set>

#include "analysis/data/json_fields.h"
#include "analysis/data/stored_studies.h"
#include "experiments/study/media.h"

namespace jnd::analysis {
namespace {

using nlohmann::json;

/// A block with more intensities has adjusted, not designed ones.
constexpr std::size_t kMostPlannedLevels = 32;

struct TrialPlan {
  core::DesignRow design;
  std::set<double> levels;      ///< The levels of its block.
  std::string standard_medium;  ///< The medium of the reference; "" if it is the block's own.
};

std::map<std::int64_t, TrialPlan> plans_of(const core::StudyStore& store,
                                           std::int64_t session) {
  std::map<std::int64_t, TrialPlan> plans;
  std::map<std::string, std::set<double>> levels;
  const std::string hash = store.session(session).protocol_sha256;
  StoredStudies studies(store);
  for (core::DesignRow& row : store.design(session)) {
    if (studies.block(hash, row.block).practice) continue;
    for (const std::optional<double>& level : {row.intensity, row.reference_intensity}) {
      if (level) levels[row.block].insert(*level);
    }
    plans[row.trial].design = std::move(row);
  }
  for (auto& [trial, plan] : plans) {
    plan.levels = levels[plan.design.block];
    plan.standard_medium = studies.block(hash, plan.design.block).standard_medium;
  }
  return plans;
}

PlannedPresentation planned(const core::PresentationRow& row, const TrialPlan& plan) {
  // A catch trial of a yes-no task is also free space.
  const bool is_free = row.interval == "free_space" ||
                       (plan.design.is_catch && !plan.design.reference_intensity);
  const bool is_standard = row.interval == "reference" && !plan.standard_medium.empty();
  const std::string medium = is_free       ? "free_space"
                             : is_standard ? plan.standard_medium
                                           : plan.design.medium;
  return {.movement = {.session = row.session,
                       .trial = row.trial,
                       .attempt = row.attempt,
                       .presentation = row.presentation,
                       .block = plan.design.block,
                       .medium = medium,
                       .interval = row.interval,
                       .repetition = plan.design.repetition,
                       .intensity = row.intensity,
                       .first_tick = row.first_tick,
                       .last_tick = row.last_tick},
          .commanded = {medium, row.intensity, row.measures.commanded_damping_n_s_per_m},
          .is_level = !is_free && plan.levels.size() <= kMostPlannedLevels &&
                      plan.levels.contains(row.intensity)};
}

void add_explored(const core::StudyStore& store, std::int64_t session,
                  std::vector<PlannedPresentation>& all) {
  const std::vector<core::EventRow> events = store.events(session);
  std::set<std::int64_t> superseded;
  for (const core::EventRow& event : events) {
    if (event.supersedes) superseded.insert(*event.supersedes);
  }
  for (const core::EventRow& event : events) {
    if (event.kind != "medium_explored" || superseded.contains(event.sequence)) continue;
    if (!event.first_tick || !event.last_tick) continue;
    const std::string medium = string_at(object_in(event.data), "medium");
    const double intensity = event.intensity.value_or(0.0);
    all.push_back({.movement = {.session = session,
                                .medium = medium,
                                .interval = "explored",
                                .intensity = intensity,
                                .first_tick = *event.first_tick,
                                .last_tick = *event.last_tick},
                   .commanded = {medium, intensity, std::nullopt},
                   .is_level = true});
  }
}

std::optional<double> number_at(const std::string& text, const char* pointer) {
  const json document = json::parse(text, nullptr, /*allow_exceptions=*/false);
  const json::json_pointer place(pointer);
  if (!document.is_object() || !document.contains(place)) return std::nullopt;
  const json& value = document.at(place);
  if (!value.is_number()) return std::nullopt;
  return value.get<double>();
}

}  // namespace

std::vector<PlannedPresentation> presentations_of(const core::StudyStore& store,
                                                  std::int64_t session, bool explored) {
  const std::map<std::int64_t, TrialPlan> plans = plans_of(store, session);
  std::vector<PlannedPresentation> all;
  for (const core::PresentationRow& row : store.presentations(session)) {
    const auto plan = plans.find(row.trial);
    // A solid is pressed, which is not analysed here.
    if (plan == plans.end() || experiments::is_pressed(plan->second.design.medium)) continue;
    all.push_back(planned(row, plan->second));
  }
  if (explored) add_explored(store, session, all);
  std::ranges::stable_sort(
      all, {}, [](const PlannedPresentation& one) { return one.movement.first_tick; });
  return all;
}

double ramp_s_of(const core::StudyStore& store, const core::SessionRow& session) {
  StoredStudies studies(store);
  return studies.study(session.protocol_sha256).device.ramp_s;
}

std::optional<double> surface_height_m_of(const core::SessionRow& session) {
  return number_at(session.laboratory, "/movement/surface_height_m/value");
}

std::optional<double> body_height_m_of(const core::StudyStore& store, std::int64_t session) {
  std::optional<double> found_m;  // The last one given counts.
  for (const core::AnswerRow& row : store.answers(session)) {
    if (row.item != "body_height_m") continue;
    double height_m = 0.0;
    const char* end = row.answer.data() + row.answer.size();
    const auto [stop, error] = std::from_chars(row.answer.data(), end, height_m);
    if (error == std::errc() && stop == end && height_m >= 0.5 && height_m <= 2.5) {
      found_m = height_m;
    }
  }
  return found_m;
}

}  // namespace jnd::analysis
