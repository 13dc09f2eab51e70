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

/// One number of a study, beside what was published.
struct Estimate {
  std::string name;  ///< "group_d.weber_fraction"
  std::optional<double> value;
  Interval ci95;
  /// Of intensities as delivered: what the measurement of the device leaves open, people aside;
  /// none where nothing was measured of it.
  Interval device_ci95{};
  std::string unit;     ///< "1", "m", "m/s", "Pa s".
  std::string meaning;  ///< What is estimated and how, in one phrase.
  std::optional<double> published;
  std::optional<double> published_sd;
  std::string published_place;      ///< Where it stands in the publication.
  std::string published_statistic;  ///< How it was computed there, and here.
  bool published_positive = false;  ///< Published as above zero, without a number.
  /// Of means: their difference in units of both standard errors, that of the published mean
  /// among them.
  std::optional<double> published_z;
  std::optional<PredictiveTail> predictive;  ///< Present where simulated people are known.
  bool calibrated = false;    ///< The simulated laboratory was fitted to its published value.
  bool implied = false;       ///< It follows, nearly or wholly, from values that were.
  bool primary = false;       ///< It answers what its block asks; see `mark_primary`.
  int n = 0;                  ///< Participants it rests on.
  std::string reason{};       ///< Why there is no value; "" if there is one.
  bool is_separated = false;  ///< There is none, for it is less than the stimuli can show.
  /// The answers lie farther from the curve that it is of than chance has them.
  bool is_rejected_by_fit = false;
  std::vector<std::string> cautions{};  ///< Why it may be wrong for these data, one each.

  /// Whether there is a published finding to compare with.
  [[nodiscard]] bool is_published() const { return published || published_positive; }
};

/// What makes numbers of a section doubtful, which have them nevertheless.
struct Caution {
  std::string participant;  ///< Whose answers; "everyone" of the group's.
  std::string caution;
};

/// One participant's own number, or why there is none.
struct ParticipantEstimate {
  std::string participant;
  std::string name;  ///< "group_d.weber_fraction"
  std::optional<double> value;
  Interval ci95;                        ///< Interval by this participant's answers alone.
  std::string reason;                   ///< Why there is no value; "" if there is one.
  std::vector<std::string> cautions{};  ///< Why it may be wrong, one each.
  bool primary = false;       ///< Of this person what the primary estimate is of the group.
  bool is_separated = false;  ///< As of `Estimate`.
};

/// A test between two conditions.
struct NamedComparison {
  std::string name;  ///< "group_d - group_e: ln ln(1 + w), paired"
  Comparison comparison;
  /// Adjusted by Holm (1979) for the tests of its family; absent where none was made.
  std::optional<double> p_value_holm;
  std::string family;    ///< "exploratory, movement"; "" with a test that stands alone.
  bool primary = false;  ///< It answers what the study asks of its blocks together.
  std::vector<std::string> cautions{};  ///< Why it may be wrong for these data, one each.
  /// What the exponential of a difference of logarithms is a ratio of, "ln(1 + w)"; "" where
  /// the test is about no logarithms.
  std::string ratio_of{};

  /// That ratio, 1 without an effect, and its 95 % interval: of rank tests by Hodges and
  /// Lehmann.
  [[nodiscard]] std::optional<double> ratio() const;
  [[nodiscard]] Interval ratio_ci95() const;
};

/// What a participant said in words of their own.
struct FreeAnswer {
  std::string participant;
  std::string item;      ///< "missing_sensations"
  std::string question;  ///< The question as it was asked.
  std::string answer;
};

/// Of an estimate or a participant's; 0 where there is none, or none with a value.
template <typename AnyEstimate>
[[nodiscard]] double value_or_0(const AnyEstimate* estimate) {
  return estimate == nullptr ? 0.0 : estimate->value.value_or(0.0);
}

