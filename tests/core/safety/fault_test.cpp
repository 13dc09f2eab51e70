#include "core/safety/fault.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace jnd::core {
namespace fault_test {

TEST(Fault, EveryOneHasANameAndASentenceOfItsOwn) {
  std::set<std::string> names;
  std::set<std::string> sentences;
  for (int i = 0; i <= static_cast<int>(Fault::kHeartbeatLost); ++i) {
    const auto fault = static_cast<Fault>(i);
    names.emplace(name(fault));
    sentences.emplace(words(fault));
    EXPECT_NE(name(fault), "unknown") << i;
    EXPECT_EQ(words(fault).back(), '.') << i;
  }
  EXPECT_EQ(names.size(), 10U);
  EXPECT_EQ(sentences.size(), 10U);
}

TEST(Fault, AByteFromAForeignRecordingStillHasWords) {
  EXPECT_EQ(name(static_cast<Fault>(200)), "unknown");
  EXPECT_FALSE(words(static_cast<Fault>(200)).empty());
}

TEST(Fault, ADriverSaysMoreOnlyOfWhatItDid) {
  EXPECT_TRUE(is_of_driver(Fault::kDeviceReadFailed));
  EXPECT_TRUE(is_of_driver(Fault::kDeviceWriteFailed));
  EXPECT_TRUE(is_of_driver(Fault::kNonFiniteState));
  EXPECT_FALSE(is_of_driver(Fault::kNone));
  EXPECT_FALSE(is_of_driver(Fault::kEmergencyStop));
  EXPECT_FALSE(is_of_driver(Fault::kHostTooSlow));
}

}  // namespace fault_test
}  // namespace jnd::core
