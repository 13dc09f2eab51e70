#include "analysis/results/threshold_answers.h"

#include <algorithm>

#include "analysis/results/discrimination_answers.h"

namespace jnd::analysis {
namespace {

void count(AnswerCount& row, double intensity, bool yes) {
  row.intensity = intensity;
  row.num_yes += yes ? 1 : 0;
  ++row.num_trials;
}

void add_trial(ThresholdAnswers& answers, const core::TrialRow& trial) {
  if (!trial.response) return;
  const bool yes = *trial.response > 0.5;
  const double nothing = trial.reference_intensity.value_or(0.0);
  const double intensity = trial.intensity.value_or(nothing);
  answers.reference = nothing;
  if (trial.is_catch || intensity == nothing) {
    count(answers.catches, nothing, yes);
  } else {
    count(answers.levels[intensity], intensity, yes);
  }
}

}  // namespace

std::vector<AnswerCount> ThresholdAnswers::rows() const {
  std::vector<AnswerCount> all;
  for (const auto& [intensity, row] : levels) all.push_back(row);
  return all;
}

std::vector<AnswerCount> ThresholdAnswers::rows_with_catches() const {
  std::vector<AnswerCount> all = rows();
  if (catches.num_trials > 0) all.push_back(catches);
  return all;
}

std::optional<SignalDetection> ThresholdAnswers::signal_detection() const {
  DetectionCounts counts{.num_false_alarms = catches.num_yes, .num_catch = catches.num_trials};
  for (const auto& [intensity, row] : levels) {
    counts.num_hits += row.num_yes;
    counts.num_signals += row.num_trials;
  }
  if (counts.num_catch == 0 || counts.num_signals == 0) return std::nullopt;
  return analysis::signal_detection(counts);
}

std::vector<ThresholdAnswers> threshold_answers(const StudyData& data, const BlockDesign& block,
                                                bool with_excluded,
                                                std::vector<ExcludedParticipant>& excluded) {
  std::vector<ThresholdAnswers> all;
  for (const ParticipantData& participant : data.participants) {
    ThresholdAnswers answers{.participant = participant.participant};
    const auto add_all = [&](const std::vector<core::TrialRow>& trials) {
      for (const core::TrialRow& trial : trials) {
        if (trial.block == block.block) add_trial(answers, trial);
      }
    };
    add_all(participant.trials);
    add_all(participant.catch_trials);
    if (with_excluded) add_all(participant.excluded_trials);
    if (answers.levels.empty()) {
      name_without_answers(excluded, participant, block.block);
    } else {
      all.push_back(std::move(answers));
    }
  }
  return all;
}

bool has_trials_set_aside(const StudyData& data, const BlockDesign& block) {
  return std::ranges::any_of(data.participants, [&](const ParticipantData& one) {
    return std::ranges::any_of(one.excluded_trials, [&](const core::TrialRow& trial) {
      return trial.block == block.block;
    });
  });
}

PsychometricFit own_detection_fit(const ThresholdAnswers& answers, bool corrected,
                                  int num_goodness, std::uint64_t seed) {
  std::vector<AnswerCount> rows = answers.rows();
  if (corrected) rows = with_half_an_answer(std::move(rows));
  // The reference only scales the search. The curve may lie anywhere.
  return fit_psychometric(rows, {.reference = rows.back().intensity,
                                 .free_pse = true,
                                 .diagnostics = num_goodness > 0,
                                 .num_goodness = num_goodness,
                                 .seed = seed,
                                 .intervals = !corrected});
}

}  // namespace jnd::analysis
