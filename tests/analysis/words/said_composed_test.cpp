#include "analysis/words/said_composed.h"

#include <gtest/gtest.h>

#include <string_view>

#include "analysis/words/said.h"

namespace said_composed_test {

using namespace jnd::analysis;

const char* a_little_german(const char* english) {
  const std::string_view text = english;
  if (text == "pse free, one lapse rate") return "PSE frei, eine Lapse-Rate";
  if (text == "{} nodes a dimension") return "{} Knoten je Dimension";
  if (text == "lapse rate {}") return "Lapse-Rate {}";
  if (text == "at its bound 0: none") return "an ihrer Grenze 0: keine";
  return english;
}

class SaidComposed : public testing::Test {
 protected:
  void SetUp() override {
    speak({.code = "de", .words = a_little_german, .decimal_comma = true});
  }
  void TearDown() override { speak({}); }
};

TEST_F(SaidComposed, TakesTheLongestPhrasesAndFillsTheirNumbers) {
  EXPECT_EQ(
      said_composed("pse free, one lapse rate, 9 nodes a dimension (at its bound 0: none)"),
      "PSE frei, eine Lapse-Rate, 9 Knoten je Dimension (an ihrer Grenze 0: keine)");
  EXPECT_EQ(said_composed("lapse rate 0.02"), "Lapse-Rate 0,02");
}

TEST_F(SaidComposed, LeavesWhatTheCatalogueDoesNotHave) {
  EXPECT_EQ(said_composed("P03: {odd} 0.5, (w), pse free"), "P03: {odd} 0.5, (w), pse free");
  EXPECT_EQ(said_composed(""), "");
  speak({});
  EXPECT_EQ(said_composed("lapse rate 0.02"), "lapse rate 0.02");
}

}  // namespace said_composed_test
