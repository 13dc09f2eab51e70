#include "analysis/report/data_quality.h"

#include <gtest/gtest.h>

#include "analysis/hand_made_study.h"

namespace jnd::analysis {
namespace data_quality_test {

std::vector<std::string> remarks_after(const std::string& protocol, double duration_s) {
  HandMadeStudy study(protocol);
  const std::int64_t session = study.add("P01");
  study.estimate(1.0, 100.0);
  study.wait(duration_s);
  study.estimate(2.0, 200.0);
  return session_quality(study.store(), {study.store().session(session)}).at(0).remarks;
}

TEST(DataQuality, SaysWhoTookLongerThanTheStudyAllows) {
  const std::string limited =
      R"({"name": "by_hand", "session_limits": {"max_duration_s": 3600}})";
  EXPECT_EQ(remarks_after(limited, 4680.0),
            std::vector<std::string>{"took 78 min, of at most 60 min that the study allows"});
  EXPECT_TRUE(remarks_after(limited, 3600.0).empty());
  EXPECT_TRUE(remarks_after(R"({"name": "by_hand"})", 4680.0).empty());
}

TEST(DataQuality, SaysWhatGuardsNoticed) {
  HandMadeStudy study(R"({"name": "by_hand"})");
  const std::int64_t session = study.add("P01");
  study.estimate(1.0, 100.0);
  study.happen("guard_noticed", {},
               R"({"guard": "energy_given", "num_shadowed": 0, "num_warnings": 2})");
  study.happen("guard_noticed", {},
               R"({"guard": "force_oscillates", "num_shadowed": 1, "num_warnings": 1})");
  study.happen("guard_noticed", {},
               R"({"guard": "energy_given", "num_shadowed": 0, "num_warnings": 3})");
  EXPECT_EQ(
      session_quality(study.store(), {study.store().session(session)}).at(0).remarks,
      (std::vector<std::string>{"guard energy_given: warned 5 times",
                                "guard force_oscillates: warned 1 times, only counted 1 faults "
                                "(shadow mode)"}));
}

}  // namespace data_quality_test
}  // namespace jnd::analysis
