#include "app/results_output.h"

#include <cmath>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "app/command.h"
#include "app/results_basis.h"
#include "app/session_setup.h"
#include "app/share.h"
#include "app/study_data.h"
#include "core/error.h"
#include "core/storage/study_store.h"

namespace jnd::app {
namespace {

using analysis::Estimate;
using analysis::Interval;
using nlohmann::json;

json number(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? json(*value) : json(nullptr);
}

json interval(const Interval& ci95) {
  return json::array({number(ci95.low), number(ci95.high)});
}

json missing_json(const analysis::MissingSessions& sessions) {
  return {{"open", sessions.open},
          {"ended_early", sessions.ended_early},
          {"num_pilots_left_out", sessions.num_pilots},
          {"num_withdrawn", sessions.num_withdrawn}};
}

/// Text of the shipped laboratory of this name; "" if there is none.
std::string shipped(const std::string& name) {
  std::ifstream file(share_folder() / "data" / "laboratories" / (name + ".json"),
                     std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

/// Before the work is done: what is asked for there is not is a wrong use of the option.
void require_compared(const analysis::StudyData& data,
                      const analysis::ResultsOptions& options) {
  try {
    (void)analysis::compared_blocks(analysis::comparing_blocks(data), options.compared);
  } catch (const core::Error& error) {
    throw UsageError(error.what());
  }
}

}  // namespace

analysis::StudyResults results_of_folder(const std::filesystem::path& folder,
                                         const analysis::ResultsOptions& options) {
  const core::StudyStore store(folder, core::StudyStore::Mode::kReadOnly);
  require_unblinded(store);
  return results_of_data(load_study_data(store), options);
}

analysis::StudyResults results_of_data(const analysis::StudyData& data,
                                       const analysis::ResultsOptions& options) {
  require_compared(data, options);
  analysis::StudyResults results = analysis::results_of(
      data, analysis::published_for(data.study, share_folder() / "data" / "published"),
      options);
  results.laboratory_changed =
      data.simulated && data.laboratory_text != shipped(data.laboratory);
  return results;
}

json to_json(const analysis::StudyResults& results) {
  json sections = json::array();
  for (const analysis::ResultsSection& section : results.sections) {
    json estimates = json::array();
    for (const Estimate& estimate : section.estimates) {
      const std::optional<bool> inside = holds_published(estimate);
      estimates.push_back(
          {{"name", estimate.name},
           {"value", number(estimate.value)},
           {"ci95", interval(estimate.ci95)},
           {"unit", estimate.unit},
           {"meaning", estimate.meaning},
           {"published", number(estimate.published)},
           {"published_sd", number(estimate.published_sd)},
           {"published_positive", estimate.published_positive},
           {"calibrated", estimate.calibrated},
           {"basis", results.simulated && estimate.is_published() ? json(basis_of(estimate))
                                                                  : json(nullptr)},
           {"published_inside_ci95", inside ? json(*inside) : json(nullptr)},
           {"primary", estimate.primary},
           {"n", estimate.n}});
    }
    json comparisons = json::array();
    for (const analysis::NamedComparison& named : section.comparisons) {
      const analysis::Comparison& c = named.comparison;
      comparisons.push_back({{"name", named.name},
                             {"status", std::string(to_string(c.status))},
                             {"reason", c.reason},
                             {"method", c.method},
                             {"estimate", number(c.estimate)},
                             {"ci95", interval(c.ci95)},
                             {"statistic", number(c.statistic)},
                             {"degrees_of_freedom", number(c.degrees_of_freedom)},
                             {"p_value", number(c.p_value)},
                             {"p_value_holm", number(named.p_value_holm)},
                             {"family", named.family},
                             {"primary", named.primary},
                             {"cohen_dz", number(c.cohen_dz)},
                             {"cohen_dz_ci95", interval(c.cohen_dz_ci95)},
                             {"hedges_g", number(c.hedges_g)},
                             {"hedges_g_ci95", interval(c.hedges_g_ci95)},
                             {"rank_biserial", number(c.rank_biserial)},
                             {"rank_biserial_ci95", nullptr},
                             {"hodges_lehmann", number(c.hodges_lehmann)},
                             {"hodges_lehmann_ci95", interval(c.hodges_lehmann_ci95)},
                             {"n_a", c.num_a},
                             {"n_b", c.num_b}});
    }
    json participants = json::array();
    for (const analysis::ParticipantEstimate& own : section.participants) {
      participants.push_back({{"participant", own.participant},
                              {"name", own.name},
                              {"value", number(own.value)},
                              {"ci95", interval(own.ci95)},
                              {"reason", own.reason}});
    }
    json excluded = json::array();
    for (const analysis::ExcludedParticipant& one : section.excluded) {
      excluded.push_back({{"participant", one.participant}, {"reason", one.reason}});
    }
    json free_answers = json::array();
    for (const analysis::FreeAnswer& one : section.free_answers) {
      free_answers.push_back({{"participant", one.participant},
                              {"item", one.item},
                              {"question", one.question},
                              {"answer", one.answer}});
    }
    sections.push_back({{"name", section.name},
                        {"estimates", std::move(estimates)},
                        {"participants", std::move(participants)},
                        {"comparisons", std::move(comparisons)},
                        {"excluded", std::move(excluded)},
                        {"free_answers", std::move(free_answers)}});
  }
  return {{"study", results.study},
          {"simulated", results.simulated},
          {"laboratory", results.laboratory},
          {"laboratory_changed", results.laboratory_changed},
          {"citation", results.citation},
          {"num_participants", results.num_participants},
          {"sessions", missing_json(results.sessions)},
          {"sections", std::move(sections)}};
}

}  // namespace jnd::app
