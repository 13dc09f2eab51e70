#include "experiments/protocol/starter_study.h"

#include <gtest/gtest.h>

#include "tests/experiments/protocol/broken_study.h"

namespace jnd::experiments {
namespace starter_study_test {

TEST(StarterStudy, HasNoProblemAndTheNameThatWasAskedFor) {
  const std::string text = starter_study("honey_and_oil");
  EXPECT_EQ(problems_of(text), "");
  EXPECT_EQ(read_study_text(text, "x").name, "honey_and_oil");
}

TEST(StarterStudy, AsksForTheNumbersThatItsModulusTakes) {
  const std::string text = starter_study("a");
  EXPECT_NE(text.find(R"("modulus": "free")"), std::string::npos);
  EXPECT_EQ(text.find("percent of"), std::string::npos);
  EXPECT_EQ(text.find("is 100 percent"), std::string::npos);
}

TEST(StarterStudy, ExplainsItselfInComments) {
  const std::string text = starter_study("a");
  int num_comments = 0;
  for (std::size_t at = text.find("\"comment\""); at != std::string::npos;
       at = text.find("\"comment\"", at + 1)) {
    ++num_comments;
  }
  EXPECT_GE(num_comments, 8);
}

TEST(RenamedStudy, ChangesTheNameAndNothingElse) {
  EXPECT_EQ(renamed_study(kSoundStudy, "x", "other"),
            broken("\"name\": \"sound\"", "\"name\": \"other\""));
}

TEST(RenamedStudy, FindsTheNameBehindOtherLettersOnItsLineAndHoweverItIsEscaped) {
  const std::string line =
      broken("  \"name\": \"sound\",", R"(  "comment": "ä \"sound\"", "name": "\u0073ound",)");
  EXPECT_EQ(
      renamed_study(line, "x", "other"),
      broken("  \"name\": \"sound\",", R"(  "comment": "ä \"sound\"", "name": "other",)"));
  const std::string marked = "\xEF\xBB\xBF" + kSoundStudy;
  EXPECT_EQ(read_study_text(renamed_study(marked, "x", "other"), "x").name, "other");
}

TEST(RenamedStudy, RefusesAStudyWithProblems) {
  EXPECT_THROW(static_cast<void>(renamed_study("{}", "x", "other")), ProtocolError);
}

}  // namespace starter_study_test
}  // namespace jnd::experiments
