#include "experiments/protocol/sequential_rules.h"

#include <gtest/gtest.h>

#include "experiments/designed_study.h"
#include "experiments/protocol/study_reader.h"
#include "tests/experiments/protocol/broken_study.h"

namespace jnd::experiments {
namespace sequential_rules_test {

std::string with_looks(const std::string& sequential) {
  return broken("\"factors\":", "\"sequential\": " + sequential + ", \"factors\":",
                designed_study(fluid_contrast()));
}

TEST(SequentialRules, TakeALookAtTheOnlyPrimaryContrast) {
  const std::string text =
      with_looks(R"({"contrast": "fluids", "looks": [8, 12, 20], "spending": "pocock"})");
  EXPECT_EQ(problems_of(text), "");
  const Study study = read_study_text(text, "x.json");
  ASSERT_TRUE(study.sequential);
  EXPECT_EQ(study.sequential->contrast, "fluids");
  EXPECT_EQ(study.sequential->looks, (std::vector<int>{8, 12, 20}));
  EXPECT_EQ(study.sequential->spending, AlphaSpending::kPocock);
}

TEST(SequentialRules, SpendAsOBrienAndFlemingWhereNothingIsSaid) {
  const Study study =
      read_study_text(with_looks(R"({"contrast": "fluids", "looks": [8, 12]})"), "x.json");
  EXPECT_EQ(study.sequential->spending, AlphaSpending::kObrienFleming);
  EXPECT_FALSE(read_study_text(designed_study(fluid_contrast()), "x.json").sequential);
}

TEST(SequentialRules, WantLooksThatAscend) {
  EXPECT_NE(problems_of(with_looks(R"({"contrast": "fluids", "looks": [8, 12, 12]})"))
                .find("/sequential/looks/2: expected more complete sessions than at the look "
                      "before, 12, found 12"),
            std::string::npos);
}

TEST(SequentialRules, WantTheContrastThatDecidesAloneInItsFamily) {
  const std::string text = broken(
      "\"factors\":", R"("sequential": {"contrast": "fluids", "looks": [8, 12]}, "factors":)",
      designed_study(fluid_contrast() + ", " + fluid_contrast("", "others")));
  EXPECT_NE(problems_of(text).find("found `others` in the family `primary`, too"),
            std::string::npos);
  const std::string apart = broken(
      "\"factors\":", R"("sequential": {"contrast": "fluids", "looks": [8, 12]}, "factors":)",
      designed_study(fluid_contrast(R"(, "family": "looks")") + ", " +
                     fluid_contrast("", "others")));
  EXPECT_EQ(problems_of(apart), "");
}

}  // namespace sequential_rules_test
}  // namespace jnd::experiments
