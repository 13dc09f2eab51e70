#include "app/commands/participant_list.h"

#include <gtest/gtest.h>

#include "app/command_line/command.h"

namespace jnd::app {
namespace participant_list_test {

TEST(ParticipantList, ReadsNumbersRangesAndSteps) {
  using Sizes = std::vector<int>;
  EXPECT_EQ(participant_list("13", "x"), (Sizes{13}));
  EXPECT_EQ(participant_list("6,8,13", "x"), (Sizes{6, 8, 13}));
  EXPECT_EQ(participant_list("5..9", "x"), (Sizes{5, 6, 7, 8, 9}));
  EXPECT_EQ(participant_list("6,8..13", "x"), (Sizes{6, 8, 10, 12}));
  EXPECT_EQ(participant_list("2,6,8..12,20,30..50", "x"),
            (Sizes{2, 6, 8, 10, 12, 20, 30, 40, 50}));
  EXPECT_EQ(participant_list("6,8..40", "x").size(), 18U);
  EXPECT_EQ(participant_list("7..7", "x"), (Sizes{7}));
}

TEST(ParticipantList, RefusesWhatIsNoneInOneSentence) {
  for (const char* wrong : {"",     ",",     "0",      "-1",      "6,",
                            "6,,8", "8,6",   "6,6",    "9..5",    "..5",
                            "5..",  "5...9", "6,8..7", "1..2000", "10001",
                            "1e3",  "six",   " 6",     "6;8",     "99999999999999999999"}) {
    try {
      (void)participant_list(wrong, "--participants");
      FAIL() << wrong;
    } catch (const UsageError& error) {
      EXPECT_NE(std::string(error.what()).find("--participants: expected numbers"),
                std::string::npos);
    }
  }
}

}  // namespace participant_list_test
}  // namespace jnd::app
