#include "analysis/results/unanswered_results.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "analysis/found_results.h"
#include "analysis/hand_made_study.h"
#include "analysis/results/study_sections.h"

namespace jnd::analysis {
namespace unanswered_results_test {

std::string protocol(const std::string& keys) {
  return R"json({"format": 1, "name": "by_hand", "languages": ["en"],
    "title": {"en": "By hand"}, "authors": ["A. Author"],
    "stages": [{"kind": "block", "name": "d", "procedure": "constant_stimuli",
      "medium": "viscous", "viscosity_pa_s": [4, 6, 10, 16], "reference_viscosity_pa_s": 8,
      "repetitions": 10, "instruction": {"en": "Compare."}, "question": {"en": "Thicker?"},
      "expected_trial_s": 10)json" +
         keys + "}]}";
}

core::TrialRow row(double intensity, std::optional<double> response) {
  return {.block = "d",
          .procedure = "constant_stimuli",
          .medium = "viscous",
          .quantity = "viscosity_pa_s",
          .repetition = 1,
          .intensity = intensity,
          .reference_intensity = 8.0,
          .response = response,
          .measures = {.response_time_s = 2.0}};
}

/// Adds ten answers at each level, of which `num_yes` are yes, and `num_open` more with "cannot
/// tell".
void answer(HandMadeStudy& study, const std::vector<int>& num_yes, int num_open) {
  const std::vector<double> levels = {4, 6, 10, 16};
  for (std::size_t level = 0; level < levels.size(); ++level) {
    for (int i = 0; i < 10; ++i) {
      (void)study.answer(row(levels[level], i < num_yes[level] ? 1.0 : 0.0));
    }
  }
  for (int i = 0; i < num_open; ++i) (void)study.answer(row(6.0, std::nullopt));
}

StudyResults results(const HandMadeStudy& study) {
  return results_of(load_study(study.store()), {}, {.num_resamples = 5});
}

bool has_caution(const ResultsSection& section, const std::string& participant,
                 const std::string& words) {
  return std::ranges::any_of(section.cautions, [&](const Caution& one) {
    return one.participant == participant && one.caution.find(words) != std::string::npos;
  });
}

TEST(UnansweredResults, CountWhatCouldNotBeTold) {
  HandMadeStudy study(protocol(R"(, "cannot_tell": true)"));
  study.add("P01");
  answer(study, {0, 3, 7, 10}, 10);
  study.add("P02");
  answer(study, {0, 3, 7, 10}, 0);
  const auto section = unanswered_results(load_study(study.store()));
  ASSERT_TRUE(section);
  EXPECT_EQ(own_of(*section, "P01", "d.num_cannot_tell").value, 10.0);
  EXPECT_EQ(own_of(*section, "P02", "d.num_cannot_tell").value, 0.0);
  const Estimate* ratio = find_estimate(*section, "d.cannot_tell_ratio");
  ASSERT_NE(ratio, nullptr);
  EXPECT_NEAR(ratio->value.value(), 0.1, 1e-12) << "of 10 / 50 and of none";
  EXPECT_EQ(ratio->n, 2);
  EXPECT_EQ(ratio->ci95.low, 0.0) << "a share is none below 0";
  EXPECT_EQ(find_estimate(*section, "d.missed_deadline_ratio"), nullptr);
}

TEST(UnansweredResults, WhatCouldNotBeToldIsInNoCurve) {
  HandMadeStudy open(protocol(R"(, "cannot_tell": true)")), forced(protocol(""));
  for (HandMadeStudy* study : {&open, &forced}) {
    for (const char* who : {"P01", "P02", "P03"}) {
      study->add(who);
      answer(*study, {1, 3, 7, 9}, study == &open ? 10 : 0);
    }
  }
  const StudyResults a = results(open), b = results(forced);
  const ResultsSection& of_open = section_of(a, "d");
  for (const Estimate& estimate : section_of(b, "d").estimates) {
    const Estimate* same = find_estimate(of_open, estimate.name);
    ASSERT_NE(same, nullptr) << estimate.name;
    // A drift depends on the number of the trial, and open trials count there.
    if (estimate.name.find("drift") != std::string::npos) continue;
    EXPECT_EQ(same->value, estimate.value) << estimate.name;
  }
  EXPECT_TRUE(has_caution(of_open, "P02", "\"cannot tell\" in 10 of 50 answers"));
  EXPECT_TRUE(section_of(b, "d").cautions.empty());
}

TEST(UnansweredResults, ATenthIsNotOften) {
  HandMadeStudy study(protocol(R"(, "cannot_tell": true)"));
  study.add("P01");
  answer(study, {1, 3, 7, 9}, 4);  // These are 4 of 44.
  study.add("P02");
  answer(study, {1, 3, 7, 9}, 5);  // These are 5 of 45, which is more than a tenth.
  const StudyResults found = results(study);
  EXPECT_FALSE(has_caution(section_of(found, "d"), "P01", "cannot tell"));
  EXPECT_TRUE(has_caution(section_of(found, "d"), "P02", "cannot tell"));
}

TEST(UnansweredResults, WhoCouldTellNothingIsNamedWithTheReason) {
  HandMadeStudy study(protocol(R"(, "cannot_tell": true)"));
  study.add("P01");
  answer(study, {1, 3, 7, 9}, 0);
  study.add("P02");
  for (int i = 0; i < 4; ++i) (void)study.answer(row(6.0, std::nullopt));
  const StudyResults found = results(study);
  const ResultsSection& section = section_of(found, "d");
  ASSERT_FALSE(section.excluded.empty());
  EXPECT_EQ(section.excluded[0].participant, "P02");
  EXPECT_EQ(section.excluded[0].reason, "no answer but \"cannot tell\" in d");
}

TEST(UnansweredResults, CountAnswersThatMissedTheirDeadline) {
  HandMadeStudy study(protocol(R"(, "answer_deadline_s": 5)"));
  study.add("P01");
  answer(study, {1, 3, 7, 9}, 0);
  for (int i = 0; i < 10; ++i) {
    study.happen("attempt_discarded", 1, R"({"reason":"no answer","missed_deadline":true})");
  }
  study.happen("attempt_discarded", 2, R"({"reason":"paused"})");
  study.happen("attempt_discarded", 2, R"({"reason":"odd","missed_deadline":"yes"})");
  const StudyResults found = results(study);
  const ResultsSection& section = section_of(found, "unanswered");
  EXPECT_EQ(own_of(section, "P01", "d.num_missed_deadline").value, 10.0);
  EXPECT_NEAR(value_of(section, "d.missed_deadline_ratio"), 10.0 / 50.0, 1e-12);
  EXPECT_TRUE(has_caution(section_of(found, "d"), "P01", "10 answers missed the deadline"));
}

TEST(UnansweredResults, AreNoSectionWhereEveryAnswerIsAChoiceWithoutADeadline) {
  HandMadeStudy study(protocol(""));
  study.add("P01");
  answer(study, {1, 3, 7, 9}, 0);
  EXPECT_FALSE(unanswered_results(load_study(study.store())));
}

}  // namespace unanswered_results_test
}  // namespace jnd::analysis
