#include "core/require.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>

namespace jnd::core {
namespace require_test {

std::string message_for(double value) {
  try {
    require(value > 0.0, "rate_hz", "a number > 0", value);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Require, SaysFieldRuleAndValue) {
  EXPECT_EQ(message_for(-1.5), "rate_hz: expected a number > 0, found -1.5");
  EXPECT_EQ(message_for(std::numeric_limits<double>::quiet_NaN()),
            "rate_hz: expected a number > 0, found nan");
}

TEST(Require, IsSilentWhenTheRuleHolds) { EXPECT_EQ(message_for(1.0), ""); }

TEST(Require, NumbersThatAreNotFiniteAreNeitherPositiveNorNotNegative) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double value : {-1.0, infinity, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THROW(require_positive(value, "rate_hz"), Error) << value;
    EXPECT_THROW(require_not_negative(value, "rate_hz"), Error) << value;
  }
  EXPECT_THROW(require_positive(0.0, "rate_hz"), Error);
  EXPECT_NO_THROW(require_not_negative(0.0, "rate_hz"));
  EXPECT_NO_THROW(require_positive(1e-300, "rate_hz"));
}

}  // namespace require_test
}  // namespace jnd::core
