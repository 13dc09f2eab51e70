#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "analysis/data/adaptive_run.h"
#include "analysis/data/protocol_blocks.h"
#include "analysis/data/questionnaire_items.h"
#include "analysis/data/trial_records.h"
#include "core/storage/study_store.h"

namespace jnd::analysis {

/// Somebody whose answers a section of the results leaves out.
struct ExcludedParticipant {
  std::string participant;
  std::string reason;
};

/// What one participant left in a study: answers that stand, and how the hand moved.
struct ParticipantData {
  std::string participant;
  std::vector<core::TrialRow> trials;           ///< Catch trials and practice left out.
  std::vector<core::TrialRow> catch_trials;     ///< For how often "yes" is said without cause.
  std::vector<core::TrialRow> excluded_trials;  ///< Set aside by hand, otherwise complete.
  std::vector<core::TrialRow> practice_trials;  ///< No data: how people came to know the task.
  std::map<std::string, std::vector<core::PresentationRow>> presentations;  ///< By block.
  std::vector<TrialRecord> records;      ///< Of every trial that was drawn but for practice.
  std::string cells;                     ///< Counterbalancing, as a session keeps it.
  std::vector<core::AnswerRow> answers;  ///< Outside of trials, in the order of the sessions.
  /// Blocks and stages of questions of the study that none of their sessions has, for they were
  /// in another arm.
  std::set<std::string> of_other_arms;
  /// Blocks whose trials were all set aside by the analysis, and why.
  std::map<std::string, std::string> left_out{};

  [[nodiscard]] std::vector<core::TrialRow> trials_in(const std::string& block) const;
};

/// A block as it was drawn.
struct BlockDesign {
  std::string block;
  std::string procedure;
  std::string quantity;
  std::int64_t num_trials = 0;  ///< For one participant; the most of any, where they differ.
  std::optional<double> reference_intensity;
  std::string medium{};
  ProtocolBlock protocol{};
  /// Where everybody chose their own numbers: by participant, ln of the number that their
  /// answers were divided by.
  std::map<std::string, double> own_log_moduli{};

  /// An estimation in percent of water, which numbers of others compare with.
  [[nodiscard]] bool counts_in_water() const { return protocol.modulus == "water_is_100"; }
  /// Of every test stimulus it is asked whether it is more than a reference: its answers have a
  /// psychometric function, whatever procedure chose the stimuli.
  [[nodiscard]] bool compares() const {
    return reference_intensity && protocol.task != "same_different" &&
           protocol.task != "yes_no" && procedure != "magnitude_estimation" &&
           procedure != "magnitude_production" && procedure != "matching";
  }
  /// The test alone, and whether it is felt.
  [[nodiscard]] bool detects() const { return protocol.task == "yes_no"; }
  /// "Same" or "different" of two stimuli.
  [[nodiscard]] bool tells_apart() const { return protocol.task == "same_different"; }
};

/// How one participant's practice ended.
struct PracticeRun {
  std::string participant, block;
  int num_trials = 0;
  int num_judged = 0;   ///< The last answers, at most as many as the criterion is of.
  int num_correct = 0;  ///< Right answers among those judged.
  bool criterion_met = false;
  std::string problem;  ///< Why success cannot be told; "" if it can.
};

/// Sessions that did not come to their end, or that nothing is told of.
struct MissingSessions {
  std::vector<std::string> open, ended_early;  ///< By their participants' pseudonyms.
  std::int64_t num_pilots = 0;                 ///< Left out.
  std::int64_t num_withdrawn = 0;              ///< Of participants who withdrew: no data left.
};

/// A whole study, ready for analysis. Pilot sessions are left out, and practice but for how it
/// went.
struct StudyData {
  std::string study;  ///< Name in its file.
  std::string protocol_sha256;
  bool simulated = false;
  std::string laboratory_text;  ///< The whole file; "" with persons.
  std::string laboratory;       ///< Name; "" with persons.
  std::string device;           ///< Of all sessions; "" where they had different ones.
  std::vector<std::string> calibrated_on, implied;  ///< By that laboratory.
  bool delivered = false;  ///< Intensities are those that came out, not those commanded.
  MissingSessions sessions;
  std::vector<ParticipantData> participants;  ///< By pseudonym.
  std::vector<BlockDesign> blocks;            ///< In the order of the study file.
  std::vector<QuestionnaireItem> items;       ///< In the order of the study file.
  /// Of blocks whose procedure has a rule of its own; by whoever reads that from the study
  /// file.
  std::vector<AdaptiveRun> runs;
  std::vector<PracticeRun> practice;  ///< By the same.
};

/// Reads the folder's database. Nothing is computed yet, but that answers of an estimation come
/// in percent of their modulus (`bring_to_common_modulus`). Throws `Error` for a damaged study.
/// `with_pilots`: pilot sessions as well.
[[nodiscard]] StudyData load_study(const core::StudyStore& store, bool with_pilots = false);

/// Names a participant without answers in a block or a stage of questions, unless it belongs to
/// an arm that they were not in: then nothing is missing.
void name_without_answers(std::vector<ExcludedParticipant>& excluded,
                          const ParticipantData& participant, const std::string& stage);

}  // namespace jnd::analysis
