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
  /// To questions after the trials that stand, in the order of the sessions; of practice none.
  std::vector<core::QuestionAnswerRow> question_answers;
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
  Measure measures = Measure::kComparison;
  AdaptiveRule rule = AdaptiveRule::kNone;
  experiments::Block written{};  ///< As the study file has it.
  /// Where everybody chose their own numbers: by participant, ln of the number that their
  /// answers were divided by.
  std::map<std::string, double> own_log_moduli{};

  [[nodiscard]] bool estimates() const { return measures == Measure::kMagnitude; }
  [[nodiscard]] bool produces() const { return measures == Measure::kProducedMagnitude; }
  [[nodiscard]] bool matches() const { return measures == Measure::kMatch; }
  [[nodiscard]] bool identifies() const { return measures == Measure::kIdentification; }
  [[nodiscard]] bool rates() const { return measures == Measure::kRating; }
  /// Its answers have a psychometric function, whatever procedure chose the stimuli. Not where
  /// no trial with the reference was answered.
  [[nodiscard]] bool compares() const {
    return measures == Measure::kComparison && reference_intensity;
  }
  [[nodiscard]] bool detects() const { return measures == Measure::kDetection; }
  [[nodiscard]] bool tells_apart() const { return measures == Measure::kDifference; }
  [[nodiscard]] bool is_adaptive() const { return rule != AdaptiveRule::kNone; }
  /// Whether the study file lists the levels, so that everybody has answers at each; the other
  /// procedures go where the answers lead, with one or two at a level.
  [[nodiscard]] bool has_fixed_levels() const {
    return !is_adaptive() || rule == AdaptiveRule::kLimits;
  }
  /// An estimation in percent of water, which numbers of others compare with.
  [[nodiscard]] bool counts_in_water() const;
  /// An estimation in numbers that a standard was given.
  [[nodiscard]] bool counts_in_standard() const;
  /// An estimation in numbers of everybody's own.
  [[nodiscard]] bool counts_in_own_numbers() const;
  /// "scale": what its standards are; "" for a block without a standard.
  [[nodiscard]] std::string standard_quantity() const;
  /// Whether a test can equal the standard in number: both are of one quantity.
  [[nodiscard]] bool standard_is_of_its_quantity() const {
    return standard_quantity() == quantity;
  }
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

/// A look at a sequential study that was taken and told.
struct TakenLook {
  std::vector<std::string> participants;  ///< Who came to it since the look before, and stayed.
  int num_sessions = 0;  ///< That came to it; more than those where somebody withdrew since.
  bool ended = false;    ///< It was told to stop.
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
  experiments::Study written;                 ///< The study file of the last session.
  std::vector<BlockDesign> blocks;            ///< In the order of the study file.
  std::vector<QuestionnaireItem> items;       ///< In the order of the study file.
  std::vector<AdaptiveRun> runs;  ///< Of blocks whose procedure has a rule of its own.
  std::vector<PracticeRun> practice;
  std::vector<TakenLook> looks;                ///< Of a sequential study, in order.
  std::vector<core::UnsealingRow> unsealings;  ///< Of one that was opened before its end.

  /// Its rule has ended it, and that was told.
  [[nodiscard]] bool ended_by_rule() const { return !looks.empty() && looks.back().ended; }
};

/// Reads the folder's database. Nothing is computed yet, but that answers of an estimation come
/// in percent of their modulus (`bring_to_common_modulus`), and what the rules of adaptive
/// blocks and of practice make of the answers. Throws `Error` for a damaged study.
/// `with_pilots`: pilot sessions as well.
[[nodiscard]] StudyData load_study(const core::StudyStore& store, bool with_pilots = false);

/// Names a participant without answers in a block or a stage of questions, unless it belongs to
/// an arm that they were not in: then nothing is missing.
void name_without_answers(std::vector<ExcludedParticipant>& excluded,
                          const ParticipantData& participant, const std::string& stage);

}  // namespace jnd::analysis
