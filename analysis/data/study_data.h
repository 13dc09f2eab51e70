#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "analysis/data/adaptive_run.h"
#include "analysis/data/questionnaire_items.h"
#include "analysis/data/trial_records.h"
#include "core/storage/study_store.h"
#include "experiments/procedures/procedure.h"
#include "experiments/study/study.h"

namespace jnd::analysis {

using experiments::AdaptiveRule;
using experiments::Measure;

/// A participant whose answers a section of the results leaves out.
struct ExcludedParticipant {
  std::string participant;
  std::string reason;
};

/// One participant's data in a study: valid answers, and how the hand moved.
struct ParticipantData {
  std::string participant;
  std::vector<core::TrialRow> trials;  ///< Without catch trials and practice.
  /// They show how often "yes" is said without cause.
  std::vector<core::TrialRow> catch_trials;
  /// Trials that were set aside by hand but are otherwise complete.
  std::vector<core::TrialRow> excluded_trials;
  /// These are no data. They show how people learnt the task.
  std::vector<core::TrialRow> practice_trials;
  /// The presentations by block.
  std::map<std::string, std::vector<core::PresentationRow>> presentations;
  /// The records of every trial that was drawn, except practice.
  std::vector<TrialRecord> records;
  /// The counterbalancing cells, as a session stores them.
  std::string cells;
  /// Answers outside of trials, in the order of the sessions.
  std::vector<core::AnswerRow> answers;
  /// Answers to questions after valid trials, in the order of the sessions. Those of practice
  /// are left out.
  std::vector<core::QuestionAnswerRow> question_answers;
  /// Blocks and stages with questions that are in the study but in none of the participant's
  /// sessions, because they belong to another arm.
  std::set<std::string> of_other_arms;
  /// Blocks whose trials were all set aside by the analysis, with the reason.
  std::map<std::string, std::string> left_out{};

  [[nodiscard]] std::vector<core::TrialRow> trials_in(const std::string& block) const;
};

/// A block as it was drawn.
struct BlockDesign {
  std::string block;
  std::string procedure;
  std::string quantity;
  /// The number for one participant, and the largest number if they differ.
  std::int64_t num_trials = 0;
  std::optional<double> reference_intensity;
  std::string medium{};
  Measure measures = Measure::kComparison;
  AdaptiveRule rule = AdaptiveRule::kNone;
  experiments::Block written{};  ///< The block in the study file.
  /// If everybody chose their own numbers: for each participant, ln of the number by which the
  /// answers were divided.
  std::map<std::string, double> own_log_moduli{};