struct ResultsSection {
  std::string name;  ///< "magnitude_estimation", "group_d", "movement" ...
  /// Of a block of comparisons: the primary value, and so everybody's own Weber fraction that
  /// stands for it, has the pse free; else it is at the reference.
  bool own_fractions_free_pse = false;
  std::vector<Estimate> estimates;
  std::vector<ParticipantEstimate> participants;
  std::vector<NamedComparison> comparisons;
  std::vector<ExcludedParticipant> excluded;
  std::vector<FreeAnswer> free_answers;
  std::vector<Caution> cautions{};
};

/// What happened to the trials of a block at one level: loss need not be random.
struct LevelLoss {
  std::string block;
  std::optional<double> level;  ///< As in `TrialRecord`; absent for all levels, or none.
  bool is_catch = false;
  int num_drawn = 0, num_answered = 0, num_set_aside = 0;
  // Trials, each counted wherever it belongs:
  int num_repeated = 0;    ///< Run again, for an answer was taken back or an attempt given up.
  int num_discarded = 0;   ///< An attempt was given up, interrupted or invalid.
  int num_faulted = 0;     ///< The loop latched a fault meanwhile.
  int num_limited = 0;     ///< The limiter changed the force of a stimulus.
  int num_strokeless = 0;  ///< Test or reference was never felt over a whole stroke.
  int num_affected = 0;    ///< Answers that count, with any of the above.

  [[nodiscard]] int num_unanswered() const noexcept {
    return num_drawn - num_answered - num_set_aside;
  }
  [[nodiscard]] bool is_any() const noexcept {
    return num_answered != num_drawn || num_repeated + num_faulted + num_affected > 0;
  }
};

/// Everything a study's design calls for, as plain data; the command line, the report and the
/// window only show it.
struct StudyResults {
  std::string study;
  bool simulated = false;
  std::string laboratory;
  bool laboratory_changed = false;  ///< It is not the shipped one of that name.
  std::string citation;             ///< Of the published values; "" without any.
  int num_participants = 0;
  MissingSessions sessions;
  std::vector<LevelLoss> losses;          ///< Losses at every level of every block.
  PreregisteredStudy preregistration;     ///< Filled by whoever has the study folder.
  std::vector<ContrastResult> contrasts;  ///< That the study file plans, in its order.
  std::vector<ResultsSection> sections;
  Predictive predictive;  ///< What published values are compared with.

  [[nodiscard]] const Estimate* find(const std::string& name) const;
};

struct ResultsOptions {
  int num_resamples = 1000;  ///< Resamples of participants, for group intervals.
  std::uint64_t seed = 1;    ///< Seed of the resampling.
  /// Blocks whose Weber fractions are compared; none: as `compared_blocks` chooses.
  std::vector<BlockNames> compared{};
  core::Progress on_progress = {};  ///< Of `results_of`.
};

/// Group intervals are percentiles over resampled participants: a likelihood interval of pooled
/// answers would ignore that people differ. Throws `Error` as `compared_blocks`. Not real time.
[[nodiscard]] StudyResults results_of(const StudyData& data, const Published& published,
                                      const ResultsOptions& options = {});

/// The sections, one function a kind of block; `results_of` calls what the design has.
[[nodiscard]] ResultsSection estimation_results(const StudyData& data,
                                                const BlockDesign& design,
                                                const ResultsOptions& options);
[[nodiscard]] ResultsSection production_results(const StudyData& data,
                                                const BlockDesign& design,
                                                const ResultsOptions& options);
[[nodiscard]] ResultsSection matching_results(const StudyData& data, const BlockDesign& design,
                                              const ResultsOptions& options);
/// Of blocks that rate: mean and median at each stimulus, rank correlation and trend.
[[nodiscard]] ResultsSection rating_results(const StudyData& data, const BlockDesign& block);
/// What was answered to the questions after the trials of a block, section BLOCK_questions; see
/// `add_rated` for scales, numbers and yes or no. Choices have shares of trials, words stand in
/// `free_answers`. Who left answers out is named.
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

/// One participant's mean over presentations of test and reference that hold a whole stroke:
/// what `movement_results` rests on. `value` is a column such as stroke_width_m.
[[nodiscard]] std::optional<double> movement_mean(
    const std::vector<core::PresentationRow>& presentations,
    std::optional<double> core::PresentationMeasures::*value);

}  // namespace jnd::analysis
