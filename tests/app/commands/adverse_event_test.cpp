#include <gtest/gtest.h>

#include <string>

#include "app/commands/command_fixture.h"
#include "app/json_document.h"
#include "app/sentence.h"
#include "app/tiny_study.h"
#include "support/program.h"

namespace jnd::app {
namespace adverse_event_test {

using test_support::ProgramOutcome;

class AdverseEventTest : public CommandTest {
 protected:
  void SetUp() override {
    write_file(temporary_.path() / "tiny.json", kTinyStudy);
    ASSERT_EQ(
        jnd({"simulate", "tiny.json", "--participants", "2", "--study", "x.study", "--fast"})
            .exit_code,
        0);
  }
};

TEST_F(AdverseEventTest, IsStoredListedReportedAndOutlivesAWithdrawal) {
  EXPECT_NE(jnd({"adverse-event", "x.study"}).out.find("no adverse event"), std::string::npos);
  ASSERT_EQ(jnd({"adverse-event", "x.study", "--session", "1", "--text", "a pinched finger"})
                .exit_code,
            0);
  const auto listed = document(jnd({"adverse-event", "x.study", "--json"}).out);
  ASSERT_EQ(listed["adverse_events"].size(), 1u);
  EXPECT_EQ(listed["adverse_events"][0]["text"], "a pinched finger");
  const std::string participant = listed["adverse_events"][0]["participant"];
  const ProgramOutcome left =
      jnd({"withdraw", "x.study", "--participant", participant, "--yes"});
  EXPECT_EQ(left.exit_code, 0) << left.err;
  EXPECT_NE(left.out.find("kept: 1 adverse events"), std::string::npos) << left.out;
  EXPECT_NE(jnd({"adverse-event", "x.study"}).out.find("a pinched finger"), std::string::npos);
  EXPECT_EQ(jnd({"verify", "x.study"}).exit_code, 0);
}

TEST_F(AdverseEventTest, NeedsASessionThatIsThere) {
  const ProgramOutcome without = jnd({"adverse-event", "x.study", "--text", "a fright"});
  EXPECT_EQ(without.exit_code, 2);
  EXPECT_EQ(sentence_flaw(without.err), "");
  const ProgramOutcome nobody =
      jnd({"adverse-event", "x.study", "--session", "99", "--text", "a fright"});
  EXPECT_NE(nobody.exit_code, 0);
  EXPECT_EQ(sentence_flaw(nobody.err), "");
}

}  // namespace adverse_event_test
}  // namespace jnd::app
