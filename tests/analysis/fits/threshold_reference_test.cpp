#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "analysis/fits/detection_fit.h"
#include "analysis/fits/psychometric_fit.h"
#include "analysis/fits/same_different_fit.h"
#include "analysis/fits/signal_detection.h"
#include "analysis/threshold_group.h"
#include "support/places.h"

namespace jnd::analysis {
namespace threshold_reference_test {

using nlohmann::json;

/// data/reference/thresholds: computed by SciPy, see the script beside it.
const json& reference() {
  static const json kDocument = [] {
    std::ifstream in(test_support::source_folder().string() +
                     "/data/reference/thresholds/thresholds.json");
    return json::parse(in);
  }();
  return kDocument;
}

std::vector<AnswerCount> rows_of(const json& data) {
  std::vector<AnswerCount> rows;
  for (const json& row : data) rows.push_back({row[0], row[1], row[2]});
  return rows;
}

void expect_close(const std::optional<double>& found, const json& expected,
                  const std::string& where) {
  ASSERT_EQ(found.has_value(), !expected.is_null()) << where;
  if (!found) return;
  const double value = expected.get<double>();
  EXPECT_NEAR(*found, value, 1e-6 * std::max(std::fabs(value), 1e-3)) << where;
}

void expect_close(const Interval& found, const json& expected, const std::string& where) {
  expect_close(found.low, expected.at(0), where + " low");
  expect_close(found.high, expected.at(1), where + " high");
}

TEST(ThresholdReference, EveryDetectionFitAgreesWithScipy) {
  for (const json& c : reference().at("detection")) {
    const DetectionFit fit = fit_detection(rows_of(c.at("data")));
    const json& expected = c.at("expected");
    const std::string name = c.at("name");
    ASSERT_EQ(fit.status, FitStatus::kOk) << name << ": " << fit.reason;
    expect_close(fit.threshold, expected.at("threshold"), name + ": threshold");
    expect_close(fit.threshold_ci95, expected.at("threshold_ci95"), name + ": threshold");
    expect_close(fit.spread_ln, expected.at("spread_ln"), name + ": spread");
    expect_close(fit.spread_ln_ci95, expected.at("spread_ln_ci95"), name + ": spread");
    expect_close(fit.false_alarm_rate, expected.at("false_alarm_rate"), name + ": g");
    expect_close(fit.log_likelihood, expected.at("log_likelihood"), name + ": likelihood");
  }
}

TEST(ThresholdReference, EverySameDifferentFitAgreesWithScipy) {
  for (const json& c : reference().at("same_different")) {
    const SameDifferentFit fit = fit_same_different(rows_of(c.at("data")), c.at("reference"));
    const json& expected = c.at("expected");
    const std::string name = c.at("name");
    ASSERT_EQ(fit.status, FitStatus::kOk) << name << ": " << fit.reason;
    expect_close(fit.weber_fraction, expected.at("weber_fraction"), name + ": w");
    expect_close(fit.weber_fraction_ci95, expected.at("weber_fraction_ci95"), name + ": w");
    expect_close(fit.criterion_ln, expected.at("criterion_ln"), name + ": k");
    expect_close(fit.criterion_ln_ci95, expected.at("criterion_ln_ci95"), name + ": k");
    expect_close(fit.false_alarm_rate, expected.at("false_alarm_rate"), name + ": F");
    expect_close(fit.log_likelihood, expected.at("log_likelihood"), name + ": likelihood");
  }
}

TEST(ThresholdReference, EveryFitByIntervalOrderAgreesWithScipy) {
  for (const json& c : reference().at("by_order")) {
    std::vector<AnswerCount> rows;
    for (const json& row : c.at("data")) rows.push_back({row[0], row[2], row[3], row[1]});
    const PsychometricFit fit = fit_psychometric(
        rows, {.reference = c.at("reference"), .free_pse = c.at("free_pse"), .by_order = true});
    const json& expected = c.at("expected");
    const std::string name = c.at("name");
    ASSERT_EQ(fit.status, FitStatus::kOk) << name << ": " << fit.reason;
    expect_close(fit.weber_fraction, expected.at("weber_fraction"), name + ": w");
    expect_close(fit.weber_fraction_ci95, expected.at("weber_fraction_ci95"), name + ": w");
    expect_close(fit.order_effect_ln, expected.at("order_effect_ln"), name + ": order");
    expect_close(fit.pse, expected.at("pse"), name + ": pse");
    expect_close(fit.log_likelihood, expected.at("log_likelihood"), name + ": likelihood");
    ASSERT_EQ(fit.pse_ci95.has_value(), !expected.at("pse_ci95").is_null()) << name;
    if (fit.pse_ci95) expect_close(*fit.pse_ci95, expected.at("pse_ci95"), name + ": pse");
  }
}

TEST(ThresholdReference, SensitivityAndCriterionAgreeWithScipy) {
  for (const json& c : reference().at("signal_detection")) {
    const json& n = c.at("counts");
    const SignalDetection found = signal_detection({n[0], n[1], n[2], n[3]});
    expect_close(found.d_prime, c.at("d_prime"), "d'");
    expect_close(found.criterion, c.at("criterion"), "c");
  }
}

TEST(ThresholdReference, GeometricMeansAgreeWithScipy) {
  for (const json& c : reference().at("geometric_mean")) {
    OwnNumbers values;
    for (const json& value : c.at("values")) {
      values["P" + std::to_string(values.size())] = value.get<double>();
    }
    ResultsSection section;
    add_geometric_mean(section, {.name = "x"}, values);
    ASSERT_EQ(section.estimates.size(), 2U);
    expect_close(section.estimates[0].value, c.at("mean"), "mean");
    expect_close(section.estimates[0].ci95, c.at("ci95"), "mean");
    expect_close(section.estimates[1].value, c.at("sd_ln"), "sd");
    EXPECT_EQ(section.estimates[1].name, "x_sd_ln");
  }
}

}  // namespace threshold_reference_test
}  // namespace jnd::analysis
