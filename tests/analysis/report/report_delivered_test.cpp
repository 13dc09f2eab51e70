#include "analysis/report/report_delivered.h"

#include <gtest/gtest.h>

#include <string>

namespace jnd::analysis {
namespace report_delivered_test {

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

Estimate fraction(double value, double low, double high) {
  return {.name = "group_d.weber_fraction",
          .value = value,
          .ci95 = {low, high},
          .unit = "1",
          .primary = true};
}

StudyResults results_with(const Estimate& estimate) {
  StudyResults results;
  results.sections.push_back({.name = "group_d", .estimates = {estimate}});
  return results;
}

/// Returns results whose delivered value is 0.3. The commanded value is 0.6.
DeliveredReport delivered_by_hand() {
  Estimate estimate = fraction(0.3, 0.2, 0.45);
  estimate.device_ci95 = {0.29, 0.31};
  return {.results = results_with(estimate),
          .devices = {"a robot 17: gain 0.9."},
          .num_trials = 90,
          .num_left_out = 1};
}

TEST(ReportDelivered, HasBothAndWhatTheDeviceAloneLeavesOpen) {
  HtmlText html;
  write_delivered(html, results_with(fraction(0.6, 0.4, 0.9)), delivered_by_hand(), {});
  EXPECT_TRUE(has(html.text(), "Commanded and delivered"));
  EXPECT_TRUE(has(html.text(), "0.6000 (0.4000\u00a0to\u00a00.9000)")) << html.text();
  EXPECT_TRUE(has(html.text(), "0.3000 (0.2000\u00a0to\u00a00.4500)")) << html.text();
  EXPECT_TRUE(has(html.text(), "0.2900 to 0.3100")) << html.text();
  EXPECT_TRUE(has(html.text(), "a robot 17"));
  EXPECT_TRUE(has(html.text(), "90 trials as delivered; 1 trial left out"));
}

TEST(ReportDelivered, TheFigureHasTheSameNumbers) {
  const auto figures =
      delivered_figures(results_with(fraction(0.6, 0.4, 0.9)), delivered_by_hand(), {});
  ASSERT_EQ(figures.size(), 1U);
  const FigureTable& table = figures[0].tables.front();
  ASSERT_EQ(table.rows.size(), 1U);
  const auto number = [&](const std::string& column) {
    return table.rows[0].at(table.place_of(column)).number.value();
  };
  EXPECT_EQ(number("commanded"), 0.6);
  EXPECT_EQ(number("commanded_high"), 0.9);
  EXPECT_EQ(number("delivered"), 0.3);
  EXPECT_EQ(number("delivered_low"), 0.2);
  EXPECT_EQ(number("device_low"), 0.29);
  EXPECT_EQ(number("device_high"), 0.31);
}

TEST(ReportDelivered, WhatTheDeviceHasNoPartInIsNotCompared) {
  DeliveredReport delivered = delivered_by_hand();
  delivered.results.sections[0].estimates[0].device_ci95 = {};
  HtmlText html;
  write_delivered(html, results_with(fraction(0.6, 0.4, 0.9)), delivered, {});
  EXPECT_EQ(html.text(), "");
  EXPECT_TRUE(delivered_figures(results_with(fraction(0.6, 0.4, 0.9)), delivered, {}).empty());
  // Values that are not primary, or that the commanded results lack, are not written either.
  delivered = delivered_by_hand();
  delivered.results.sections[0].estimates[0].primary = false;
  write_delivered(html, results_with(fraction(0.6, 0.4, 0.9)), delivered, {});
  write_delivered(html, {}, delivered_by_hand(), {});
  EXPECT_EQ(html.text(), "");
}

}  // namespace report_delivered_test
}  // namespace jnd::analysis
