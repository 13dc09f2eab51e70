#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/data/compared_blocks.h"
#include "analysis/data/study_data.h"
#include "analysis/results/deviation.h"
#include "analysis/results/planned_contrasts.h"
#include "analysis/results/predictive.h"
#include "analysis/results/published.h"
#include "analysis/statistics/comparison.h"
#include "analysis/statistics/fit_status.h"
#include "core/progress.h"

namespace jnd::analysis {

/// One number of a study, with the published value if there is one.
struct Estimate {
  std::string name;  ///< For example "group_d.weber_fraction".
  std::optional<double> value;
  Interval ci95;
  /// For delivered intensities: the uncertainty from the measurement of the device alone. It is
  /// absent if the device was not measured.
  Interval device_ci95{};
  std::string unit;     ///< For example "1", "m", "m/s" or "Pa s".
  std::string meaning;  ///< What is estimated and how, in one phrase.
  std::optional<double> published;
  std::optional<double> published_sd;
  std::string published_place;      ///< The place in the publication.
  std::string published_statistic;  ///< How it was computed there and here.
  /// Whether it was published as above zero, without a number.
  bool published_positive = false;
  /// For means: the difference from the published mean in units of the joint standard error.
  std::optional<double> published_z;
  std::optional<PredictiveTail> predictive;  ///< Present if simulated people are available.
  /// Whether the simulated laboratory was fitted to its published value.
  bool calibrated = false;
  /// Whether it follows, nearly or entirely, from values to which the laboratory was fitted.
  bool implied = false;
  /// Whether it answers the question of its block; see `mark_primary`.
  bool primary = false;
  int n = 0;             ///< The number of participants on whom it rests.
  std::string reason{};  ///< Why there is no value; "" if there is one.
  /// There is no value because it is smaller than the stimuli can show.
  bool is_separated = false;
  /// Whether the answers lie farther from its curve than chance explains.
  bool is_rejected_by_fit = false;
  std::vector<std::string> cautions{};  ///< Reasons why it may be wrong for these data.

  /// Whether there is a published finding for comparison.
  [[nodiscard]] bool is_published() const { return published || published_positive; }
};

/// A reason to doubt numbers that a section reports.
struct Caution {
  /// The participant whose answers are concerned; "everyone" for the group.
  std::string participant;
  std::string caution;
};

/// One participant's own number, or why there is none.
struct ParticipantEstimate {
  std::string participant;
  std::string name;  ///< For example "group_d.weber_fraction".
  std::optional<double> value;
  Interval ci95;                        ///< The interval from this participant's answers alone.
  std::string reason;                   ///< Why there is no value; "" if there is one.
  std::vector<std::string> cautions{};  ///< Reasons why it may be wrong.
  bool primary = false;       ///< Whether it corresponds to the primary estimate of the group.
  bool is_separated = false;  ///< See `Estimate`.
};

/// A test between two conditions.
struct NamedComparison {
  std::string name;  ///< For example "group_d - group_e: ln ln(1 + w), paired".
  Comparison comparison;
  /// The p value adjusted by Holm (1979) for the tests of its family; absent if there was no
  /// adjustment.
  std::optional<double> p_value_holm;
  /// For example "exploratory, movement"; "" for a test that belongs to no family.
  std::string family;
  bool primary = false;  ///< Whether it answers what the study asks about its blocks together.
  std::vector<std::string> cautions{};  ///< Reasons why it may be wrong for these data.
  /// For a difference of logarithms: the quantity whose ratio its exponential is, such as "ln(1
  /// + w)". "" if the test is not about logarithms.
  std::string ratio_of{};

  /// The ratio that `ratio_of` names, which is 1 without an effect, and its 95 % interval. Rank
  /// tests use Hodges and Lehmann's estimate.
  [[nodiscard]] std::optional<double> ratio() const;
  [[nodiscard]] Interval ratio_ci95() const;
};

/// An answer in a participant's own words.
struct FreeAnswer {
  std::string participant;
  std::string item;      ///< For example "missing_sensations".
  std::string question;  ///< The question as it was asked.
  std::string answer;
};

/// The value of an estimate or of a participant's estimate; 0 if there is no estimate or no
/// value.
template <typename AnyEstimate>
[[nodiscard]] double value_or_0(const AnyEstimate* estimate) {
  return estimate == nullptr ? 0.0 : estimate->value.value_or(0.0);
}

struct ResultsSection {
  std::string name;  ///< For example "magnitude_estimation", "group_d" or "movement".
  /// For a block of comparisons: whether the pse of the primary value is free. Everybody's own
  /// Weber fraction that corresponds to it then has a free pse too. Otherwise the pse is at the
  /// reference.
  bool own_fractions_free_pse = false;
  std::vector<Estimate> estimates;
  std::vector<ParticipantEstimate> participants;
  std::vector<NamedComparison> comparisons;
  std::vector<ExcludedParticipant> excluded;
  std::vector<FreeAnswer> free_answers;
  std::vector<Caution> cautions{};
};

/// What happened to the trials of a block at one level. Losses need not be random.
struct LevelLoss {
  std::string block;
  /// The level as in `TrialRecord`. It is absent for all levels together, or if there is none.
  std::optional<double> level;
  bool is_catch = false;
  int num_drawn = 0, num_answered = 0, num_set_aside = 0;
  // Numbers of trials, each counted in every field that applies:
  int num_repeated = 0;    ///< The trial was run again after an undone answer or attempt.
  int num_discarded = 0;   ///< An attempt was given up because it was interrupted or invalid.
  int num_faulted = 0;     ///< The loop latched a fault during the trial.
  int num_limited = 0;     ///< The limiter changed the force of a stimulus.
  int num_strokeless = 0;  ///< Test or reference was not felt over a whole stroke.
  int num_affected = 0;    ///< Valid answers to which any of the above applies.

