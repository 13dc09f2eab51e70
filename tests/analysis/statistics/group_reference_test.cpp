#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "analysis/fits/fit_json.h"
#include "analysis/statistics/multiplicity.h"
#include "support/reference_data.h"

namespace jnd::analysis {
namespace group_reference_test {

using nlohmann::json;

/// The reference was computed by SciPy, and in part by R, with the script beside it.
const json& reference() { return test_support::reference_data("group_tests/group_tests.json"); }

Comparison compared(const json& c) {
  const std::vector<double> a = c.at("a"), b = c.at("b");
  const std::string test = c.at("test");
  if (test == "paired") return paired_t_test(a, b);
  if (test == "one_sample") return one_sample_t_test(a);
  if (test == "welch") return welch_t_test(a, b);
  if (test == "wilcoxon") return wilcoxon_test(a, b);
  if (test == "ranksum") return rank_sum_test(a, b);
  return spearman_correlation(a, b);
}

void expect_close(const json& found, const json& expected, const std::string& where) {
  if (expected.is_array()) {
    for (std::size_t i = 0; i < expected.size(); ++i) {
      expect_close(found.at(i), expected[i], where + " " + std::to_string(i));
    }
    return;
  }
  if (!expected.is_number()) {
    EXPECT_EQ(found, expected) << where;
    return;
  }
  ASSERT_TRUE(found.is_number()) << where << ": expected " << expected << ", found " << found;
  const double value = expected.get<double>();
  EXPECT_NEAR(found.get<double>(), value, 1e-8 * std::max(std::fabs(value), 1e-3)) << where;
}

TEST(GroupReference, EveryTestAndEffectSizeAgreesWithScipy) {
  for (const json& c : reference().at("tests")) {
    const Comparison result = compared(c);
    EXPECT_EQ(result.status, FitStatus::kOk) << c.at("name");
    const json found = to_json(result);
    for (const auto& [key, value] : c.at("expected").items()) {
      expect_close(found.at(key), value,
                   c.at("test").get<std::string>() + ", " + c.at("name").get<std::string>() +
                       ": " + key);
    }
  }
  EXPECT_GE(reference().at("tests").size(), 30U);
}

TEST(GroupReference, RankTestsWithTiesAndZerosAgreeWithRAndCoin) {
  const json& document = test_support::reference_data("group_tests/rank_tests.json");
  for (const json& c : document.at("tests")) {
    const json& expected = c.at("expected");
    const json found = to_json(compared(c));
    const std::string where =
        c.at("test").get<std::string>() + ", " + c.at("name").get<std::string>();
    EXPECT_EQ(found.at("status"), "ok") << where;
    expect_close(found.at("p_value"), expected.at("p_value"), where);
    EXPECT_EQ(found.at("method").get<std::string>().find("exact") != std::string::npos,
              expected.at("exact").get<bool>())
        << where;
    for (const char* name : {"v", "u", "s"}) {
      if (!expected.contains(name)) continue;
      const std::string key(1, static_cast<char>(name[0] - 'a' + 'A'));
      expect_close(found.at("statistics").at(key), expected.at(name), where + ": " + name);
    }
    if (expected.contains("estimate")) {
      expect_close(found.at("estimate"), expected.at("estimate"), where);
    }
  }
  EXPECT_GE(document.at("tests").size(), 40U);
}

TEST(GroupReference, HolmsAdjustmentAgrees) {
  for (const json& family : reference().at("holm")) {
    const std::vector<double> p_values = family.at("p_values");
    const auto adjusted = holm_adjusted({p_values.begin(), p_values.end()});
    for (std::size_t i = 0; i < p_values.size(); ++i) {
      EXPECT_NEAR(adjusted[i].value(), family.at("adjusted")[i].get<double>(), 1e-12);
    }
  }
}

}  // namespace group_reference_test
}  // namespace jnd::analysis
