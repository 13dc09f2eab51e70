#include "analysis/results/discrimination_answers.h"

#include <utility>

#include "analysis/data/running_numbers.h"
#include "analysis/words/said.h"

namespace jnd::analysis {
namespace {

void add_answer(AnswerCount& count, double intensity, bool yes) {
  count.intensity = intensity;
  count.num_yes += yes ? 1 : 0;
  ++count.num_trials;
}

void add_trial(DiscriminationAnswers& answers, const core::TrialRow& trial,
               std::vector<core::TrialRow>& trials) {
  if (!trial.intensity || !trial.response || !trial.reference_intensity) return;
  trials.push_back(trial);
  const bool yes = *trial.response > 0.5;
  answers.reference = *trial.reference_intensity;
  add_answer(answers.levels[*trial.intensity], *trial.intensity, yes);
  const double order = order_of(trial.test_interval);
  AnswerCount& cell = answers.cells[{*trial.intensity, order}];
  add_answer(cell, *trial.intensity, yes);
  cell.order = order;
  std::optional<bool> first;
  if (trial.test_interval) first = *trial.test_interval == 1;
  answers.in_order.push_back(
      {.intensity = *trial.intensity, .num_yes = yes ? 1.0 : 0.0, .test_first = first});
}

}  // namespace

std::vector<AnswerCount> DiscriminationAnswers::rows() const {
  std::vector<AnswerCount> all;
  for (const auto& [key, cell] : cells) all.push_back(cell);
  return all;
}

std::vector<DiscriminationAnswers> discrimination_answers(
    const StudyData& data, const BlockDesign& block, bool with_excluded,
    std::vector<ExcludedParticipant>& excluded) {
  std::vector<DiscriminationAnswers> all;
  for (const ParticipantData& participant : data.participants) {
    DiscriminationAnswers answers{.participant = participant.participant};
    std::vector<core::TrialRow> trials;
    for (const core::TrialRow& trial : participant.trials_in(block.block)) {
      add_trial(answers, trial, trials);
    }
    for (const core::TrialRow& trial : participant.excluded_trials) {
      if (with_excluded && trial.block == block.block) add_trial(answers, trial, trials);
    }
    const auto numbers = running_numbers(participant, block.block);
    for (std::size_t i = 0; i < trials.size(); ++i) {
      answers.in_order[i].trial =
          static_cast<double>(numbers.at({trials[i].session, trials[i].trial}));
    }
    if (answers.levels.empty()) {
      name_without_answers(excluded, participant, block.block);
    } else {
      all.push_back(std::move(answers));
    }
  }
  return all;
}

std::vector<AnswerCount> with_half_an_answer(std::vector<AnswerCount> rows) {
  const auto factor = 2 * static_cast<std::int64_t>(rows.size());
  for (AnswerCount& row : rows) {
    row.num_yes = factor * row.num_yes + 1;
    row.num_trials = factor * row.num_trials + 2;
  }
  return rows;
}

PsychometricFit own_fit(const DiscriminationAnswers& answers, const OwnFitOptions& options) {
  const bool is_likelihood = options.method == PsychometricMethod::kMaximumLikelihood;
  std::vector<AnswerCount> rows = answers.rows();
  if (options.corrected) rows = with_half_an_answer(std::move(rows));
  return fit_psychometric(rows, {.reference = answers.reference,
                                 .method = options.method,
                                 .free_pse = options.free_pse,
                                 .by_order = is_likelihood,
                                 .diagnostics = options.num_goodness > 0,
                                 .num_goodness = options.num_goodness,
                                 .goodness_of_correlation = false,
                                 .num_calibration = options.num_calibration,
                                 .seed = options.seed,
                                 .intervals = options.intervals});
}

std::string why_no_pse(const PsychometricFit& fit) {
  if (fit.pse || fit.status != FitStatus::kOk) return fit.reason;
  // The last warning of such a fit names the order.
  return fit.warnings.empty() ? said("the answers do not bound it") : fit.warnings.back();
}

std::vector<ParticipantAnswers> participant_answers(
    const std::vector<DiscriminationAnswers>& all, const std::string& condition) {
  std::vector<ParticipantAnswers> answers;
  for (const DiscriminationAnswers& one : all) {
    answers.push_back({one.participant, condition, one.reference, one.rows()});
  }
  return answers;
}

}  // namespace jnd::analysis
