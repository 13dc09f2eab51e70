#include "experiments/protocol/session_rules.h"

#include <gtest/gtest.h>

#include "tests/experiments/protocol/broken_study.h"

namespace jnd::experiments {
namespace session_rules_test {

TEST(SessionRules, WantEveryStageToBeGivenToSomebody) {
  const std::string inside = "\"name\": \"bucket\"";
  EXPECT_EQ(problems_of(broken(inside, inside + ", \"only_for\": {\"priming\": \"unprimed\"}")),
            "x.json:11:69: /stages/0/arms/0/stages/0/only_for/priming: expected `primed`, the "
            "arm that this stage stands in, or nothing, found `unprimed`; nobody would get the "
            "stage");
  EXPECT_EQ(problems_of(broken(inside, inside + ", \"only_for\": {\"priming\": \"primed\"}")),
            "");
}

TEST(SessionRules, TellOfAnArmThatDoesNotExistOnce) {
  const std::string inside = "\"name\": \"bucket\"";
  const std::string problems =
      problems_of(broken(inside, inside + ", \"only_for\": {\"priming\": \"nobody\"}"));
  EXPECT_EQ(std::count(problems.begin(), problems.end(), '\n'), 0) << problems;
  EXPECT_NE(problems.find("expected an arm of `priming`"), problems.npos) << problems;
}

TEST(SessionRules, LetArmsOfAnOrderBeFollowedByEverybody) {
  const std::string low = "\"name\": \"production\"";
  EXPECT_EQ(problems_of(broken(low, low + ", \"only_for\": {\"priming\": \"primed\"}")), "");
}

// 3 x 3 trials of 20 s, 2 x 2 of 30 s, 2 x 5 of 15 s, and breaks of 60 s and 180 s make 690 s.
TEST(SessionRules, RefuseASessionOfMoreThanEightHours) {
  const auto with_break = [](const std::string& seconds) {
    return broken("\"duration_s\": 180", "\"duration_s\": " + seconds);
  };
  EXPECT_EQ(problems_of(with_break("7200")), "");
  // 9 x (600 + 3000) + 120 + 150 + 60 + 180 = 32910 s.
  EXPECT_EQ(problems_of(broken("\"expected_trial_s\": 20",
                               "\"expected_trial_s\": 3000, \"free_space_between_s\": 600")),
            "x.json:13:5: /stages/1: expected a session of at most 8 hours, found one of about "
            "9.1, 9 of them in this stage; times are in seconds");
  // This is at the limit: 9 x 3143 + 513 is 28800 s.
  EXPECT_EQ(problems_of(broken("\"expected_trial_s\": 20", "\"expected_trial_s\": 3143",
                               with_break("183"))),
            "");
  EXPECT_NE(problems_of(broken("\"expected_trial_s\": 20", "\"expected_trial_s\": 3143",
                               with_break("184"))),
            "");
}

TEST(SessionRules, CountOnlyTheLongestOfArmsOfWhichOneIsRun) {
  std::string longest = "\"stages\": []";
  for (int i = 3; i >= 0; --i) {
    longest.insert(longest.size() - 1,
                   std::string(i < 3 ? ", " : "") + R"({"kind": "break", "name": "long_)" +
                       std::to_string(i) +
                       R"(", "instruction": {"en": "R.", "de": "P."}, "duration_s": 6000})");
  }
  // This arm has 24000 s and the other one 60 s. 6000 s more in this arm would be too many.
  const std::string text = broken("\"stages\": []", longest);
  EXPECT_EQ(problems_of(text), "");
  EXPECT_EQ(problems_of(broken("\"duration_s\": 60", "\"duration_s\": 6000", text)), "");
  EXPECT_NE(problems_of(broken("\"duration_s\": 180", "\"duration_s\": 6000",
                               broken("\"only_for\": {\"priming\": \"primed\"},", "", text))),
            "")
      << "what everybody gets is added";
}

TEST(SessionRules, CountNoTimeThatIsItselfAProblem) {
  EXPECT_EQ(problems_of(broken("\"duration_s\": 180", "\"duration_s\": 99999")),
            "x.json:31:71: /stages/2/between/0/duration_s: expected a number >= 0 and <= 7200 "
            "(s), found 99999");
}

TEST(SessionRules, WantAMediumToLastLongerThanItsRamp) {
  const auto explored = [](const std::string& duration_s, const std::string& device) {
    return problems_of(
        broken("\"stages\": [", device + R"("stages": [{"kind": "explore", "name": "e",
  "instruction": {"en": "E.", "de": "E."},
  "media": [{"medium": "free_space", "duration_s": )" +
                                    duration_s + "}]},"));
  };
  EXPECT_EQ(explored("0.06", ""), "");
  EXPECT_EQ(explored("0.05", ""),
            "x.json:10:52: /stages/0/media/0/duration_s: expected a time longer than the "
            "device's `ramp_s` (0.05 s), in which the medium only comes up, found 0.05");
  EXPECT_EQ(explored("0.05", "\"device\": {\"ramp_s\": 0},"), "");
  EXPECT_NE(explored("2", "\"device\": {\"ramp_s\": 2},"), "");
}

}  // namespace session_rules_test
}  // namespace jnd::experiments
