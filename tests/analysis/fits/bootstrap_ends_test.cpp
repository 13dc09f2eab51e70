#include "analysis/fits/bootstrap_ends.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace jnd::analysis {
namespace bootstrap_ends_test {

/// The numbers 1 to n.
std::vector<double> first(int n) {
  std::vector<double> all;
  for (int i = 1; i <= n; ++i) all.push_back(i);
  return all;
}

/// Without bias and acceleration the corrected interval is that of the percentiles.
TEST(BootstrapEnds, ACorrectionOfNothingIsThePercentileInterval) {
  const BootstrapEnds ends = bootstrap_ends(first(999), 500.0, 0.0);
  EXPECT_EQ(ends.bca_reason, "");
  EXPECT_NEAR(*ends.bias_correction, 0.0, 1e-12);
  EXPECT_NEAR(*ends.bca_ci95.low, *ends.ci95.low, 1e-6);
  EXPECT_NEAR(*ends.bca_ci95.high, *ends.ci95.high, 1e-6);
}

/// Efron 1987: z0 = 0.5 and a = 0 move the ends to Phi(2 z0 -+ 1.95996), which is 0.1685 and
/// 0.9985.
TEST(BootstrapEnds, ABiasMovesBothEndsByTwiceItself) {
  const double below = 0.69146 * 1999.0;  // Phi(0.5)
  const BootstrapEnds ends = bootstrap_ends(first(1999), below, 0.0);
  EXPECT_EQ(ends.bca_reason, "");
  EXPECT_NEAR(*ends.bca_ci95.low, 0.1685 * 1999.0, 3.0);
  EXPECT_NEAR(*ends.bca_ci95.high, 0.9985 * 1999.0, 3.0);
}

/// The upper end lies at Phi(2 z0 + 1.96) = 0.99999 if all but 2 % of the refits are below the
/// estimate, as near a bound. A thousand refits do not tell where that is.
TEST(BootstrapEnds, EndsBeyondTheOutermostRefitsAreRefusedWithTheNumberThatIsNeeded) {
  const BootstrapEnds ends = bootstrap_ends(first(1000), 980.0, 0.0);
  EXPECT_FALSE(ends.bca_ci95.low || ends.bca_ci95.high);
  EXPECT_TRUE(ends.bca_reason.starts_with("its ends lie beyond the outermost refits"))
      << ends.bca_reason;
  const BootstrapEnds near = bootstrap_ends(first(1000), 700.0, 0.0);
  EXPECT_EQ(near.bca_reason, "") << "0.9987 is within a thousand refits";
  const BootstrapEnds few = bootstrap_ends(first(500), 350.0, 0.0);
  EXPECT_EQ(few.bca_reason, "its ends lie beyond the outermost refits; 748 refits are needed");
}

/// One refit in forty lies beyond each of the percentiles.
TEST(BootstrapEnds, FewerThan39RefitsReachNoPercentile) {
  const BootstrapEnds few = bootstrap_ends(first(38), 19.0, 0.0);
  EXPECT_FALSE(few.ci95.low || few.ci95.high);
  EXPECT_FALSE(few.is_refused);
  EXPECT_FALSE(few.bca_reason.empty());
  EXPECT_TRUE(bootstrap_ends(first(39), 19.0, 0.0).ci95.low);
}

TEST(BootstrapEnds, AnAccelerationThatTurnsTheCorrectionAroundGivesNone) {
  const BootstrapEnds ends = bootstrap_ends(first(1000), 500.0, 0.6);
  EXPECT_FALSE(ends.bca_ci95.low || ends.bca_ci95.high);
  EXPECT_EQ(ends.bca_reason,
            "single answers have so much influence that there is no correction");
}

}  // namespace bootstrap_ends_test
}  // namespace jnd::analysis
