#include "app/preregistration/preregistration.h"

#include <algorithm>
#include <utility>

#include "analysis/results/number_words.h"
#include "core/error.h"
#include "core/storage/sha256.h"
#include "experiments/order/block_turns.h"
#include "experiments/study/stage_walk.h"

namespace jnd::app {
namespace {

using namespace experiments;
using Json = nlohmann::ordered_json;

/// The text in the study's first language, in which it is shown unless another one is chosen.
std::string shown(const Text& text, const Study& study) {
  const auto found = text.find(study.languages.front());
  return found == text.end() ? "" : found->second;
}

Json contrast_json(const Study& study, const PlannedContrast& plan) {
  Json of = Json::object();
  for (const auto& [factor, weights] : plan.weights) {
    for (const auto& [level, weight] : weights) of[factor][level] = weight;
  }
  Json json = {{"name", plan.name},
               {"hypothesis", shown(plan.hypothesis, study)},
               {"measure", to_string(plan.measure)}};
  if (!plan.question.empty()) json["question"] = plan.question;
  json.update({{"of", std::move(of)},
               {"role", plan.primary ? "primary" : "secondary"},
               {"direction", to_string(plan.direction)},
               {"smallest_effect", plan.smallest_effect ? Json(*plan.smallest_effect) : Json()},
               {"alpha", plan.alpha},
               {"family", plan.family},
               {"correction", to_string(plan.correction)}});
  return json;
}

Json sequential_json(const SequentialPlan& plan) {
  return {{"contrast", plan.contrast},
          {"looks", plan.looks},
          {"spending", to_string(plan.spending)}};
}

Json block_json(const Study& study, const Stage& stage, const Block& block) {
  Json levels = Json::object();
  for (const auto& [factor, level] : block.levels) levels[factor] = level;
  return {{"name", stage.name},
          {"procedure", block.procedure},
          {"medium", block.medium},
          {"quantity", block.quantity},
          {"intensities", block.intensities},
          {"reference", block.reference_intensity ? Json(*block.reference_intensity) : Json()},
          {"targets_percent", block.target_percent},
          {"standards", block.standards},
          {"repetitions", block.repetitions},
          {"levels", std::move(levels)},
          {"practice", block.practice.has_value()},
          {"question", shown(block.question, study)}};
}

std::string method_word(Counterbalance::Method method) {
  return method == Counterbalance::Method::kOneOf   ? "one_of"
         : method == Counterbalance::Method::kLatin ? "latin"
                                                    : "order";
}

std::string blinding_word(Blinding blinding) {
  return blinding == Blinding::kDouble        ? "double"
         : blinding == Blinding::kParticipant ? "participant"
                                              : "none";
}

/// Adds an interleaved block to its group; each group has one entry.
void add_to_group(const Stage& stage, Json& groups) {
  if (!stage.interleaving) return;
  if (groups.empty() || groups.back().at("name") != stage.interleaving->name) {
    groups.push_back({{"name", stage.interleaving->name},
                      {"turns", to_string(stage.interleaving->turns)},
                      {"blocks", Json::array()}});
  }
  groups.back()["blocks"].push_back(stage.name);
}

}  // namespace

Json planned_design(const Study& study) {
  Json factors = Json::array(), contrasts = Json::array(), blocks = Json::array();
  Json stages = Json::array(), arms = Json::array();
  for (const DesignFactor& factor : study.factors) {
    factors.push_back({{"name", factor.name}, {"levels", factor.levels}});
  }
  for (const PlannedContrast& plan : study.contrasts)
    contrasts.push_back(contrast_json(study, plan));
  Json groups = Json::array();
  for_each_stage(study.stages, [&](const Stage& stage) {
    stages.push_back(stage.name);
    add_to_group(stage, groups);
    if (const auto* block = std::get_if<Block>(&stage.content)) {
      blocks.push_back(block_json(study, stage, *block));
    }
    const auto* counterbalance = std::get_if<Counterbalance>(&stage.content);
    if (counterbalance == nullptr) return;
    Json names = Json::array();
    for (const Counterbalance::Arm& arm : counterbalance->arms) names.push_back(arm.name);
    arms.push_back({{"name", stage.name},
                    {"method", method_word(counterbalance->method)},
                    {"arms", std::move(names)},
                    {"stratify_by", counterbalance->stratify_by}});
  });
  Json design = {{"blinding", blinding_word(study.blinding)},
                 {"factors", std::move(factors)},
                 {"contrasts", std::move(contrasts)}};
  if (study.sequential) design["sequential"] = sequential_json(*study.sequential);
  design["counterbalances"] = std::move(arms);
  design["blocks"] = std::move(blocks);
  if (!groups.empty()) design["interleaved"] = std::move(groups);
  design["stages"] = std::move(stages);
  return design;
}

Preregistration preregistration_of(const Study& study, const std::string& study_file,
                                   const PlannedConduct& conduct, const Json& power,
                                   std::int64_t time_ns) {
  Json plan = {{"format", 1},
               {"study", study.name},
               {"study_file", study_file},
               {"study_sha256", core::sha256(study.text)},
               {"program_version", JND_VERSION},
               {"registered_on", analysis::date_words(time_ns)},
               {"registered_time_ns", time_ns},
               {"title", shown(study.title, study)},
               {"authors", study.authors},
               {"description", shown(study.description, study)},
               {"num_participants", conduct.num_participants},
               {"sample_rationale", conduct.rationale},
               {"exclusions", conduct.exclusions},
               {"stopping", conduct.stopping},
               {"device", conduct.device}};
  plan.update(planned_design(study));
  plan["power"] = Json::array();
  if (!power.is_object()) return plan;
  if (const Json looks = power.value("sequential", Json()); looks.is_object()) {
    plan["power"].push_back({{"participants", looks.at("looks").back()},
                             {"expected_participants", looks.at("expected_participants")},
                             {"test", looks.at("contrast")},
                             {"alpha", looks.at("alpha")},
                             {"power", looks.at("power")},
                             {"power_ci95", looks.at("power_ci95")},
                             {"laboratory", power.at("laboratory")},
                             {"runs", power.at("runs")}});
  }
  for (const Json& size : power.at("sizes")) {
    for (const Json& test : size.at("tests")) {
      plan["power"].push_back({{"participants", size.at("participants")},
                               {"test", test.at("name")},
                               {"alpha", test.value("alpha", 0.05)},
                               {"power", test.at("power")},
                               {"power_ci95", test.at("power_ci95")},
                               {"laboratory", power.at("laboratory")},
                               {"runs", power.at("runs")}});
    }
  }
  return plan;
}

std::optional<std::string> kept_preregistration(const core::StudyStore& store) {
  for (const core::ProtocolRow& row : store.protocols()) {
    if (row.file_name == kPreregistrationFile) return row.text;
  }
  return std::nullopt;
}

void keep_preregistration(core::StudyStore& store, const std::string& text) {
  if (const auto kept = kept_preregistration(store)) {
    if (*kept == text) return;
    throw core::Error(store.folder().string() +
                      ": expected a study without a preregistration, found one; what was "
                      "registered stays as it is");
  }
  const std::vector<core::SessionRow> sessions = store.sessions();
  const bool has_begun = std::ranges::any_of(
      sessions, [](const core::SessionRow& session) { return !session.pilot; });
  if (has_begun) {
    throw core::Error(store.folder().string() +
                      ": expected a study without sessions, found some; what is registered "
                      "after the first of them is no plan");
  }
  store.add_protocol(kPreregistrationFile, text);
}

}  // namespace jnd::app
