#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "analysis/fits/detection_fit.h"
#include "analysis/fits/psychometric_fit.h"
#include "analysis/fits/same_different_fit.h"
#include "analysis/fits/signal_detection.h"
#include "analysis/reference_values.h"
#include "analysis/results/threshold_group.h"
#include "support/reference_data.h"

namespace jnd::analysis {
namespace threshold_reference_test {

using nlohmann::json;

/// The reference in data/reference/thresholds was computed by SciPy with the script beside it.
const json& reference() { return test_support::reference_data("thresholds/thresholds.json"); }

TEST(ThresholdReference, EveryDetectionFitAgreesWithScipy) {
  for (const json& c : reference().at("detection")) {
    const DetectionFit fit = fit_detection(reference_answers(c.at("data")));
    const json& expected = c.at("expected");
    const std::string name = c.at("name");
    ASSERT_EQ(fit.status, FitStatus::kOk) << name << ": " << fit.reason;
    expect_reference(fit.threshold, expected.at("threshold"), 1e-6, name + ": threshold");
    expect_reference(fit.threshold_ci95, expected.at("threshold_ci95"), 1e-6,
                     name + ": threshold");
    expect_reference(fit.spread_ln, expected.at("spread_ln"), 1e-6, name + ": spread");
    expect_reference(fit.spread_ln_ci95, expected.at("spread_ln_ci95"), 1e-6,
                     name + ": spread");
    expect_reference(fit.false_alarm_rate, expected.at("false_alarm_rate"), 1e-6, name + ": g");
    expect_reference(fit.log_likelihood, expected.at("log_likelihood"), 1e-6,
                     name + ": likelihood");
  }
}

TEST(ThresholdReference, EverySameDifferentFitAgreesWithScipy) {
  for (const json& c : reference().at("same_different")) {
    const SameDifferentFit fit =
        fit_same_different(reference_answers(c.at("data")), c.at("reference"));
    const json& expected = c.at("expected");
    const std::string name = c.at("name");
    ASSERT_EQ(fit.status, FitStatus::kOk) << name << ": " << fit.reason;
    expect_reference(fit.weber_fraction, expected.at("weber_fraction"), 1e-6, name + ": w");
    expect_reference(fit.weber_fraction_ci95, expected.at("weber_fraction_ci95"), 1e-6,
                     name + ": w");
    expect_reference(fit.criterion_ln, expected.at("criterion_ln"), 1e-6, name + ": k");
    expect_reference(fit.criterion_ln_ci95, expected.at("criterion_ln_ci95"), 1e-6,
                     name + ": k");
    expect_reference(fit.false_alarm_rate, expected.at("false_alarm_rate"), 1e-6, name + ": F");
    expect_reference(fit.log_likelihood, expected.at("log_likelihood"), 1e-6,
                     name + ": likelihood");
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
    expect_reference(fit.weber_fraction, expected.at("weber_fraction"), 1e-6, name + ": w");
    expect_reference(fit.weber_fraction_ci95, expected.at("weber_fraction_ci95"), 1e-6,
                     name + ": w");
    expect_reference(fit.order_effect_ln, expected.at("order_effect_ln"), 1e-6,
                     name + ": order");
    expect_reference(fit.pse, expected.at("pse"), 1e-6, name + ": pse");
    expect_reference(fit.log_likelihood, expected.at("log_likelihood"), 1e-6,
                     name + ": likelihood");
    ASSERT_EQ(fit.pse_ci95.has_value(), !expected.at("pse_ci95").is_null()) << name;
    if (!fit.pse_ci95) continue;
    expect_reference(*fit.pse_ci95, expected.at("pse_ci95"), 1e-6, name + ": pse");
  }
}

TEST(ThresholdReference, SensitivityAndCriterionAgreeWithScipy) {
  for (const json& c : reference().at("signal_detection")) {
    const json& n = c.at("counts");
    const SignalDetection found = signal_detection({n[0], n[1], n[2], n[3]});
    expect_reference(found.d_prime, c.at("d_prime"), 1e-6, "d'");
    expect_reference(found.criterion, c.at("criterion"), 1e-6, "c");
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
    expect_reference(section.estimates[0].value, c.at("mean"), 1e-6, "mean");
    expect_reference(section.estimates[0].ci95, c.at("ci95"), 1e-6, "mean");
    expect_reference(section.estimates[1].value, c.at("sd_ln"), 1e-6, "sd");
    EXPECT_EQ(section.estimates[1].name, "x_sd_ln");
  }
}

}  // namespace threshold_reference_test
}  // namespace jnd::analysis
