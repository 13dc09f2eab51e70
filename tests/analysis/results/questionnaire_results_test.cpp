#include "analysis/results/study_sections.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "analysis/found_results.h"
#include "analysis/hand_made_study.h"
#include "experiments/protocol/study_reader.h"

namespace jnd::analysis {
namespace questionnaire_results_test {

constexpr char kProtocol[] = R"json({"name": "asked", "stages": [
  {"kind": "checklist", "name": "before", "items": [{"text": {"en": "Ready?"}}]},
  {"kind": "counterbalance", "name": "order", "arms": [{"name": "one", "stages": [
     {"kind": "questionnaire", "name": "inner", "items": [
       {"name": "height_m", "kind": "number", "unit": "m", "question": {"de": "Wie groß?"}}]}]}],
   "between": [{"kind": "post_experiment", "name": "after", "items": [
       {"name": "is_solid", "medium": "solid", "answer": "yes_no", "question": {"en": "Solid?"}},
       {"name": "words", "medium": "solid", "answer": "words", "num_words": 3,
        "question": {"en": "Which words?"}}]}]},
  {"kind": "questionnaire", "name": "form", "items": [
    {"name": "safety", "kind": "scale", "high_is_good": false, "question": {"en": "Safe?"}},
    {"name": "freedom", "kind": "scale", "high_is_good": true, "num_steps": 4,
     "question": {"en": "Free?"}},
    {"name": "gender", "kind": "choice", "question": {"en": "Gender?"},
     "options": [{"value": "female"}, {"value": "male"}, {"value": "other"}]},
    {"name": "used", "kind": "yes_no_which", "question": {"en": "Used one?"}},
    {"name": "remarks", "kind": "text", "question": {"en": "Anything else?"}}]}]})json";

experiments::Study asked_study() {
  return experiments::study_as_written(kProtocol, "asked.json");
}

/// Collects people's answers to the items of the protocol above.
class Answers {
 public:
  Answers() { data_.items = questionnaire_items(asked_study()); }
  Answers& of(const std::string& participant) {
    data_.participants.push_back({.participant = participant});
    return *this;
  }
  Answers& say(const std::string& item, const std::string& answer) {
    for (const QuestionnaireItem& one : data_.items) {
      if (one.name != item) continue;
      data_.participants.back().answers.push_back(
          {.stage = one.stage, .item = item, .answer = answer});
    }
    return *this;
  }
  [[nodiscard]] ResultsSection results() const { return questionnaire_results(data_).value(); }

 private:
  StudyData data_;
};

TEST(QuestionnaireItems, AreFoundInEveryStageAndArmInTheOrderOfTheStudy) {
  const auto items = questionnaire_items(asked_study());
  ASSERT_EQ(items.size(), 8U);
  EXPECT_EQ(items[0].name, "height_m");
  EXPECT_EQ(items[0].unit, "m");
  EXPECT_EQ(items[0].question, "Wie groß?") << "the first language where there is no English";
  EXPECT_EQ(items[1].stage, "after");
  EXPECT_EQ(items[1].kind, "yes_no");
  EXPECT_EQ(items[3].name, "safety");
  EXPECT_EQ(items[3].num_steps, 10) << "as the format says";
  EXPECT_EQ(items[4].high_is_good, true);
  EXPECT_EQ(items[5].options, (std::vector<std::string>{"female", "male", "other"}));
}

TEST(QuestionnaireItems, TheLastVersionOfAStudyIsInForce) {
  auto items = questionnaire_items(asked_study());
  merge_items(items, {{.stage = "form", .name = "safety", .kind = "scale", .num_steps = 7},
                      {.stage = "form", .name = "new", .kind = "text"}});
  EXPECT_EQ(items.size(), 9U);
  EXPECT_EQ(items[3].num_steps, 7);
  EXPECT_EQ(items.back().name, "new");
}

TEST(QuestionnaireResults, ScalesAreTurnedSoThatOneIsTheWorst) {
  const ResultsSection section = Answers()
                                     .of("P01")
                                     .say("safety", "1")
                                     .say("freedom", "4")
                                     .of("P02")
                                     .say("safety", "2")
                                     .say("freedom", "1")
                                     .of("P03")
                                     .say("safety", "6")
                                     .say("freedom", "1")
                                     .results();
  // The steps are 10, 9 and 5 of ten, because step 1 was "very safe".
  EXPECT_DOUBLE_EQ(value_of(section, "questionnaire.safety"), 8.0);
  EXPECT_DOUBLE_EQ(value_of(section, "questionnaire.safety.sd"), std::sqrt(7.0));
  EXPECT_DOUBLE_EQ(value_of(section, "questionnaire.safety.median"), 9.0);
  EXPECT_DOUBLE_EQ(value_of(section, "questionnaire.freedom"), 2.0);
  EXPECT_NE(
      find_estimate(section, "questionnaire.freedom")->meaning.find("to 4, the best: Free?"),
      std::string::npos);
  const ParticipantEstimate& own = section.participants.front();
  EXPECT_EQ(own.participant, "P01");
  EXPECT_EQ(own.name, "questionnaire.safety");
  EXPECT_EQ(own.value, 10.0);
}

