#include "analysis/results/catch_results.h"

#include <algorithm>
#include <string>

#include "analysis/results/threshold_group.h"
#include "analysis/statistics/wilson_interval.h"
#include "analysis/words/said.h"

namespace jnd::analysis {
namespace {

/// One participant's answers to trials in which test and reference are equal.
struct CatchCounts {
  int num_trials = 0;
  /// The number of trials in which the test was called more, or its interval was chosen.
  int num_test = 0;
  int num_intervals = 0;  ///< The number of trials with two intervals.
  int num_second = 0;     ///< The number of these in which the second interval was chosen.
};

CatchCounts counts_of(const ParticipantData& participant, const std::string& block) {
  CatchCounts counts;
  for (const core::TrialRow& trial : participant.catch_trials) {
    if (trial.block != block || !trial.response) continue;
    const bool test = *trial.response > 0.5;
    ++counts.num_trials;
    counts.num_test += test ? 1 : 0;
    if (!trial.test_interval) continue;
    ++counts.num_intervals;
    counts.num_second += test == (*trial.test_interval == 2) ? 1 : 0;
  }
  return counts;
}

/// Writes the section.
class CatchWriter {
 public:
  explicit CatchWriter(const BlockDesign& block)
      : block_(block.block), section_{.name = block.block + "_catch_trials"} {}

  void add(const std::string& participant, const CatchCounts& counts) {
    has_intervals_ = has_intervals_ || counts.num_intervals > 0;
    num_trials_ += counts.num_trials;
    num_test_ += counts.num_test;
    ++num_participants_;
    tell(participant, "num_catch_trials", counts.num_trials);
    if (counts.num_intervals == 0) {
      tell(participant, "num_false_alarms", counts.num_test);
      rate(participant, "false_alarm_rate", counts.num_test, counts.num_trials, tests_);
      return;
    }
    rate(participant, "catch_test_chosen_rate", counts.num_test, counts.num_trials, tests_);
    rate(participant, "catch_second_chosen_rate", counts.num_second, counts.num_intervals,
         seconds_);
  }

  [[nodiscard]] ResultsSection finish() && {
    total("num_catch_trials", num_trials_,
          said("trials of everybody in which the test equals the reference; they are in no "
               "curve"));
    if (has_intervals_) {
      add_mean_rate(
          section_,
          {.name = block_ + ".catch_test_chosen_rate",
           .meaning =
               said("interval drawn for the test chosen though both are equal: one half by "
                    "chance, unless something else tells them apart; mean over participants")},
          tests_);
      add_mean_rate(section_,
                    {.name = block_ + ".catch_second_chosen_rate",
                     .meaning = said("second interval chosen though both are equal: one half "
                                     "without a bias; mean over participants")},
                    seconds_);
      return std::move(section_);
    }
    total("num_false_alarms", num_test_, said("of these, the test was called more"));
    add_mean_rate(
        section_,
        {.name = block_ + ".false_alarm_rate",
         .meaning = said("test called more though it equals the reference: about one half of "
                         "those whose pse is at the reference; mean over participants")},
        tests_);
    return std::move(section_);
  }

 private:
  void tell(const std::string& participant, const std::string& name, double value,
            const Interval& ci95 = {}) {
    section_.participants.push_back({participant, block_ + "." + name, value, ci95, ""});
  }
  void rate(const std::string& participant, const std::string& name, int count, int num_trials,
            OwnNumbers& all) {
    all[participant] = static_cast<double>(count) / num_trials;
    const auto [low, high] = wilson_interval(count, num_trials);
    tell(participant, name, all[participant], {low, high});
  }
  void total(const std::string& name, int count, const std::string& meaning) {
    section_.estimates.push_back({.name = block_ + "." + name,
                                  .value = count,
                                  .unit = "1",
                                  .meaning = meaning,
                                  .n = num_participants_});
  }

  std::string block_;
  ResultsSection section_;
  OwnNumbers tests_, seconds_;
  int num_trials_ = 0, num_test_ = 0, num_participants_ = 0;
  bool has_intervals_ = false;
};

}  // namespace

bool has_catch_trials(const StudyData& data, const BlockDesign& block) {
  if (!block.compares()) return false;
  return std::ranges::any_of(data.participants, [&](const ParticipantData& one) {
    return counts_of(one, block.block).num_trials > 0;
  });
}

ResultsSection catch_results(const StudyData& data, const BlockDesign& block) {
  CatchWriter writer(block);
  for (const ParticipantData& participant : data.participants) {
    const CatchCounts counts = counts_of(participant, block.block);
    if (counts.num_trials > 0) writer.add(participant.participant, counts);
  }
  return std::move(writer).finish();
}

}  // namespace jnd::analysis
