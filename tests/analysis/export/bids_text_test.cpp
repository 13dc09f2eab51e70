#include "analysis/export/bids_text.h"

#include <gtest/gtest.h>

namespace jnd::analysis {
namespace bids_text_test {

using Labels = std::map<std::string, std::string>;

TEST(BidsText, LabelsAreLettersAndDigitsAndEachItsOwn) {
  EXPECT_EQ(bids_labels({"P01", "group_d", "a-b.c", "--", "P01"}),
            (Labels{{"P01", "P01"}, {"group_d", "groupd"}, {"a-b.c", "abc"}, {"--", "x"}}));
  EXPECT_EQ(bids_labels({"P-1", "P.1", "P1", "p_1"}),
            (Labels{{"P1", "P1"}, {"P-1", "P1x2"}, {"P.1", "P1x3"}, {"p_1", "p1x4"}}));
  EXPECT_EQ(bids_labels({"ä"}), (Labels{{"ä", "x"}}));
}

TEST(BidsText, LabelsDoNotDependOnTheOrderOfTheNames) {
  EXPECT_EQ(bids_labels({"a_b", "ab", "A.b"}), bids_labels({"A.b", "a_b", "ab"}));
}

TEST(BidsText, TimesAreUtcWithMicroseconds) {
  EXPECT_EQ(iso_time(0), "1970-01-01T00:00:00.000000Z");
  EXPECT_EQ(iso_time(1'709'210'096'123'456'789), "2024-02-29T12:34:56.123456Z");
  EXPECT_EQ(iso_date(1'709'210'096'123'456'789), "2024-02-29");
}

}  // namespace bids_text_test
}  // namespace jnd::analysis