TEST(QuestionnaireResults, AScaleWithoutABetterEndIsToldAsItWasAsked) {
  const auto items = questionnaire_items(experiments::study_as_written(R"json({"stages": [
    {"kind": "questionnaire", "name": "form", "items": [
      {"name": "side", "kind": "scale", "num_steps": 7, "question": {"en": "Which side?"},
       "low_label": {"en": "left"}, "high_label": {"en": "right"}}]}]})json",
                                                                       "form.json"));
  ASSERT_EQ(items.size(), 1U);
  EXPECT_FALSE(items[0].high_is_good.has_value());
  StudyData data;
  data.items = items;
  data.participants.push_back({.participant = "P01"});
  data.participants.back().answers.push_back({.stage = "form", .item = "side", .answer = "2"});
  const ResultsSection section = questionnaire_results(data).value();
  const Estimate& mean = *find_estimate(section, "questionnaire.side");
  EXPECT_EQ(mean.value, 2.0) << "not turned round";
  EXPECT_EQ(mean.meaning, "mean step from 1, “left”, to 7, “right”: Which side?");
  for (const Estimate& estimate : section.estimates) {
    EXPECT_EQ(estimate.meaning.find("worst"), std::string::npos) << estimate.meaning;
  }
}

TEST(QuestionnaireResults, TheTableOfTheThesisComesOutAsPrinted) {
  // Schmidt (2018), table D.3, has thirteen participants, whose ratings go from 1 (worst) to 10
  // (best).
  const std::vector<std::pair<std::string, std::vector<int>>> kColumns = {
      {"safety", {10, 10, 10, 10, 10, 9, 10, 9, 10, 10, 9, 10, 9}},
      {"freedom", {7, 7, 5, 5, 5, 9, 7, 7, 10, 7, 7, 9, 6}},
      {"realism", {5, 5, 7, 3, 8, 8, 4, 3, 9, 6, 8, 10, 7}}};
  StudyData data;
  for (const auto& [name, ratings] : kColumns) {
    const bool high_is_good = name == "freedom";
    data.items.push_back({.stage = "form",
                          .name = name,
                          .kind = "scale",
                          .num_steps = 10,
                          .high_is_good = high_is_good});
    for (std::size_t i = 0; i < ratings.size(); ++i) {
      if (data.participants.size() <= i) data.participants.emplace_back();
      data.participants[i].participant = "P" + std::to_string(i + 1);
      const int printed = high_is_good ? ratings[i] : 11 - ratings[i];
      data.participants[i].answers.push_back(
          {.stage = "form", .item = name, .answer = std::to_string(printed)});
    }
  }
  const ResultsSection section = questionnaire_results(data).value();
  EXPECT_NEAR(value_of(section, "questionnaire.safety"), 9.69, 0.005);
  EXPECT_NEAR(value_of(section, "questionnaire.safety.sd"), 0.48, 0.005);
  EXPECT_NEAR(value_of(section, "questionnaire.freedom"), 7.00, 0.005);
  EXPECT_NEAR(value_of(section, "questionnaire.freedom.sd"), 1.58, 0.005);
  EXPECT_NEAR(value_of(section, "questionnaire.realism"), 6.38, 0.005);
  EXPECT_NEAR(value_of(section, "questionnaire.realism.sd"), 2.26, 0.005);
}

TEST(QuestionnaireResults, ChoicesAreCountedThoseThatNobodyTookToo) {
  const ResultsSection section = Answers()
                                     .of("P01")
                                     .say("gender", "female")
                                     .say("is_solid", "yes")
                                     .of("P02")
                                     .say("gender", "male")
                                     .say("is_solid", "no")
                                     .of("P03")
                                     .say("gender", "female")
                                     .say("is_solid", "yes")
                                     .of("P04")
                                     .say("gender", "once_offered")
                                     .results();
  EXPECT_EQ(value_of(section, "questionnaire.gender.female"), 2.0);
  EXPECT_EQ(value_of(section, "questionnaire.gender.other"), 0.0);
  EXPECT_EQ(value_of(section, "questionnaire.gender.once_offered"), 1.0);
  EXPECT_EQ(find_estimate(section, "questionnaire.gender.female")->n, 4);
  EXPECT_EQ(value_of(section, "questionnaire.is_solid.yes"), 2.0);
  EXPECT_EQ(find_estimate(section, "questionnaire.is_solid.no")->n, 3);
}

