#include "experiments/study/study_problem.h"

#include <gtest/gtest.h>

namespace jnd::experiments {
namespace study_problem_test {

TEST(StudyProblem, NamesFilePlacePointerAndMessage) {
  EXPECT_EQ(to_string({"a.json", 3, 7, "/stages/0/name", "expected this, found that"}),
            "a.json:3:7: /stages/0/name: expected this, found that");
}

TEST(StudyProblem, WritesTheWholeDocumentAsASlash) {
  EXPECT_EQ(to_string({"a.json", 1, 1, "", "expected this, found that"}),
            "a.json:1:1: /: expected this, found that");
}

TEST(StudyProblem, LeavesThePlaceOutWhereTheFileItselfIsMeant) {
  EXPECT_EQ(to_string({"a.json", 0, 0, "", "expected a file, found none"}),
            "a.json: expected a file, found none");
}

TEST(ProtocolError, CarriesAndTellsEveryProblem) {
  const ProtocolError error(
      {{"a.json", 1, 2, "/x", "first"}, {"a.json", 3, 4, "/y", "second"}});
  EXPECT_EQ(error.problems().size(), 2u);
  EXPECT_STREQ(error.what(), "a.json:1:2: /x: first\na.json:3:4: /y: second");
}

TEST(NearestWord, FindsTheKeyThatWasMeant) {
  const std::vector<std::string> keys = {"viscosity_pa_s", "reference_viscosity_pa_s", "scale"};
  EXPECT_EQ(nearest_word("viscosty_pa_s", keys), "viscosity_pa_s");
  EXPECT_EQ(nearest_word("sclae", keys), "scale");
  // A swap of two neighbours counts as one mistake.
  EXPECT_EQ(nearest_word("sya", {"say"}), "say");
  EXPECT_EQ(nearest_word("brake", {"block", "break"}), "break");
}

TEST(NearestWord, FindsTheKeyWhoseUnitWasLeftOut) {
  const std::vector<std::string> keys = {"reference_viscosity_pa_s", "viscosity_pa_s",
                                         "duration_s"};
  EXPECT_EQ(nearest_word("viscosity", keys), "viscosity_pa_s");
  EXPECT_EQ(nearest_word("reference", keys), "reference_viscosity_pa_s");
  EXPECT_EQ(nearest_word("duration", keys), "duration_s");
  EXPECT_EQ(nearest_word("visc", keys), "") << "no whole word of it";
}

TEST(NearestWord, FindsNothingWhereNothingIsNear) {
  EXPECT_EQ(nearest_word("colour", {"viscosity_pa_s", "scale"}), "");
  EXPECT_EQ(nearest_word("x", {"y"}), "");
  EXPECT_EQ(nearest_word("", {"scale"}), "");
  EXPECT_EQ(nearest_word(std::string(10000, 's'), {"scale"}), "");
  EXPECT_EQ(did_you_mean("colour", {"scale"}), "");
}

}  // namespace study_problem_test
}  // namespace jnd::experiments
