#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "analysis/fits/fit_json.h"
#include "analysis/reference_values.h"
#include "support/reference_data.h"

namespace jnd::analysis {
namespace reference_test {

using nlohmann::json;

/// The file data/reference/fits_reference.json was computed by SciPy with the script beside it.
const json& reference() { return test_support::reference_data("fits_reference.json"); }

void expect_close(const json& found, const json& expected, const std::string& where) {
  if (!expected.is_number()) {
    EXPECT_EQ(found, expected) << where;
    return;
  }
  ASSERT_TRUE(found.is_number()) << where << ": expected " << expected << ", found " << found;
  const double value = expected.get<double>();
  EXPECT_NEAR(found.get<double>(), value, 1e-6 * std::max(std::fabs(value), 1e-4)) << where;
}

void expect_all(const json& found, const json& expected, const std::string& name) {
  for (const auto& [key, value] : expected.items()) {
    if (key == "num_excluded") {
      EXPECT_EQ(found.at("excluded").size(), value) << name;
    } else if (value.is_array()) {
      expect_close(found.at(key).at(0), value.at(0), name + ": " + key + " low");
      expect_close(found.at(key).at(1), value.at(1), name + ": " + key + " high");
    } else {
      expect_close(found.at(key), value, name + ": " + key);
    }
  }
  if (expected.at("status") != "degenerate") return;
  EXPECT_NE(found.at("reason"), nullptr) << name;
  for (const char* key : {"weber_fraction", "k", "a", "statistic", "p_value"}) {
    EXPECT_TRUE(!found.contains(key) || found.at(key).is_null()) << name << ": " << key;
  }
}

TEST(Reference, EveryPsychometricFitAgreesWithScipy) {
  for (const json& c : reference().at("weber")) {
    const PsychometricOptions options = {.reference = c.at("reference"),
                                         .method = c.at("method") == "ml"
                                                       ? PsychometricMethod::kMaximumLikelihood
                                                       : PsychometricMethod::kLeastSquares,
                                         .free_pse = c.at("free_pse"),
                                         .free_lapse = c.at("free_lapse")};
    expect_all(to_json(fit_psychometric(reference_answers(c.at("data")), options)),
               c.at("expected"), c.at("name"));
  }
}

TEST(Reference, EveryPowerFitAgreesWithScipy) {
  for (const json& c : reference().at("power")) {
    std::vector<Magnitude> data;
    for (const json& row : c.at("data")) data.push_back({row[0], row[1]});
    const PowerMethod method =
        c.at("method") == "nls" ? PowerMethod::kNonlinear : PowerMethod::kLogLog;
    expect_all(to_json(fit_power(data, method)), c.at("expected"), c.at("name"));
  }
}

TEST(Reference, EveryComparisonAgreesWithScipy) {
  for (const json& c : reference().at("compare")) {
    const std::vector<double> a = c.at("a"), b = c.at("b");
    const std::string test = c.at("test");
    const Comparison found = test == "paired"    ? paired_t_test(a, b)
                             : test == "welch"   ? welch_t_test(a, b)
                             : test == "pearson" ? pearson_correlation(a, b)
                                                 : wilcoxon_test(a, b);
    expect_all(to_json(found), c.at("expected"), c.at("name"));
  }
}

TEST(Reference, HoldsSixtyDataSetsAndMoreAndNamesWhatComputedThem) {
  const json& document = reference();
  EXPECT_GE(
      document.at("weber").size() + document.at("power").size() + document.at("compare").size(),
      60U);
  EXPECT_TRUE(document.at("versions").contains("scipy"));
}

}  // namespace reference_test
}  // namespace jnd::analysis