  [[nodiscard]] bool estimates() const { return measures == Measure::kMagnitude; }
  [[nodiscard]] bool produces() const { return measures == Measure::kProducedMagnitude; }
  [[nodiscard]] bool matches() const { return measures == Measure::kMatch; }
  [[nodiscard]] bool identifies() const { return measures == Measure::kIdentification; }
  [[nodiscard]] bool rates() const { return measures == Measure::kRating; }
  /// Whether the answers have a psychometric function, whatever procedure chose the stimuli. It
  /// is false if no trial with the reference was answered.
  [[nodiscard]] bool compares() const {
    return measures == Measure::kComparison && reference_intensity;
  }
  [[nodiscard]] bool detects() const { return measures == Measure::kDetection; }
  [[nodiscard]] bool tells_apart() const { return measures == Measure::kDifference; }
  [[nodiscard]] bool is_adaptive() const { return rule != AdaptiveRule::kNone; }
  /// Whether the study file lists the levels, so that everybody has answers at each. Other
  /// procedures follow the answers, and have one or two answers at a level.
  [[nodiscard]] bool has_fixed_levels() const {
    return !is_adaptive() || rule == AdaptiveRule::kLimits;
  }
  /// Whether it is an estimation in percent of water, with which other people's numbers can be
  /// compared.
  [[nodiscard]] bool counts_in_water() const;
  /// Whether it is an estimation relative to the number of a standard.
  [[nodiscard]] bool counts_in_standard() const;
  /// Whether it is an estimation in everybody's own numbers.
  [[nodiscard]] bool counts_in_own_numbers() const;
  /// The quantity of its standards, such as "scale"; "" for a block without a standard.
  [[nodiscard]] std::string standard_quantity() const;
  /// Whether the test and the standard are of one quantity, so that their numbers can be equal.
  [[nodiscard]] bool standard_is_of_its_quantity() const {
    return standard_quantity() == quantity;
  }
};

/// How one participant's practice ended.
struct PracticeRun {
  std::string participant, block;
  int num_trials = 0;
  /// The number of last answers that were judged, which is at most the number in the criterion.
  int num_judged = 0;
  int num_correct = 0;  ///< The number of right answers among those judged.
  bool criterion_met = false;
  std::string problem;  ///< Why success cannot be decided; "" if it can.
};

/// Sessions that are incomplete or not reported.
struct MissingSessions {
  std::vector<std::string> open, ended_early;  ///< The pseudonyms of their participants.
  /// The number of pilot sessions, which are left out.
  std::int64_t num_pilots = 0;
  /// The number of sessions of participants who withdrew, whose data are deleted.
  std::int64_t num_withdrawn = 0;
};

/// A look at a sequential study that was taken and reported.
struct TakenLook {
  /// The participants who took part since the look before and did not withdraw.
  std::vector<std::string> participants;
  /// The number of sessions at the look. It is larger than the number of participants if some
  /// have withdrawn since.
  int num_sessions = 0;
  bool ended = false;  ///< Whether the look reported that the study should stop.
};

/// A whole study, ready for analysis. Pilot sessions are left out. Of practice only its outcome
/// is kept.
struct StudyData {
  std::string study;  ///< The name in its file.
  std::string protocol_sha256;
  bool simulated = false;
  std::string laboratory_text;  ///< The whole laboratory file; "" with persons.
  std::string laboratory;       ///< The name of the laboratory; "" with persons.
  std::string device;           ///< The device of all sessions; "" if they had different ones.
  /// The names in that laboratory's file of values to which it was fitted, and of values that
  /// follow from these.
  std::vector<std::string> calibrated_on, implied;
  bool delivered = false;  ///< Whether intensities are delivered instead of commanded ones.
  MissingSessions sessions;
  std::vector<ParticipantData> participants;  ///< Sorted by pseudonym.
  experiments::Study written;                 ///< The study file of the last session.
  std::vector<BlockDesign> blocks;            ///< In the order of the study file.
  std::vector<QuestionnaireItem> items;       ///< In the order of the study file.
  std::vector<AdaptiveRun> runs;  ///< The runs of blocks whose procedure has its own rule.
  std::vector<PracticeRun> practice;
  std::vector<TakenLook> looks;  ///< The looks of a sequential study, in order.
  /// The unsealings of a study that was opened before its end.
  std::vector<core::UnsealingRow> unsealings;

  /// Whether its rule has ended it and a look has reported this.
  [[nodiscard]] bool ended_by_rule() const { return !looks.empty() && looks.back().ended; }
};

/// Reads the folder's database. It computes nothing except three things: answers of an
/// estimation become percent of their modulus (`bring_to_common_modulus`), and the rules of
/// adaptive blocks and of practice are applied to the answers. Throws `Error` for a damaged
/// study. `with_pilots` includes pilot sessions.
[[nodiscard]] StudyData load_study(const core::StudyStore& store, bool with_pilots = false);

/// Adds a participant without answers in a block or a stage with questions to `excluded`. It
/// does not if the block or stage belongs to another arm, because then nothing is missing.
void name_without_answers(std::vector<ExcludedParticipant>& excluded,
                          const ParticipantData& participant, const std::string& stage);

}  // namespace jnd::analysis
