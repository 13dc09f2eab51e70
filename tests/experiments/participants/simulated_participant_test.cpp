#include "experiments/participants/simulated_participant.h"
#include "experiments/participants/thesis_laboratory.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

namespace jnd::experiments {
namespace simulated_participant_test {

QuestionnaireItem item(const char* name, const char* kind) {
  QuestionnaireItem made;
  made.name = name;
  made.kind = kind;
  return made;
}

TEST(SimulatedParticipant, IsAFunctionOfLaboratoryAndSeed) {
  const Laboratory here = thesis_laboratory();
  const SimulatedParticipant first(here, 9);
  const SimulatedParticipant again(here, 9);
  const SimulatedParticipant other(here, 10);
  EXPECT_EQ(first.home_height_m(), again.home_height_m());
  EXPECT_EQ(first.strokes("constant_stimuli").amplitude_m,
            again.strokes("constant_stimuli").amplitude_m);
  EXPECT_EQ(first.answer(item("age_years", "number")),
            again.answer(item("age_years", "number")));
  EXPECT_NE(first.person().body_height_m, other.person().body_height_m);
}

TEST(SimulatedParticipant, StrokesAsItsLaboratorySaysForEachProcedure) {
  Laboratory here = thesis_laboratory();
  for (auto& [procedure, habit] : here.strokes) habit.amplitude_sd_ln = 0.0;
  here.movement.max_speed_sd_ln = 0.0;
  const SimulatedParticipant participant(here, 1);
  for (const char* procedure :
       {"magnitude_estimation", "magnitude_production", "constant_stimuli", ""}) {
    const StrokeIntent intent = participant.strokes(procedure);
    const Laboratory::Strokes& habit = here.strokes_for(procedure);
    EXPECT_NEAR(intent.amplitude_m, habit.amplitude_m, 1e-12) << procedure;
    EXPECT_NEAR(intent.max_speed_m_per_s, here.movement.max_speed_m_per_s, 1e-12) << procedure;
    EXPECT_EQ(intent.num_strokes, habit.strokes_per_presentation) << procedure;
    // A sine of this amplitude has this highest speed.
    EXPECT_NEAR(intent.period_s,
                2.0 * std::numbers::pi * intent.amplitude_m / intent.max_speed_m_per_s, 1e-12);
  }
}

TEST(SimulatedParticipant, WhoStrokesWideDoesSoUnderEveryProcedure) {
  const Laboratory here = thesis_laboratory();
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    const SimulatedParticipant participant(here, seed);
    const bool wide = participant.person().amplitude_score > 0.0;
    for (const char* procedure : {"magnitude_estimation", "constant_stimuli"}) {
      EXPECT_EQ(
          participant.strokes(procedure).amplitude_m > here.strokes_for(procedure).amplitude_m,
          wide)
          << seed;
    }
  }
}

TEST(SimulatedParticipant, TheHandIsAlwaysInTheFluid) {
  const Laboratory here = thesis_laboratory();
  for (std::uint64_t seed = 1; seed <= 500; ++seed) {
    const SimulatedParticipant participant(here, seed);
    EXPECT_LT(participant.home_height_m(), 0.0) << seed;
    EXPECT_LT(participant.strokes("constant_stimuli").height_m, 0.0) << seed;
  }
}

TEST(SimulatedParticipant, AnswersWhatAQuestionAllows) {
  const Laboratory here = thesis_laboratory();
  QuestionnaireItem choice = item("sport", "choice");
  choice.options = {{.value = "none"}, {.value = "some"}, {.value = "much"}};
  QuestionnaireItem age = item("age_years", "number");
  age.minimum = 25;
  age.maximum = 30;
  QuestionnaireItem scale = item("comfort", "scale");
  scale.num_steps = 7;
  std::set<std::string> choices;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const SimulatedParticipant participant(here, seed);
    choices.insert(participant.answer(choice));
    const double years = std::stod(participant.answer(age));
    EXPECT_GE(years, 25.0);
    EXPECT_LE(years, 30.0);
    for (const bool high_is_good : {true, false}) {
      scale.high_is_good = high_is_good;
      const int step = std::stoi(participant.answer(scale));
      EXPECT_GE(step, 1);
      EXPECT_LE(step, 7);
    }
    const std::string yes_no = participant.answer(item("glasses", "yes_no"));
    EXPECT_TRUE(yes_no == "yes" || yes_no == "no") << yes_no;
    const std::string hand = participant.answer(item("handedness", "choice"));
    EXPECT_EQ(hand, participant.person().right_handed ? "right" : "left");
    EXPECT_NE(participant.answer(item("remarks", "text")), "");
  }
  EXPECT_EQ(choices, (std::set<std::string>{"none", "some", "much"}));
}

TEST(SimulatedParticipant, NamesAsManyWordsAsAreAskedFor) {
  const Laboratory here = thesis_laboratory();
  PostExperimentItem words;
  words.name = "honey";
  words.answer = "words";
  words.num_words = 3;
  const std::string answer = SimulatedParticipant(here, 1).answer(words);
  EXPECT_EQ(std::count(answer.begin(), answer.end(), ','), 2) << answer;
}

}  // namespace simulated_participant_test
}  // namespace jnd::experiments
