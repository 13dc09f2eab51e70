#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "analysis/fits/shifted_power_fit.h"
#include "analysis/mixed/mixed_derived.h"
#include "analysis/mixed/mixed_fit.h"
#include "analysis/mixed/power_people.h"
#include "bench/coverage_people.h"

namespace jnd::coverage {
namespace {

// ---- Mixed models of answers
// ------------------------------------------------------------------

/// Seven stimuli from -2 to 2 in two conditions. People differ in the place and in the slope of
/// their curves, in probits: u * condition, with random effects 1 + u.
struct TrueMixed {
  static constexpr double kIntercept = -0.3, kSlope = 1.4;
  static constexpr double kConditionIntercept = 0.4, kConditionSlope = -0.4;
  static constexpr double kInterceptSd = 0.4, kSlopeSd = 0.3, kCorrelation = 0.3;

  static MixedData drawn(int num_people, int num_trials, RandomStream& random) {
    constexpr int kLevels = 7;
    const Eigen::Index num_rows = 2L * kLevels * num_people;
    MixedData data{.names = {"(Intercept)", "u", "conditionB", "u:conditionB"},
                   .x = Eigen::MatrixXd(num_rows, 4)};
    MixedTerm people{.group = "participant",
                     .names = {"(Intercept)", "u"},
                     .z = Eigen::MatrixXd(num_rows, 2),
                     .num_groups = static_cast<std::size_t>(num_people)};
    Eigen::Index row = 0;
    for (int person = 0; person < num_people; ++person) {
      const double first = random.normal(), second = random.normal();
      const double own_intercept = kInterceptSd * first;
      const double own_slope =
          kSlopeSd *
          (kCorrelation * first + std::sqrt(1.0 - kCorrelation * kCorrelation) * second);
      for (int condition = 0; condition < 2; ++condition) {
        for (int level = 0; level < kLevels; ++level, ++row) {
          const double u = 2.0 * (level - 3) / 3.0;
          data.x.row(row) << 1.0, u, condition, u * condition;
          people.z.row(row) << 1.0, u;
          people.place.push_back(static_cast<std::uint32_t>(person));
          const double eta = kIntercept + own_intercept + condition * kConditionIntercept +
                             (kSlope + own_slope + condition * kConditionSlope) * u;
          const double p = curve_probability({}, eta);
          double num_yes = 0.0;
          for (int trial = 0; trial < num_trials; ++trial) {
            num_yes += random.with_probability(p) ? 1.0 : 0.0;
          }
          data.num_yes.push_back(num_yes);
          data.num_trials.push_back(num_trials);
        }
      }
    }
    data.terms.push_back(std::move(people));
    return data;
  }