  [[nodiscard]] int num_unanswered() const noexcept {
    return num_drawn - num_answered - num_set_aside;
  }
  [[nodiscard]] bool is_any() const noexcept {
    return num_answered != num_drawn || num_repeated + num_faulted + num_affected > 0;
  }
};

/// All results that the design of a study calls for, as plain data. The command line, the
/// report and the window only show them.
struct StudyResults {
  std::string study;
  bool simulated = false;
  std::string laboratory;
  /// Whether it differs from the shipped laboratory of that name.
  bool laboratory_changed = false;
  std::string citation;  ///< The citation of the published values; "" without any.
  int num_participants = 0;
  MissingSessions sessions;
  std::vector<LevelLoss> losses;       ///< The losses at every level of every block.
  PreregisteredStudy preregistration;  ///< Filled in by callers that have the study folder.
  /// The contrasts that the study file plans, in its order.
  std::vector<ContrastResult> contrasts;
  std::vector<ResultsSection> sections;
  Predictive predictive;  ///< The simulated studies with which published values are compared.

  [[nodiscard]] const Estimate* find(const std::string& name) const;
};

struct ResultsOptions {
  int num_resamples = 1000;  ///< The number of resamples of participants for group intervals.
  std::uint64_t seed = 1;    ///< The seed of the resampling.
  /// The blocks whose Weber fractions are compared. If it is empty, `compared_blocks` chooses
  /// them.
  std::vector<BlockNames> compared{};
  core::Progress on_progress = {};  ///< Receives the progress of `results_of`.
};

/// Computes the results. Group intervals are percentiles over resampled participants, because a
/// likelihood interval of pooled answers would ignore that people differ. Throws `Error` as
/// `compared_blocks` does. Not real time.
[[nodiscard]] StudyResults results_of(const StudyData& data, const Published& published,
                                      const ResultsOptions& options = {});

/// The sections. There is one function for each kind of block; `results_of` calls those that
/// the design needs.
[[nodiscard]] ResultsSection estimation_results(const StudyData& data,
                                                const BlockDesign& design,
                                                const ResultsOptions& options);
[[nodiscard]] ResultsSection production_results(const StudyData& data,
                                                const BlockDesign& design,
                                                const ResultsOptions& options);
[[nodiscard]] ResultsSection matching_results(const StudyData& data, const BlockDesign& design,
                                              const ResultsOptions& options);
/// For blocks of ratings: mean and median at each stimulus, rank correlation and trend.
[[nodiscard]] ResultsSection rating_results(const StudyData& data, const BlockDesign& block);
/// The answers to the questions after the trials of a block, in the section BLOCK_questions.
/// `add_rated` describes the results of scales, numbers and yes-no questions. Choices have
/// shares of trials. Words are in `free_answers`. Participants who left answers out are named.
[[nodiscard]] ResultsSection question_results(const StudyData& data, const BlockDesign& block);
[[nodiscard]] ResultsSection combined_results(const StudyData& data,
                                              const BlockDesign& estimation,
                                              const BlockDesign& production,
                                              const ResultsOptions& options);
[[nodiscard]] ResultsSection discrimination_results(const StudyData& data,
                                                    const BlockDesign& block,
                                                    const ResultsOptions& options);
[[nodiscard]] ResultsSection discrimination_comparison(const StudyData& data,
                                                       const ComparedBlocks& blocks);
[[nodiscard]] ResultsSection movement_results(const StudyData& data);

/// One participant's mean over the presentations of test and reference that hold a whole
/// stroke. `movement_results` rests on it. `value` is a column such as stroke_width_m.
[[nodiscard]] std::optional<double> movement_mean(
    const std::vector<core::PresentationRow>& presentations,
    std::optional<double> core::PresentationMeasures::*value);

}  // namespace jnd::analysis
