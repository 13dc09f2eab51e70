#include "app/session/pseudonym.h"

#include <gtest/gtest.h>

namespace jnd::app {
namespace pseudonym_test {

TEST(Pseudonym, IsLettersDigitsAndThreeSigns) {
  EXPECT_TRUE(is_pseudonym("P01"));
  EXPECT_TRUE(is_pseudonym("a_b-c.9"));
  EXPECT_TRUE(is_pseudonym(std::string(64, 'x')));
  EXPECT_FALSE(is_pseudonym(std::string(65, 'x')));
  EXPECT_FALSE(is_pseudonym(""));
  EXPECT_FALSE(is_pseudonym("P 1"));
  EXPECT_FALSE(is_pseudonym("P/1"));
  EXPECT_FALSE(is_pseudonym("J\xC3\xBCrgen"));
}

TEST(Pseudonym, LookalikesDifferInCaseSignsOrZerosAlone) {
  for (const char* slip : {"p01", "P1", "P001", "P-01", "p_1", "P.1"}) {
    EXPECT_EQ(lookalike(slip, {"A7", "P01"}), "P01") << slip;
  }
  for (const char* other : {"P01", "P02", "P10", "P11", "Q01", "P01a", "P"}) {
    EXPECT_EQ(lookalike(other, {"A7", "P01"}), "") << other;
  }
  EXPECT_EQ(lookalike("P1-12", {"P11-2"}), "") << "the same digits, other numbers";
  EXPECT_EQ(lookalike("P1-02", {"P1_2"}), "P1_2");
  EXPECT_EQ(lookalike("P0", {"P00"}), "P00");
  EXPECT_EQ(lookalike("P0", {"P"}), "");
}

}  // namespace pseudonym_test
}  // namespace jnd::app