  static StimulusLines lines() {
    StimulusLines lines;
    for (const double condition : {0.0, 1.0}) {
      lines.cells.push_back({.name = condition == 0.0 ? "condition A" : "condition B",
                             .levels = {condition},
                             .offset = Eigen::Vector4d(1.0, 0.0, condition, 0.0),
                             .slope = Eigen::Vector4d(0.0, 1.0, 0.0, condition)});
    }
    return lines;
  }
  static Eigen::VectorXd fixed() {
    return Eigen::Vector4d(kIntercept, kSlope, kConditionIntercept, kConditionSlope);
  }
};

std::string cover_mixed(int num_people, int num_nodes, int num_sets, std::uint64_t seed) {
  constexpr int kTrials = 10;
  // A bootstrap takes as long as hundreds of fits, so only some of the sets have one.
  constexpr int kRedraws = 420, kSetsPerBootstrap = 5;
  RandomStream random(seed, "coverage of a mixed model", {num_people, num_nodes});
  const StimulusLines lines = TrueMixed::lines();
  const Eigen::VectorXd truth = TrueMixed::fixed();
  const std::vector<DerivedQuantity> true_values =
      derived_quantities(lines, MixedLink::kProbit, 0.75, truth,
                         {.covariance = Eigen::MatrixXd::Zero(4, 4), .redrawn = {}});
  // Both PSEs and JNDs together, and both differences: they are alike.
  Coverage slope, interaction, values_delta, values_redrawn, differences_delta,
      differences_redrawn;
  for (int set = 0; set < num_sets; ++set) {
    const MixedData data = TrueMixed::drawn(num_people, kTrials, random);
    const MixedRefit refit(data, {.num_nodes = num_nodes});
    const MixedFit& fit = refit.fit();
    const bool exists = fit.status == FitStatus::kOk;
    const bool has_bootstrap = set % kSetsPerBootstrap == 0;
    const auto of_fixed = [&](int place) {
      if (!exists) return Interval{};
      const FixedEffect& effect = fit.fixed[static_cast<std::size_t>(place)];
      const double reach = 1.959963984540054 * effect.standard_error;
      return Interval{effect.estimate - reach, effect.estimate + reach};
    };
    slope.add(exists, of_fixed(1), truth(1));
    interaction.add(exists, of_fixed(3), truth(3));
    std::vector<DerivedQuantity> found = true_values;
    for (DerivedQuantity& one : found) one.ci95 = {};
    if (exists) {
      MixedUncertainty uncertainty = {.covariance = fit.fixed_covariance,
                                      .num_groups = static_cast<std::size_t>(num_people),
                                      .redrawn = {}};
      for (int index = 0; has_bootstrap && index < kRedraws; ++index) {
        uncertainty.redrawn.push_back(
            refit.redrawn(seed + static_cast<std::uint64_t>(set), index));
      }
      found = derived_quantities(lines, MixedLink::kProbit, 0.75, fit.estimates(), uncertainty);
    }
    for (std::size_t i = 0; i < found.size(); ++i) {
      const bool is_difference = found[i].name.find(" - ") != std::string::npos;
      const double value = *true_values[i].value;
      (is_difference ? differences_delta : values_delta).add(exists, found[i].ci95, value);
      if (!has_bootstrap) continue;
      (is_difference ? differences_redrawn : values_redrawn)
          .add(exists, found[i].bootstrap_ci95, value);
    }
  }
  return row_of({std::to_string(num_people),
                 num_nodes == 1 ? "Laplace" : std::to_string(num_nodes), slope.words(),
                 interaction.words(), values_delta.words(), values_redrawn.words(),
                 differences_delta.words(), differences_redrawn.words(),
                 std::to_string(slope.num_without)});
}

// ---- Power laws
// -------------------------------------------------------------------------------

const std::array<double, 8> kIntensities = {0.5, 0.8, 1.25, 2.0, 3.2, 5.0, 8.0, 12.5};

/// People whose exponents have mean 0.6, with errors of the logarithms.
std::string cover_power_of_people(int num_people, int num_sets, std::uint64_t seed) {
  RandomStream random(seed, "coverage of a power law of people", {num_people});
  Coverage exponent, factor;
  std::string method;
  for (int set = 0; set < num_sets; ++set) {
    std::vector<PersonMagnitude> rows;
    for (int person = 0; person < num_people; ++person) {
      const double log_k = 0.2 + 0.3 * random.normal();
      const double a = 0.6 + 0.15 * random.normal();
      for (const double intensity : kIntensities) {
        for (int repetition = 0; repetition < 3; ++repetition) {
          const double log_s = log_k + a * std::log(intensity) + 0.25 * random.normal();
          rows.push_back({"P" + std::to_string(person), {intensity, std::exp(log_s)}});
        }
      }
    }
    const PeoplePowerFit fit = fit_power_of_people(rows);
    const bool exists = fit.status == FitStatus::kOk;
    exponent.add(exists, fit.a_ci95, 0.6);
    factor.add(exists, fit.k_ci95, std::exp(0.2));
    if (exists) method = fit.interval_method;
  }
  return row_of({std::to_string(num_people), method, exponent.words(), factor.words(),
                 std::to_string(exponent.num_without)});
}

/// One person's law with a third parameter, of magnitudes with errors of the fit's kind.
std::string cover_shifted_power(PowerMethod method, PowerShift shift, int num_sets,
                                std::uint64_t seed) {
  RandomStream random(seed, "coverage of a shifted power law",
                      {static_cast<std::int64_t>(method), static_cast<std::int64_t>(shift)});
  const double third = shift == PowerShift::kNone ? 0.0 : 0.3;
  Coverage exponent, factor, shifted;
  for (int set = 0; set < num_sets; ++set) {
    std::vector<Magnitude> rows;
    for (const double intensity : kIntensities) {
      for (int repetition = 0; repetition < 3; ++repetition) {
        const double over = shift == PowerShift::kThreshold ? intensity - third : intensity;
        const double law =
            1.2 * std::pow(over, 0.6) + (shift == PowerShift::kOffset ? third : 0.0);
        const double magnitude = method == PowerMethod::kLogLog
                                     ? law * std::exp(0.15 * random.normal())
                                     : law + 0.2 * random.normal();
        rows.push_back({intensity, magnitude});
      }
    }
    const ShiftedPowerFit fit = fit_shifted_power(rows, method, shift);
    const bool exists = fit.status == FitStatus::kOk;
    exponent.add(exists, fit.a_ci95, 0.6);
    factor.add(exists, fit.k_ci95, 1.2);
    shifted.add(exists, fit.shift_ci95, third);
  }
  return row_of({std::string(to_string(method)), std::string(to_string(shift)),
                 exponent.words(), factor.words(),
                 shift == PowerShift::kNone ? "" : shifted.words(),
                 std::to_string(exponent.num_without)});
}

}  // namespace

void cover_mixed_models(int num_sets, std::uint64_t seed) {
  std::printf(
      "\n## Mixed models of answers: `jnd fit glmm`\n\n%d studies of two conditions within "
      "people, seven stimuli, ten answers to each. `u * condition`, random `1 + u`\n(sd 0.4 "
      "and 0.3, correlation 0.3), probit. D delta method "
      "with Student's t, B expanded percentiles of 420 redraws, in a fifth of the studies.\n"
      "Slopes: 1.96 standard errors.\n\n",
      num_sets);
  print_row({"people", "nodes", "slope of u", "u:condition", "PSE and JND, D", "PSE and JND, B",
             "their differences, D", "their differences, B", "studies without a fit"});
  std::printf("| --- | --- | --- | --- | --- | --- | --- | --- | --- |\n");
  std::vector<std::function<std::string()>> rows;
  for (const int num_people : {6, 13, 30}) {
    rows.emplace_back([=] { return cover_mixed(num_people, 1, num_sets, seed); });
  }
  rows.emplace_back([=] { return cover_mixed(13, 5, num_sets, seed); });
  print_rows(rows);
}

void cover_power_laws(int num_sets, std::uint64_t seed) {
  std::printf(
      "\n## A power law of people: `jnd fit power --participant`\n\n%d groups that judge eight "
      "intensities three times. Exponent 0.6, its sd between people 0.15.\n\n",
      num_sets);
  print_row({"people", "interval", "exponent", "k", "groups without a fit"});
  std::printf("| --- | --- | --- | --- | --- |\n");
  std::vector<std::function<std::string()>> rows;
  for (const int num_people : {5, 13, 40}) {
    rows.emplace_back([=] { return cover_power_of_people(num_people, num_sets, seed); });
  }
  print_rows(rows);
  std::printf(
      "\n## One person's power law with a threshold or an offset\n\n%d people who judge eight "
      "intensities three times. Exponent 0.6; threshold, or offset, 0.3. Profile "
      "intervals.\n\n",
      num_sets);
  print_row({"method", "third parameter", "exponent", "k", "threshold or offset",
             "people without a fit"});
  std::printf("| --- | --- | --- | --- | --- | --- |\n");
  rows.clear();
  const std::vector<std::pair<PowerMethod, PowerShift>> laws = {
      {PowerMethod::kNonlinear, PowerShift::kNone},
      {PowerMethod::kNonlinear, PowerShift::kThreshold},
      {PowerMethod::kNonlinear, PowerShift::kOffset},
      {PowerMethod::kLogLog, PowerShift::kThreshold}};
  for (const auto& [method, shift] : laws) {
    rows.emplace_back([=, method = method, shift = shift] {
      return cover_shifted_power(method, shift, num_sets, seed);
    });
  }
  print_rows(rows);
}

}  // namespace jnd::coverage