TEST(QuestionnaireResults, FreeAnswersAreListedAsTheyWereGiven) {
  const ResultsSection section = Answers()
                                     .of("P01")
                                     .say("used", "yes: a joystick, \"old\"")
                                     .of("P02")
                                     .say("used", "no")
                                     .say("remarks", "Nass wäre gut")
                                     .of("P03")
                                     .say("words", "hard, cold, flat")
                                     .say("used", "yes")
                                     .results();
  EXPECT_EQ(value_of(section, "questionnaire.used.yes"), 2.0);
  EXPECT_EQ(value_of(section, "questionnaire.used.no"), 1.0);
  ASSERT_EQ(section.free_answers.size(), 3U);
  EXPECT_EQ(section.free_answers[0].item, "words");
  EXPECT_EQ(section.free_answers[0].answer, "hard, cold, flat");
  EXPECT_EQ(section.free_answers[1].answer, "a joystick, \"old\"");
  EXPECT_EQ(section.free_answers[1].question, "Used one?");
  EXPECT_EQ(section.free_answers[2].participant, "P02");
}

TEST(QuestionnaireResults, WhatIsNoNumberIsSaidAndLeftOut) {
  const ResultsSection section = Answers()
                                     .of("P01")
                                     .say("height_m", "1.80")
                                     .of("P02")
                                     .say("height_m", "1,70")
                                     .of("P03")
                                     .say("height_m", "1.60")
                                     .results();
  EXPECT_DOUBLE_EQ(value_of(section, "questionnaire.height_m"), 1.7);
  EXPECT_DOUBLE_EQ(value_of(section, "questionnaire.height_m.minimum"), 1.6);
  EXPECT_DOUBLE_EQ(value_of(section, "questionnaire.height_m.maximum"), 1.8);
  EXPECT_EQ(find_estimate(section, "questionnaire.height_m")->unit, "m");
  EXPECT_EQ(section.participants[1].reason, "expected a number, found \"1,70\"");
  EXPECT_FALSE(section.participants[1].value);
}

TEST(QuestionnaireResults, NobodyAnsweringGivesNoNumberNeverZero) {
  const ResultsSection section = Answers().of("P01").say("remarks", "none").results();
  EXPECT_FALSE(find_estimate(section, "questionnaire.safety")->value);
  EXPECT_EQ(find_estimate(section, "questionnaire.safety")->n, 0);
  EXPECT_EQ(find_estimate(section, "questionnaire.height_m.minimum"), nullptr);
}

TEST(QuestionnaireResults, WhoAnsweredNothingIsNamedNobodyOnce) {
  const ResultsSection section = Answers()
                                     .of("P01")
                                     .say("remarks", "none")
                                     .say("height_m", "1.7")
                                     .of("P02")
                                     .say("remarks", "some")
                                     .results();
  ASSERT_EQ(section.excluded.size(), 2U);
  EXPECT_EQ(section.excluded[0].participant, "P02");
  EXPECT_EQ(section.excluded[0].reason, "no answers in inner");
  EXPECT_EQ(section.excluded[1].participant, "everyone");
  EXPECT_EQ(section.excluded[1].reason, "no answers in after");
}

TEST(QuestionnaireResults, AreReadFromTheStudyWithTheLastAnswerAndWithoutPilots) {
  HandMadeStudy study(kProtocol);
  study.add("P01", false, "", "order=one");
  study.say("form", "safety", "9");
  study.say("form", "safety", "3");
  study.say("before", "item_1", "done");
  study.add("P99", /*pilot=*/true);
  study.say("form", "safety", "10");
  const StudyData data = load_study(study.store());
  EXPECT_EQ(data.participants.size(), 1U);
  EXPECT_EQ(data.participants[0].cells, "order=one");
  const StudyResults results = results_of(data, {}, {.num_resamples = 100});
  EXPECT_EQ(results.find("questionnaire.safety")->value, 8.0);
  EXPECT_EQ(results.find("questionnaire.safety")->n, 1);
  EXPECT_EQ(results.find("questionnaire.item_1"), nullptr);
}

TEST(QuestionnaireResults, AStudyWithoutQuestionsHasNoSuchSection) {
  HandMadeStudy study;
  study.add("P01");
  study.estimate(1.0, 100.0);
  const StudyResults results =
      results_of(load_study(study.store()), {}, {.num_resamples = 100});
  EXPECT_EQ(std::ranges::count(results.sections, "questionnaires", &ResultsSection::name), 0);
}

}  // namespace questionnaire_results_test
}  // namespace jnd::analysis
