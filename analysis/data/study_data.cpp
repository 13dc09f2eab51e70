#include "analysis/data/study_data.h"

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>

#include "analysis/data/adaptive_runs.h"
#include "analysis/data/common_modulus.h"
#include "analysis/data/practice_runs.h"
#include "analysis/data/stored_studies.h"
#include "core/error.h"
#include "experiments/order/counterbalance.h"
#include "experiments/procedures/magnitude_estimation.h"
#include "experiments/procedures/procedure_registry.h"
#include "experiments/study/media.h"
#include "experiments/study/stage_walk.h"

namespace jnd::analysis {
namespace {

using nlohmann::json;

json parsed(const std::string& text, const std::string& place) {
  json value = json::parse(text, nullptr, /*allow_exceptions=*/false);
  if (!value.is_object()) throw core::Error(place + ": expected a JSON object, found none");
  return value;
}

ParticipantData& of(std::vector<ParticipantData>& participants, const std::string& name) {
  for (ParticipantData& known : participants) {
    if (known.participant == name) return known;
  }
  participants.push_back({.participant = name});
  return participants.back();
}

/// Which sessions are incomplete, and how many are not reported.
MissingSessions missing_sessions(const core::StudyStore& store, bool with_pilots) {
  MissingSessions missing{.num_withdrawn = std::ssize(store.withdrawals())};
  std::map<std::int64_t, core::SessionOverview> overview;
  for (const core::SessionOverview& one : store.overview()) overview[one.session] = one;
  for (const core::SessionRow& session : store.sessions()) {
    const core::SessionOverview& one = overview[session.session];
    if (session.pilot && !with_pilots) {
      ++missing.num_pilots;
    } else if (one.ended_early) {
      missing.ended_early.push_back(session.participant);
    } else if (!one.completed) {
      missing.open.push_back(session.participant);
    }
  }
  return missing;
}

std::set<std::string> all_stages(const experiments::Study& study) {
  std::set<std::string> names;
  for_each_stage(study.stages,
                 [&](const experiments::Stage& stage) { names.insert(stage.name); });
  return names;
}

/// The stages of a session with these cells. If the cells do not belong to the study, all
/// stages are returned, so that nothing is hidden.
std::set<std::string> stages_in(const experiments::Study& study, const std::string& cells) {
  try {
    std::set<std::string> names;
    for (const experiments::StageInstance& one :
         stages_of(study, experiments::cell_from_text(study, cells))) {
      names.insert(one.stage->name);
    }
    return names;
  } catch (const core::Error&) {
    return all_stages(study);
  }
}

/// Finds the stages that the study has but no session of a participant has.
void find_other_arms(StudyData& data, const core::StudyStore& store, StoredStudies& studies,
                     bool with_pilots) {
  std::set<std::string> all;
  std::map<std::string, std::set<std::string>> own;
  for (const core::SessionRow& session : store.sessions()) {
    if (session.pilot && !with_pilots) continue;
    const experiments::Study& study = studies.study(session.protocol_sha256);
    all.merge(all_stages(study));
    own[session.participant].merge(stages_in(study, session.cells));
  }
  for (ParticipantData& participant : data.participants) {
    std::ranges::set_difference(
        all, own[participant.participant],
        std::inserter(participant.of_other_arms, participant.of_other_arms.end()));
  }
}

std::vector<TakenLook> looks_of(const core::StudyStore& store) {
  std::map<std::int64_t, std::string> participants;
  for (const core::SessionRow& row : store.sessions()) {
    participants[row.session] = row.participant;
  }
  std::vector<TakenLook> looks;
  for (const core::SequentialLookRow& row : store.looks()) {
    TakenLook& look = looks.emplace_back();
    look.num_sessions = static_cast<int>(row.sessions.size());
    look.ended = row.decision == "stop";
    for (const std::int64_t session : row.sessions) {
      const auto known = participants.find(session);
      if (known != participants.end()) look.participants.push_back(known->second);
    }
  }
  return looks;
}

/// The index of each stage in its study file.
std::map<std::string, int> places_in(const experiments::Study& study) {
  std::map<std::string, int> places;
  for_each_stage(study.stages, [&](const experiments::Stage& stage) {
    places[stage.name] = static_cast<int>(places.size());
  });
  return places;
}

/// Fills in what a block measures, once its rows are known. If the study file lacks the block,
/// as in a study made by hand, its rows define it.
void say_what_it_measures(BlockDesign& block) {
  if (block.written.procedure.empty()) {
    block.written.procedure = block.procedure;
    block.written.medium = block.medium;
    block.written.quantity = block.quantity;
    block.written.reference_intensity = block.reference_intensity;
  }
  const experiments::Procedure& procedure = experiments::procedure_named(block.procedure);
  block.measures = procedure.measures(block.written);
  block.rule = procedure.rule();
}

}  // namespace

std::vector<core::TrialRow> ParticipantData::trials_in(const std::string& block) const {
  std::vector<core::TrialRow> found;
  for (const core::TrialRow& trial : trials) {
    if (trial.block == block) found.push_back(trial);
  }
  return found;
}

bool BlockDesign::counts_in_water() const {
  return modulus_of(written) == experiments::Modulus::kWater;
}

bool BlockDesign::counts_in_standard() const {
  return modulus_of(written) == experiments::Modulus::kStandard;
}

bool BlockDesign::counts_in_own_numbers() const {
  return modulus_of(written) == experiments::Modulus::kFree;
}

std::string BlockDesign::standard_quantity() const {
  return experiments::quantity_of(written.standard_medium);
}

StudyData load_study(const core::StudyStore& store, bool with_pilots) {
  StudyData data;
  const std::string place = store.folder().string();
  std::map<std::string, BlockDesign> blocks;
  StoredStudies studies(store);
  std::set<std::string> hashes;
  std::map<std::string, int> places;
  std::set<std::string> devices;
  for (const core::SessionRow& session : store.sessions()) {
    if (session.pilot && !with_pilots) continue;
    data.protocol_sha256 = session.protocol_sha256;
    data.simulated = data.simulated || session.simulated;
    devices.insert(session.device);
    data.device = devices.size() == 1 ? session.device : "";
    const std::string& hash = session.protocol_sha256;
    if (hashes.insert(hash).second) {
      merge_items(data.items, questionnaire_items(studies.study(hash)));
      for (const auto& [stage, its_place] : places_in(studies.study(hash))) {
        places[stage] = its_place;
      }
    }
    const auto is_practice = [&](const std::string& block) {
      return studies.block(hash, block).practice.has_value();
    };
    if (!session.laboratory.empty()) {
      const json laboratory = parsed(session.laboratory, place + ": laboratory");
      data.laboratory_text = session.laboratory;
      data.laboratory = laboratory.value("name", "");
      data.calibrated_on = laboratory.value("calibrated_on", std::vector<std::string>{});
      data.implied = laboratory.value("implied", std::vector<std::string>{});
    }
    std::map<std::int64_t, std::string> block_of_trial;
    std::map<std::string, std::int64_t> num_trials;
    for (const core::DesignRow& row : store.design(session.session)) {
      if (is_practice(row.block)) continue;
      block_of_trial[row.trial] = row.block;
      BlockDesign& block = blocks[row.block];
      block = {.block = row.block,
               .procedure = row.procedure,
               .quantity = row.quantity,
               .num_trials = std::max(block.num_trials, ++num_trials[row.block]),
               .reference_intensity = block.reference_intensity,
               .medium = row.medium,
               .written = studies.block(hash, row.block)};
    }
    ParticipantData& participant = of(data.participants, session.participant);
    if (!session.cells.empty()) participant.cells = session.cells;
    for (core::AnswerRow& answer : store.answers(session.session)) {
      participant.answers.push_back(std::move(answer));
    }
    for (core::QuestionAnswerRow& row : store.question_answers(session.session)) {
      if (!is_practice(row.block)) participant.question_answers.push_back(std::move(row));
    }
    std::set<std::int64_t> standing;
    for (core::TrialRow& trial : store.trials(session.session)) {
      standing.insert(trial.trial);
      if (is_practice(trial.block)) {
        participant.practice_trials.push_back(std::move(trial));
        continue;
      }
      if (trial.reference_intensity) {
        blocks[trial.block].reference_intensity = trial.reference_intensity;
      }
      auto& trials = trial.is_catch ? participant.catch_trials : participant.trials;
      trials.push_back(std::move(trial));
    }
    for (core::TrialRow& trial : store.trials(session.session, /*include_excluded=*/true)) {
      if (!standing.contains(trial.trial) && !trial.is_catch && !is_practice(trial.block)) {
        participant.excluded_trials.push_back(std::move(trial));
      }
    }
    for (TrialRecord& record : trial_records(store, session.session)) {
      if (!is_practice(record.block)) participant.records.push_back(std::move(record));
    }
    for (core::PresentationRow& row : store.presentations(session.session)) {
      const auto block = block_of_trial.find(row.trial);
      if (block == block_of_trial.end()) continue;
      participant.presentations[block->second].push_back(std::move(row));
    }
  }
  if (data.participants.empty()) {
    throw core::Error(place + ": expected sessions with participants, found none to analyse");
  }
  data.written = studies.study(data.protocol_sha256);
  data.study = data.written.name;
  std::sort(data.participants.begin(), data.participants.end(),
            [](const ParticipantData& a, const ParticipantData& b) {
              return a.participant < b.participant;
            });
  for (auto& [name, block] : blocks) data.blocks.push_back(std::move(block));
  std::ranges::stable_sort(data.blocks, {},
                           [&](const BlockDesign& block) { return places[block.block]; });
  for (BlockDesign& block : data.blocks) say_what_it_measures(block);
  data.sessions = missing_sessions(store, with_pilots);
  find_other_arms(data, store, studies, with_pilots);
  for (BlockDesign& block : data.blocks) bring_to_common_modulus(data, block);
  add_practice_runs(data, store, studies);
  add_adaptive_runs(data);
  data.looks = looks_of(store);
  data.unsealings = store.unsealings();
  return data;
}

void name_without_answers(std::vector<ExcludedParticipant>& excluded,
                          const ParticipantData& participant, const std::string& stage) {
  if (participant.of_other_arms.contains(stage)) return;
  const auto left_out = participant.left_out.find(stage);
  if (left_out != participant.left_out.end()) {
    excluded.push_back({participant.participant, left_out->second});
    return;
  }
  const std::vector<core::TrialRow> trials = participant.trials_in(stage);
  const bool are_open =
      !trials.empty() && std::ranges::none_of(trials, [](const core::TrialRow& trial) {
        return trial.response.has_value();
      });
  excluded.push_back(
      {participant.participant,
       (are_open ? "no answer but \"cannot tell\" in " : "no answers in ") + stage});
}

}  // namespace jnd::analysis
