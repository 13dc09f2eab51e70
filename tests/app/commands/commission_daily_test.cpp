#include <string>

#include "app/commands/command_fixture.h"
#include "app/json_document.h"
#include "experiments/device_profile/profile_reader.h"

namespace jnd::app {
namespace commission_daily_test {

using test_support::ProgramOutcome;

class CommissionDailyTest : public CommandTest {
 protected:
  void SetUp() override {
    options_.environment.emplace_back("XDG_CONFIG_HOME", path("config").string());
  }
  [[nodiscard]] std::size_t num_checks() const {
    return experiments::read_device_profile(path("twin_seed_7.device.json")).checks.size();
  }
};

TEST_F(CommissionDailyTest, PassesAsCommissionedFailsOnceItHasChangedAndPassesAgain) {
  ASSERT_EQ(jnd({"commission", "twin:seed=7", "--record", "record"}).exit_code, 0);
  const ProgramOutcome same = jnd({"commission", "twin:seed=7", "--daily"});
  EXPECT_EQ(same.exit_code, 0) << same.out << same.err;
  EXPECT_NE(same.out.find("passed: the device is as its profile says"), std::string::npos);
  EXPECT_EQ(num_checks(), 1U);

  const ProgramOutcome weaker =
      jnd({"commission", "twin:seed=7,drifted_gain_ratio=0.95", "--daily", "--json"});
  EXPECT_EQ(weaker.exit_code, 1) << weaker.err;
  const nlohmann::json told = document(weaker.out);
  EXPECT_FALSE(told["passed"].get<bool>());
  EXPECT_TRUE(told["simulated"].get<bool>());
  int num_failed = 0;
  for (const auto& quantity : told["quantities"]) {
    const bool has_passed = quantity["passed"].get<bool>();
    if (quantity["name"] == "gain") {
      EXPECT_FALSE(has_passed);
      EXPECT_LT(quantity["found"].get<double>(), quantity["least"].get<double>());
    }
    num_failed += has_passed ? 0 : 1;
  }
  EXPECT_EQ(num_failed, 1) << weaker.out;
  EXPECT_EQ(num_checks(), 2U);
  const std::vector<std::string> session = {
      "run",        "short_tour", "--study",     "s.study",   "--participant",          "P01",
      "--headless", "--device",   "twin:seed=7", "--profile", "twin_seed_7.device.json"};
  const ProgramOutcome refused = jnd(session);
  EXPECT_NE(refused.exit_code, 0);
  EXPECT_NE(refused.err.find("last daily check"), std::string::npos) << refused.err;

  EXPECT_EQ(jnd({"commission", "twin:seed=7", "--daily"}).exit_code, 0);
  EXPECT_EQ(num_checks(), 3U);
  EXPECT_EQ(jnd({"validate", "twin_seed_7.device.json"}).exit_code, 0) << "it is signed anew";
}

TEST_F(CommissionDailyTest, SaysWhatItLacks) {
  const ProgramOutcome none = jnd({"commission", "twin:seed=7", "--daily"});
  EXPECT_EQ(none.exit_code, 1);
  EXPECT_NE(none.err.find("expected a profile of `jnd twin` seed-7"), std::string::npos)
      << none.err;
  EXPECT_EQ(jnd({"commission", "twin:seed=7", "--daily", "--only", "noise"}).exit_code, 2);
  EXPECT_EQ(jnd({"commission", "twin:seed=7", "--profile", "x"}).exit_code, 2);
  ASSERT_EQ(jnd({"commission", "twin:seed=7", "--record", "record"}).exit_code, 0);
  const ProgramOutcome foreign =
      jnd({"commission", "twin:seed=8", "--daily", "--profile", "twin_seed_7.device.json"});
  EXPECT_EQ(foreign.exit_code, 1);
  EXPECT_NE(foreign.err.find("seed-8"), std::string::npos) << foreign.err;
  EXPECT_EQ(num_checks(), 0U);
}

}  // namespace commission_daily_test
}  // namespace jnd::app
