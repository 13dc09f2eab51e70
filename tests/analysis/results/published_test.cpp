#include "analysis/results/published.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "analysis/words/said.h"
#include "core/error.h"
#include "support/places.h"
#include "support/temporary_folder.h"

namespace jnd::analysis {
namespace published_test {

class PublishedTest : public ::testing::Test {
 protected:
  void write(const char* name, const char* text) const {
    std::ofstream(temporary_.path() / name) << text;
  }
  [[nodiscard]] Published found(const char* study) const {
    return published_for(study, temporary_.path());
  }
  test_support::TemporaryFolder temporary_;
};

TEST_F(PublishedTest, FindsAStudyInAnyFileOfTheFolder) {
  write("a.json", R"json({"citation":"A (1999)","studies":{"water":{"k":{"value":1}}}})json");
  write(
      "b.json",
      R"json({"citation":"B (2001)","studies":{"honey":{"w":{"value":0.3,"sd":0.1,"place":"p. 1"}}}})json");
  write("notes.txt", "not JSON");
  const Published honey = found("honey");
  EXPECT_EQ(honey.citation, "B (2001)");
  EXPECT_EQ(honey.values.at("w").value, 0.3);
  EXPECT_EQ(honey.values.at("w").standard_deviation, 0.1);
  EXPECT_EQ(honey.values.at("w").place, "p. 1");
  EXPECT_FALSE(found("water").values.at("k").standard_deviation);
  EXPECT_FALSE(found("water").values.at("k").positive);
}

TEST_F(PublishedTest, AnUnknownStudyOrFolderHasNone) {
  EXPECT_TRUE(found("water").values.empty());
  EXPECT_TRUE(published_for("water", temporary_.path() / "none").values.empty());
}

TEST_F(PublishedTest, AFileThatCannotBeReadAsPublishedValuesIsNamed) {
  for (const char* text : {"{", "[]", "{}", R"({"studies":{"water":{"k":{"value":1}}}})",
                           R"({"citation":"A","studies":{"water":{"k":{}}}})",
                           R"({"citation":"A","studies":{"water":{"k":{"positive":1}}}})",
                           R"({"citation":"A","studies":{"water":{"k":{"value":"one"}}}})",
                           R"({"citation":"A","studies":{"water":{"k":{"value":1,
                               "compute":{"kind":"guess"}}}}})",
                           R"({"citation":"A","studies":{"water":{"k":{"value":1,
                               "compute":{"kind":"numbers","names":["a"],"summary":"mode"}}}}})",
                           R"({"citation":"A","studies":{"water":{"k":{"value":1,
                               "compute":{"kind":"own_weber_fractions"}}}}})",
                           R"({"citation":"A","studies":{"water":{"k":{"value":1,
                               "compute":{"kind":"difference_of_means","names":["a"]}}}}})"}) {
    write("a.json", text);
    try {
      (void)found("water");
      ADD_FAILURE() << "expected an error for " << text;
    } catch (const core::Error& error) {
      EXPECT_NE(std::string(error.what()).find("a.json"), std::string::npos) << error.what();
    }
  }
}

TEST_F(PublishedTest, TellsHowAValueWasComputed) {
  write("a.json", R"json({"citation":"A","participants":13,"studies":{"honey":{"ratio":{
      "value":1.97,"decimals":2,"sd":0.34,"n":12,"unit":"m","statistic":"mean of ratios",
      "compute":{"kind":"production_ratio","block":"p","high":100,"low":50,"summary":"sd"},
      "follows_from_others":true}}}})json");
  const Published published = found("honey");
  EXPECT_EQ(published.num_participants, 13);
  const PublishedValue& ratio = published.values.at("ratio");
  EXPECT_EQ(ratio.num_decimals, 2);
  EXPECT_EQ(ratio.n, 12);
  EXPECT_EQ(ratio.unit, "m");
  EXPECT_EQ(ratio.statistic, "mean of ratios");
  EXPECT_TRUE(ratio.follows_from_others);
  ASSERT_TRUE(ratio.compute);
  EXPECT_EQ(ratio.compute->kind, PublishedStatistic::Kind::kProductionRatio);
  EXPECT_EQ(ratio.compute->summary, PublishedStatistic::Summary::kStandardDeviation);
  EXPECT_EQ(ratio.compute->high_target, 100.0);
  EXPECT_EQ(ratio.compute->low_target, 50.0);
}

TEST_F(PublishedTest, TellsHowAValueWasComputedInTheLanguageOfTheReport) {
  write("a.json", R"json({"citation":"A","studies":{"honey":{"ratio":{"value":2,
      "statistic":{"en":"mean of ratios","de":"Mittelwert der Quotienten"}}}}})json");
  EXPECT_EQ(found("honey").values.at("ratio").statistic, "mean of ratios");
  speak({.code = "de", .words = nullptr});
  EXPECT_EQ(found("honey").values.at("ratio").statistic, "Mittelwert der Quotienten");
  speak({.code = "fr", .words = nullptr});
  EXPECT_EQ(found("honey").values.at("ratio").statistic, "mean of ratios");
  speak({});
}

TEST_F(PublishedTest, EveryShippedNumberSaysHowItWasComputedAndHowManyItRestsOn) {
  const std::string folder = test_support::source_folder().string() + "/data/published";
  for (const char* study : {"magnitude_of_virtual_water", "viscosity_discrimination"}) {
    const Published published = published_for(study, folder);
    EXPECT_EQ(published.num_participants, 13);
    for (const auto& [name, value] : published.values) {
      if (value.positive) continue;
      EXPECT_TRUE(value.compute) << name;
      EXPECT_FALSE(value.statistic.empty()) << name;
      EXPECT_TRUE(value.num_decimals) << name;
      ASSERT_TRUE(value.n) << name;
      EXPECT_LE(*value.n, 13) << name;
      const double scaled = *value.value * std::pow(10.0, *value.num_decimals);
      EXPECT_NEAR(scaled, std::round(scaled), 1e-9) << name << ": more decimals than it says";
    }
  }
}

TEST_F(PublishedTest, TheShippedValuesAreThoseOfTheThesis) {
  const std::string folder = test_support::source_folder().string() + "/data/published";
  const Published magnitude = published_for("magnitude_of_virtual_water", folder);
  EXPECT_EQ(magnitude.values.at("magnitude_estimation.k").value, 0.6663);
  EXPECT_EQ(magnitude.values.at("magnitude_production.a").value, 1.206);
  EXPECT_EQ(magnitude.values.at("combined.k").value, 0.5145);
  const Published discrimination = published_for("viscosity_discrimination", folder);
  EXPECT_EQ(discrimination.values.at("group_d.weber_fraction").value, 0.697);
  EXPECT_EQ(discrimination.values.at("group_e.weber_fraction").value, 0.2928);
  const PublishedValue& lag = discrimination.values.at("finger_lag_s");
  EXPECT_TRUE(lag.positive);
  EXPECT_FALSE(lag.value);
  EXPECT_NE(discrimination.citation.find("Schmidt"), std::string::npos);
}

}  // namespace published_test
}  // namespace jnd::analysis
