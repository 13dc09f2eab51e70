#include <gtest/gtest.h>

#include "analysis/report/report_results.h"

namespace jnd::analysis {
namespace report_discrimination_test {

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

ResultsSection two_people() {
  return {.name = "group_d",
          .participants = {
              {"P01", "group_d.weber_fraction", 1.85, {0.655, std::nullopt}, ""},
              {"P01", "group_d.weber_fraction_free_pse", 0.25, {0.1, 402367.0}, ""},
              {"P01", "group_d.pse", 0.627, {1e-17, 1.125}, ""},
              {"P01", "group_d.goodness_p", 0.001, {}, ""},
              {"P01", "group_d.goodness_p_free_pse", 0.136, {}, ""},
              {"P02", "group_d.weber_fraction", 0.5, {0.25, 1.5}, ""},
              {"P02", "group_d.weber_fraction_free_pse", std::nullopt, {}, "separated"},
              {"P02", "group_d.pse", std::nullopt, {}, "separated"},
              {"P02", "group_d.goodness_p", 0.4, {}, ""},
          }};
}

TEST(ReportDiscrimination, SaysWhichFitsTheAnswersReject) {
  HtmlText html;
  ASSERT_TRUE(write_own_fractions(html, two_people()));
  EXPECT_TRUE(has(html.text(), "0.001 †"));
  EXPECT_TRUE(has(html.text(), ">0.400<"));
  EXPECT_TRUE(has(html.text(), "at the reference 1 of 2 fits is rejected"));
  EXPECT_TRUE(has(html.text(), "* P02, PSE free: separated"));
}

TEST(ReportDiscrimination, EndsThatBoundNothingAreOpen) {
  HtmlText html;
  ASSERT_TRUE(write_own_fractions(html, two_people()));
  EXPECT_FALSE(has(html.text(), "402367"));
  EXPECT_TRUE(has(html.text(), "0.2500 (from\u00a00.1000)"));
  EXPECT_TRUE(has(html.text(), "0.6270 (up\u00a0to\u00a01.125)"));
}

TEST(ReportDiscrimination, WhatMayBeWrongIsMarkedAndSaidBelow) {
  ResultsSection section = two_people();
  section.participants[1].cautions = {"answers the wrong way round"};
  HtmlText html;
  ASSERT_TRUE(write_own_fractions(html, section));
  EXPECT_TRUE(has(html.text(), "0.2500 (from\u00a00.1000) §<")) << html.text();
  EXPECT_TRUE(has(html.text(), "§ P01, PSE free: answers the wrong way round"));
  EXPECT_FALSE(has(html.text(), "§ P02"));
}

TEST(ReportDiscrimination, OtherSectionsHaveNoSuchTable) {
  HtmlText html;
  EXPECT_FALSE(write_own_fractions(html, {.name = "movement"}));
  EXPECT_TRUE(html.text().empty());
}

}  // namespace report_discrimination_test
}  // namespace jnd::analysis
