#include "analysis/results/discrimination_answers.h"

#include <gtest/gtest.h>

namespace jnd::analysis {
namespace discrimination_answers_test {

core::TrialRow answered(std::int64_t session, std::int64_t trial, std::int64_t first_tick) {
  return {.session = session,
          .trial = trial,
          .block = "group_d",
          .intensity = 4.0 + static_cast<double>(trial),
          .reference_intensity = 8.0,
          .response = 1.0,
          .first_tick = first_tick};
}

/// Returns the running numbers of the answers, in the order of `trials`.
std::vector<double> running_numbers(const std::vector<core::TrialRow>& trials) {
  StudyData data;
  data.participants.push_back({.participant = "P01", .trials = trials});
  std::vector<ExcludedParticipant> without_answers;
  const auto answers =
      discrimination_answers(data, {.block = "group_d"}, false, without_answers);
  std::vector<double> numbers;
  for (const OrderedAnswers& answer : answers.at(0).in_order) numbers.push_back(*answer.trial);
  return numbers;
}

TEST(DiscriminationAnswers, ATrialThatWasPutOffCountsWhereItWasRun) {
  // The second trial was postponed to the end. It was run as the fourth, and the third as the
  // second.
  EXPECT_EQ(running_numbers({answered(1, 1, 100), answered(1, 2, 900), answered(1, 3, 300),
                             answered(1, 4, 600)}),
            (std::vector<double>{1, 4, 2, 3}));
}

TEST(DiscriminationAnswers, NumbersOfASessionStayItsOwn) {
  // Ticks begin anew with each session. Numbers may have gaps, where other blocks came between.
  EXPECT_EQ(running_numbers({answered(1, 11, 500), answered(1, 12, 400), answered(2, 21, 200),
                             answered(2, 25, 100)}),
            (std::vector<double>{12, 11, 25, 21}));
}

TEST(DiscriminationAnswers, WhatWasRunInOrderKeepsItsNumbers) {
  EXPECT_EQ(running_numbers({answered(1, 3, 100), answered(1, 7, 200), answered(1, 8, 300)}),
            (std::vector<double>{3, 7, 8}));
}

TEST(DiscriminationAnswers, LeavingATrialOutMovesNoOtherInTime) {
  // The trials were run in the order 1, 3, 4, 2, and the third is excluded.
  StudyData data;
  data.participants.push_back(
      {.participant = "P01",
       .trials = {answered(1, 1, 100), answered(1, 2, 900), answered(1, 4, 600)},
       .excluded_trials = {answered(1, 3, 300)}});
  std::vector<ExcludedParticipant> without_answers;
  const auto answers =
      discrimination_answers(data, {.block = "group_d"}, false, without_answers);
  const std::vector<OrderedAnswers>& in_order = answers.at(0).in_order;
  EXPECT_EQ(*in_order[0].trial, 1.0);
  EXPECT_EQ(*in_order[1].trial, 4.0);
  EXPECT_EQ(*in_order[2].trial, 3.0);
}

}  // namespace discrimination_answers_test
}  // namespace jnd::analysis
