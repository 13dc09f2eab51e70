#include "analysis/data/presentation_use.h"

#include <gtest/gtest.h>

#include "analysis/hand_made_study.h"
#include "analysis/results/study_results.h"

namespace jnd::analysis {
namespace presentation_use_test {

const ResultsOptions kQuick = {.num_resamples = 50, .seed = 1};

void present(HandMadeStudy& study, const std::string& block, const std::string& interval,
             double intensity, std::optional<double> width_m) {
  study.compare(block, 12.0, 8.0, true);
  study.move({.presentation = interval == "test" ? 2 : 1,
              .interval = interval,
              .intensity = intensity,
              .measures = {.num_strokes = width_m ? 1 : 0,
                           .stroke_width_m = width_m,
                           .max_speed_m_per_s = width_m}});
}

/// A study with wide strokes in references and narrow ones in tests. In group_e most tests have
/// no whole stroke.
class PresentationUses : public ::testing::Test {
 protected:
  PresentationUses() {
    for (const char* name : {"P01", "P02"}) {
      study_.add(name);
      const double more_m = name == std::string("P02") ? 0.1 : 0.0;
      present(study_, "group_d", "reference", 8.0, 0.6 + more_m);
      present(study_, "group_d", "test", 12.0, 0.4 + more_m);
      present(study_, "group_e", "reference", 8.0, 0.6 + more_m);
      present(study_, "group_e", "test", 12.0, std::nullopt);
      present(study_, "group_e", "test", 12.0, std::nullopt);
      present(study_, "group_e", "test", 5.0, 0.2 + more_m);
      present(study_, "group_e", "free_space", 0.0, std::nullopt);
    }
  }
  HandMadeStudy study_;
};

TEST_F(PresentationUses, AreCountedByBlockIntervalAndLevel) {
  const std::vector<PresentationUse> uses = presentation_uses(load_study(study_.store()));
  ASSERT_EQ(uses.size(), 5U) << "free space between stimuli is none";
  EXPECT_EQ(uses[0].block, "group_d");
  EXPECT_EQ(uses[0].interval, "reference");
  EXPECT_EQ(uses[0].num_presented, 2);
  EXPECT_EQ(uses[0].num_used, 2);
  EXPECT_NEAR(*uses[0].stroke_width_m, 0.65, 1e-12);
  EXPECT_EQ(uses[4].interval, "test");
  EXPECT_EQ(*uses[4].intensity, 12.0);
  EXPECT_EQ(uses[4].num_presented, 4);
  EXPECT_EQ(uses[4].num_used, 0);
  EXPECT_EQ(uses[4].num_participants, 0);
  EXPECT_FALSE(uses[4].stroke_width_m);
}

TEST_F(PresentationUses, LevelsThatPeopleSetThemselvesAreCountedTogether) {
  HandMadeStudy study;
  study.add("P01");
  for (int step = 0; step < 40; ++step) {
    present(study, "group_d", "test", 1.0 + 0.1 * step, 0.3);
  }
  const std::vector<PresentationUse> uses = presentation_uses(load_study(study.store()));
  ASSERT_EQ(uses.size(), 1U);
  EXPECT_FALSE(uses[0].intensity);
  EXPECT_EQ(uses[0].num_used, 40);
}

TEST_F(PresentationUses, IntervalsWeighEquallyBesideTheMeanOverAllPresentations) {
  const StudyResults of = results_of(load_study(study_.store()), {}, kQuick);
  // In group_e, one reference and one test of each person remain. In group_d there are as many
  // of both.
  EXPECT_NEAR(*of.find("stroke_width_m.group_d.equal_intervals")->value, 0.55, 1e-12);
  EXPECT_NEAR(*of.find("stroke_width_m.group_e.equal_intervals")->value, 0.45, 1e-12);
  EXPECT_NEAR(*of.find("stroke_width_m.group_d_minus_group_e.equal_intervals")->value, 0.1,
              1e-12);
  study_.add("P03");
  for (int time = 0; time < 3; ++time) present(study_, "group_d", "reference", 8.0, 0.9);
  present(study_, "group_d", "test", 12.0, 0.1);
  const StudyResults more = results_of(load_study(study_.store()), {}, kQuick);
  EXPECT_NEAR(*more.find("stroke_width_m.group_d")->value, (0.5 + 0.6 + 0.7) / 3.0, 1e-12);
  EXPECT_NEAR(*more.find("stroke_width_m.group_d.equal_intervals")->value,
              (0.5 + 0.6 + 0.5) / 3.0, 1e-12);
}

TEST(MovementResults, WithoutPresentationsNobodyIsBlamedForMissingStrokes) {
  HandMadeStudy study;
  study.add("P01");
  study.say("about", "age_years", "26");
  const ResultsSection section = movement_results(load_study(study.store()));
  EXPECT_TRUE(section.excluded.empty());
  EXPECT_TRUE(section.estimates.empty());
}

TEST(MovementResults, WhoHasNoWholeStrokeIsSaidToHaveNoneOfHowMany) {
  HandMadeStudy study;
  study.add("P01");
  present(study, "group_d", "test", 12.0, 0.3);
  study.add("P02");
  present(study, "group_d", "test", 12.0, std::nullopt);
  study.add("P03");
  study.compare("group_d", 12.0, 8.0, true);
  const ResultsSection section = movement_results(load_study(study.store()));
  ASSERT_GE(section.excluded.size(), 2U);
  EXPECT_EQ(section.excluded[0].participant, "P02");
  EXPECT_EQ(section.excluded[0].reason,
            "stroke_width_m: none of 1 presentation holds a whole stroke");
  EXPECT_EQ(section.excluded[1].reason, "stroke_width_m: no presentation of a stimulus");
}

}  // namespace presentation_use_test
}  // namespace jnd::analysis
