#include "analysis/data/study_data.h"

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>

#include "analysis/data/common_modulus.h"
#include "analysis/data/protocol_stages.h"
#include "core/error.h"

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

/// Which sessions did not come to their end, and how many are not told of.
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

/// What the study has and no session of each participant does.
void find_other_arms(StudyData& data, const core::StudyStore& store, bool with_pilots) {
  std::map<std::string, json> protocols;
  std::set<std::string> all;
  std::map<std::string, std::set<std::string>> own;
  for (const core::SessionRow& session : store.sessions()) {
    if (session.pilot && !with_pilots) continue;
    json& protocol = protocols[session.protocol_sha256];
    if (protocol.is_null()) {
      protocol = json::parse(store.protocol(session.protocol_sha256).text, nullptr, false);
      all.merge(stage_names(protocol));
    }
    own[session.participant].merge(stage_names_of(protocol, session.cells));
  }
  for (ParticipantData& participant : data.participants) {
    std::ranges::set_difference(
        all, own[participant.participant],
        std::inserter(participant.of_other_arms, participant.of_other_arms.end()));
  }
}

}  // namespace

std::vector<core::TrialRow> ParticipantData::trials_in(const std::string& block) const {
  std::vector<core::TrialRow> found;
  for (const core::TrialRow& trial : trials) {
    if (trial.block == block) found.push_back(trial);
  }
  return found;
}

StudyData load_study(const core::StudyStore& store, bool with_pilots) {
  StudyData data;
  const std::string place = store.folder().string();
  std::map<std::string, BlockDesign> blocks;
  std::map<std::string, std::map<std::string, ProtocolBlock>> protocols;  // By SHA-256.
  std::set<std::string> devices;
  for (const core::SessionRow& session : store.sessions()) {
    if (session.pilot && !with_pilots) continue;
    data.protocol_sha256 = session.protocol_sha256;
    data.simulated = data.simulated || session.simulated;
    devices.insert(session.device);
    data.device = devices.size() == 1 ? session.device : "";
    const auto [its_protocol, is_new] = protocols.try_emplace(session.protocol_sha256);
    if (is_new) {
      const json protocol =
          parsed(store.protocol(session.protocol_sha256).text, place + ": protocol");
      merge_items(data.items, questionnaire_items(protocol));
      its_protocol->second = protocol_blocks(protocol);
    }
    const auto is_practice = [&blocks = its_protocol->second](const std::string& block) {
      return blocks[block].is_practice;
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
               .protocol = its_protocol->second[row.block]};
    }
    ParticipantData& participant = of(data.participants, session.participant);
    if (!session.cells.empty()) participant.cells = session.cells;
    for (core::AnswerRow& answer : store.answers(session.session)) {
      participant.answers.push_back(std::move(answer));
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
  data.study =
      parsed(store.protocol(data.protocol_sha256).text, place + ": protocol").value("name", "");
  std::sort(data.participants.begin(), data.participants.end(),
            [](const ParticipantData& a, const ParticipantData& b) {
              return a.participant < b.participant;
            });
  for (auto& [name, block] : blocks) data.blocks.push_back(std::move(block));
  std::ranges::stable_sort(data.blocks, {},
                           [](const BlockDesign& block) { return block.protocol.place; });
  data.sessions = missing_sessions(store, with_pilots);
  find_other_arms(data, store, with_pilots);
  for (BlockDesign& block : data.blocks) bring_to_common_modulus(data, block);
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
  excluded.push_back({participant.participant, "no answers in " + stage});
}

}  // namespace jnd::analysis
