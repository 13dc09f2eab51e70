#include "analysis/results/test_families.h"

#include <gtest/gtest.h>

namespace jnd::analysis {
namespace test_families_test {

NamedComparison test_of(const std::string& family, std::optional<double> p_value) {
  NamedComparison named{.name = "a test", .family = family};
  named.comparison.p_value = p_value;
  return named;
}

TEST(TestFamilies, EachFamilyIsAdjustedOverAllSections) {
  std::vector<ResultsSection> sections(2);
  sections[0].comparisons = {test_of("one", 0.01), test_of("", 0.02), test_of("two", 0.03)};
  sections[1].comparisons = {test_of("one", 0.04), test_of("one", std::nullopt)};
  adjust_by_family(sections);
  EXPECT_DOUBLE_EQ(sections[0].comparisons[0].p_value_holm.value(), 0.02);
  EXPECT_FALSE(sections[0].comparisons[1].p_value_holm) << "alone";
  EXPECT_DOUBLE_EQ(sections[0].comparisons[2].p_value_holm.value(), 0.03);
  EXPECT_DOUBLE_EQ(sections[1].comparisons[0].p_value_holm.value(), 0.04);
  EXPECT_FALSE(sections[1].comparisons[1].p_value_holm) << "no test, no chance";
}

}  // namespace test_families_test
}  // namespace jnd::analysis
