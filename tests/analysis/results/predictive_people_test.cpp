#include "analysis/results/predictive_people.h"

#include <gtest/gtest.h>

#include "core/error.h"

namespace jnd::analysis {
namespace predictive_people_test {

PredictivePeople some_people() {
  PredictivePeople people{.key = {.study = "honey",
                                  .study_sha256 = "ab",
                                  .laboratory = "lab",
                                  .laboratory_sha256 = "cd",
                                  .device = "lumped"},
                          .seed = 18446744073709551615ULL};
  people.groups.resize(2);
  PersonOutcome one{.cells = "order=a,b"};
  one.numbers = {{"stroke_width_m", 0.2612345678}, {"thin.reference", 1.853}};
  one.counts["thin"][1.093] = {.intensity = 1.093, .num_yes = 2, .num_trials = 5};
  one.means["estimation"] = {{0.0, 0.0}, {0.5, 0.7000000001}};
  people.groups[0] = {one, {.cells = "order=b,a"}};
  people.groups[1] = {one};
  return people;
}

TEST(PredictivePeople, ComeBackFromTheirText) {
  const std::string text = to_text(some_people());
  const PredictivePeople people = predictive_people_from(text, "here");
  EXPECT_EQ(people.key, some_people().key);
  EXPECT_EQ(people.seed, 18446744073709551615ULL);
  EXPECT_EQ(people.num_people(), 3);
  ASSERT_EQ(people.groups.size(), 2U);
  const PersonOutcome& one = people.groups[0][0];
  EXPECT_EQ(one.cells, "order=a,b");
  EXPECT_EQ(one.numbers.at("stroke_width_m"), 0.261235) << "six digits";
  EXPECT_EQ(one.numbers.at("thin.reference"), 1.853);
  EXPECT_EQ(one.counts.at("thin").at(1.093).num_yes, 2);
  EXPECT_EQ(one.counts.at("thin").at(1.093).num_trials, 5);
  EXPECT_EQ(one.counts.at("thin").at(1.093).intensity, 1.093);
  EXPECT_EQ(one.means.at("estimation").at(0.5), 0.7);
  EXPECT_TRUE(people.groups[0][1].numbers.empty()) << "what somebody lacks";
  EXPECT_EQ(to_text(people), text) << "to the byte";
}

TEST(PredictivePeople, ATextThatHoldsNoneIsNamed) {
  const std::string text = to_text(some_people());
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string changed = text;
    const std::size_t at = changed.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return changed.replace(at, from.size(), to);
  };
  for (const std::string& broken :
       {std::string("{"), std::string("[]"), with("\"format\": 1", "\"format\": 2"),
        with("\"seed\"", "\"sed\""), with("[1,\"order", "[7,\"order"),
        with("[0,\"order=b,a\"", "[0,\"order=b,a\",1"), with("@1.093", ".1093")}) {
    try {
      (void)predictive_people_from(broken, "here");
      ADD_FAILURE() << "expected an error for " << broken;
    } catch (const core::Error& error) {
      EXPECT_TRUE(std::string(error.what()).starts_with("here: ")) << error.what();
    }
  }
}

}  // namespace predictive_people_test
}  // namespace jnd::analysis
