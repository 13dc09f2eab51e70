#include "app/results/results_output.h"

#include <cmath>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "analysis/data/study_data.h"
#include "analysis/results/published_comparison.h"
#include "app/command_line/command.h"
#include "app/preregistration/deviations.h"
#include "app/results/predictive_studies.h"
#include "app/results/published_words.h"
#include "app/session/shipped_files.h"
#include "app/session/stored_session.h"
#include "core/error.h"
#include "core/storage/sha256.h"
#include "core/storage/study_store.h"

namespace jnd::app {
namespace {

using analysis::Estimate;
using analysis::Interval;
using nlohmann::json;

json json_number(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? json(*value) : json(nullptr);
}

json interval(const Interval& ci95) {
  return json::array({json_number(ci95.low), json_number(ci95.high)});
}

json missing_json(const analysis::MissingSessions& sessions) {
  return {{"open", sessions.open},
          {"ended_early", sessions.ended_early},
          {"num_pilots_left_out", sessions.num_pilots},
          {"num_withdrawn", sessions.num_withdrawn}};
}

json losses_json(const std::vector<analysis::LevelLoss>& losses) {
  json levels = json::array();
  for (const analysis::LevelLoss& one : losses) {
    levels.push_back({{"block", one.block},
                      {"level", json_number(one.level)},
                      {"is_catch", one.is_catch},
                      {"num_drawn", one.num_drawn},
                      {"num_answered", one.num_answered},
                      {"num_set_aside", one.num_set_aside},
                      {"num_unanswered", one.num_unanswered()},
                      {"num_repeated", one.num_repeated},
                      {"num_discarded", one.num_discarded},
                      {"num_faulted", one.num_faulted},
                      {"num_limited", one.num_limited},
                      {"num_strokeless", one.num_strokeless},
                      {"num_affected", one.num_affected}});
  }
  return levels;
}

json preregistration_json(const analysis::PreregisteredStudy& plan) {
  if (plan.registered_on.empty()) return nullptr;
  json deviations = json::array();
  for (const analysis::Deviation& one : plan.deviations) {
    deviations.push_back(
        {{"topic", one.topic}, {"planned", one.planned}, {"found", one.found}});
  }
  return {{"registered_on", plan.registered_on},
          {"sha256", plan.sha256},
          {"deviations", std::move(deviations)}};
}

json contrast_test_json(const analysis::ContrastTest& test) {
  return {{"method", test.method},
          {"effect", json_number(test.effect)},
          {"ci95", interval(test.ci95)},
          {"statistic_name", test.statistic_name},
          {"statistic", json_number(test.statistic)},
          {"degrees_of_freedom", json_number(test.degrees_of_freedom)},
          {"p_value", json_number(test.p_value)},
          {"n", test.num_participants},
          {"reason", test.reason}};
}

json contrast_json(const analysis::ContrastResult& one) {
  const experiments::PlannedContrast& plan = one.plan;
  json otherwise = json::array();
  for (const analysis::ContrastTest& test : one.otherwise) {
    otherwise.push_back(contrast_test_json(test));
  }
  json excluded = json::array();
  for (const analysis::ExcludedParticipant& left_out : one.excluded) {
    excluded.push_back({{"participant", left_out.participant}, {"reason", left_out.reason}});
  }
  json equivalence = nullptr;
  if (one.equivalence) {
    equivalence = {{"margin", one.equivalence->margin},
                   {"interval", interval(one.equivalence->interval)},
                   {"confidence", 1.0 - 2.0 * plan.alpha},
                   {"p_value", one.equivalence->p_value},
                   {"is_shown", one.equivalence->is_shown}};
  }
  json contrast = contrast_test_json(one.test);
  contrast.update({{"name", plan.name},
                   {"measure", to_string(plan.measure)},
                   {"effect_is", is_ratio(plan.measure) ? "ratio" : "difference"},
                   {"hypothesis", one.hypothesis},
                   {"conditions", one.conditions},
                   {"primary", plan.primary},
                   {"family", plan.family},
                   {"correction", to_string(plan.correction)},
                   {"direction", to_string(plan.direction)},
                   {"alpha", plan.alpha},
                   {"p_value_adjusted", json_number(one.p_value_adjusted)},
                   {"equivalence", std::move(equivalence)},
                   {"otherwise", std::move(otherwise)},
                   {"excluded", std::move(excluded)},
                   {"cautions", one.cautions},
                   {"sentence", one.sentence}});
  if (!plan.question.empty()) contrast["question"] = plan.question;
  if (one.sequential) {
    contrast["sequential"] = {{"looks", one.sequential->looks},
                              {"nominal_levels", one.sequential->nominal_levels},
                              {"num_looks_taken", one.sequential->num_looks_taken},
                              {"num_participants", one.sequential->num_participants},
                              {"ended", one.sequential->ended},
                              {"significant", one.sequential->significant}};
  }
  return contrast;
}

/// The text of the shipped laboratory with this name; "" if there is none.
std::string shipped(const std::string& name) {
  std::ifstream file(shipped_folder() / "data" / "laboratories" / (name + ".json"),
                     std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

/// Checks the blocks to compare before any work is done: asking for blocks that do not exist is
/// a wrong use of the option.
void require_compared(const analysis::StudyData& data,
                      const analysis::ResultsOptions& options) {
  try {
    (void)analysis::compared_blocks(analysis::comparing_blocks(data), options.compared);
  } catch (const core::Error& error) {
    throw UsageError(error.what());
  }
}

/// Compares with the people given, or with the shipped ones; or says why there are none.
void compare_with_simulated(analysis::StudyResults& results, const analysis::StudyData& data,
                            const analysis::Published& published,
                            const analysis::PredictivePeople* people) {
  if (!data.simulated || published.num_participants < 1) return;
  if (data.delivered) {
    results.predictive.reason =
        "simulated studies are of commanded intensities, and these results of delivered ones";
    return;
  }
  std::optional<analysis::PredictivePeople> stored;
  if (people == nullptr) {
    stored = shipped_people({.study = data.study,
                             .study_sha256 = data.protocol_sha256,
                             .laboratory = data.laboratory,
                             .laboratory_sha256 = core::sha256(data.laboratory_text),
                             .device = data.device});
  }
  if (people == nullptr && !stored) {
    results.predictive.reason =
        "no simulated people are stored for this laboratory, study file and device; "
        "--predictive simulates some";
    return;
  }
  analysis::add_predictive(results, published, people == nullptr ? *stored : *people);
}

json predictive_json(const Estimate& estimate) {
  if (!estimate.predictive) return nullptr;
  const analysis::PredictiveTail& tail = *estimate.predictive;
  return {{"median", json_number(tail.median)},
          {"middle95", json::array({json_number(tail.low), json_number(tail.high)})},
          {"tail", tail.tail},
          {"side", tail.is_below ? "below" : "above"},
          {"tail_standard_error", tail.standard_error},
          {"num_studies", tail.values.size()}};
}

json joint_json(const std::optional<analysis::JointTail>& joint) {
  if (!joint) return nullptr;
  return {{"p_value", joint->p_value},
          {"standard_error", joint->standard_error},
          {"num_statistics", joint->num_statistics}};
}

json predictive_json(const analysis::Predictive& predictive) {
  return {{"num_people", predictive.num_people},
          {"num_studies", predictive.num_studies},
          {"num_participants", predictive.num_participants},
          {"joint", joint_json(predictive.joint)},
          {"joint_held_out", joint_json(predictive.joint_held_out)},
          {"reason", predictive.reason}};
}

}  // namespace

analysis::StudyResults results_of_folder(const std::filesystem::path& folder,
                                         const analysis::ResultsOptions& options) {
  const core::StudyStore store(folder, core::StudyStore::Mode::kReadOnly);
  require_results_open(store);
  const analysis::StudyData data = analysis::load_study(store);
  analysis::StudyResults results = results_of_data(data, options);
  results.preregistration = preregistered_study(store, data);
  return results;
}

analysis::StudyResults results_of_data(const analysis::StudyData& data,
                                       const analysis::ResultsOptions& options,
                                       const analysis::PredictivePeople* people) {
  require_compared(data, options);
  const analysis::Published published =
      analysis::published_for(data.study, shipped_folder() / "data" / "published");
  analysis::StudyResults results = analysis::results_of(data, published, options);
  results.laboratory_changed =
      data.simulated && data.laboratory_text != shipped(data.laboratory);
  compare_with_simulated(results, data, published, people);
  return results;
}

json results_json(const analysis::StudyResults& results) {
  json sections = json::array();
  for (const analysis::ResultsSection& section : results.sections) {
    json estimates = json::array();
    for (const Estimate& estimate : section.estimates) {
      const std::optional<bool> inside = holds_published(estimate);
      estimates.push_back(
          {{"name", estimate.name},
           {"value", json_number(estimate.value)},
           {"ci95", interval(estimate.ci95)},
           {"unit", estimate.unit},
           {"meaning", estimate.meaning},
           {"published", json_number(estimate.published)},
           {"published_sd", json_number(estimate.published_sd)},
           {"published_positive", estimate.published_positive},
           {"calibrated", estimate.calibrated},
           {"basis", results.simulated && estimate.is_published() ? json(basis_of(estimate))
                                                                  : json(nullptr)},
           {"published_inside_ci95", inside ? json(*inside) : json(nullptr)},
           {"published_statistic", estimate.published_statistic},
           {"published_z", json_number(estimate.published_z)},
           {"predictive_p",
            estimate.predictive ? json(estimate.predictive->p_value) : json(nullptr)},
           {"predictive", predictive_json(estimate)},
           {"primary", estimate.primary},
           {"n", estimate.n},
           {"reason", estimate.reason},
           {"cautions", estimate.cautions}});
      if (estimate.is_rejected_by_fit) estimates.back()["rejected_by_fit"] = true;
      if (estimate.device_ci95.low) {
        estimates.back()["ci95_device"] = interval(estimate.device_ci95);
      }
    }
    json comparisons = json::array();
    for (const analysis::NamedComparison& named : section.comparisons) {
      const analysis::Comparison& c = named.comparison;
      json statistics = json::object();
      for (const auto& [name, value] : c.all_statistics())
        statistics[name] = json_number(value);
      comparisons.push_back({{"name", named.name},
                             {"status", std::string(to_string(c.status))},
                             {"reason", c.reason},
                             {"method", c.method},
                             {"estimate", json_number(c.estimate)},
                             {"ci95", interval(c.ci95)},
                             {"statistic", json_number(c.statistic)},
                             {"statistic_name", c.statistic_name},
                             {"statistics", std::move(statistics)},
                             {"degrees_of_freedom", json_number(c.degrees_of_freedom)},
                             {"p_value", json_number(c.p_value)},
                             {"p_value_holm", json_number(named.p_value_holm)},
                             {"family", named.family},
                             {"primary", named.primary},
                             {"ratio_of", named.ratio_of},
                             {"ratio", json_number(named.ratio())},
                             {"ratio_ci95", interval(named.ratio_ci95())},
                             {"cautions", named.cautions},
                             {"cohen_dz", json_number(c.cohen_dz)},
                             {"cohen_dz_ci95", interval(c.cohen_dz_ci95)},
                             {"hedges_g", json_number(c.hedges_g)},
                             {"hedges_g_ci95", interval(c.hedges_g_ci95)},
                             {"rank_biserial", json_number(c.rank_biserial)},
                             {"rank_biserial_ci95", nullptr},
                             {"hodges_lehmann", json_number(c.hodges_lehmann)},
                             {"hodges_lehmann_ci95", interval(c.hodges_lehmann_ci95)},
                             {"n_a", c.num_a},
                             {"n_b", c.num_b}});
    }
    json participants = json::array();
    for (const analysis::ParticipantEstimate& own : section.participants) {
      participants.push_back({{"participant", own.participant},
                              {"name", own.name},
                              {"value", json_number(own.value)},
                              {"ci95", interval(own.ci95)},
                              {"reason", own.reason},
                              {"primary", own.primary},
                              {"cautions", own.cautions}});
    }
    json excluded = json::array();
    for (const analysis::ExcludedParticipant& one : section.excluded) {
      excluded.push_back({{"participant", one.participant}, {"reason", one.reason}});
    }
    json cautions = json::array();
    for (const analysis::Caution& one : section.cautions) {
      cautions.push_back({{"participant", one.participant}, {"caution", one.caution}});
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
                        {"free_answers", std::move(free_answers)},
                        {"cautions", std::move(cautions)}});
  }
  json contrasts = json::array();
  for (const analysis::ContrastResult& one : results.contrasts) {
    contrasts.push_back(contrast_json(one));
  }
  return {{"study", results.study},
          {"contrasts", std::move(contrasts)},
          {"preregistration", preregistration_json(results.preregistration)},
          {"simulated", results.simulated},
          {"laboratory", results.laboratory},
          {"laboratory_changed", results.laboratory_changed},
          {"citation", results.citation},
          {"num_participants", results.num_participants},
          {"sessions", missing_json(results.sessions)},
          {"predictive", predictive_json(results.predictive)},
          {"losses", losses_json(results.losses)},
          {"sections", std::move(sections)}};
}

}  // namespace jnd::app
