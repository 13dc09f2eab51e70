#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "analysis/hierarchical/hierarchical_fit.h"
#include "analysis/statistics/summary.h"
#include "bench/coverage_people.h"

namespace jnd::coverage {
namespace {

/// Draws one person's answers, of which two at one level correlate by rho: Polya's urn, whose
/// counts are beta-binomial.
std::vector<AnswerCount> scattered_answers_of(const Person& person, const Levels& levels,
                                              int num_trials, double rho,
                                              RandomStream& random) {
  const double phi = rho / (1.0 - rho);
  std::vector<AnswerCount> rows;
  for (const double x : levels.intensities) {
    AnswerCount row{.intensity = x, .num_trials = num_trials};
    const double p = person.probability(std::log(x / levels.reference), 0.0);
    for (int trial = 0; trial < num_trials; ++trial) {
      const double next = (p + phi * static_cast<double>(row.num_yes)) / (1.0 + phi * trial);
      row.num_yes += random.with_probability(next) ? 1 : 0;
    }
    rows.push_back(row);
  }
  return rows;
}

struct ScatteredEstimate {
  Coverage coverage;
  std::vector<double> logs;  ///< The values are ln(estimate / truth).

  void add(const HierarchicalFit& fit, double truth) {
    const bool exists = fit.status == FitStatus::kOk && fit.conditions[0].weber_fraction;
    coverage.add(exists, exists ? fit.conditions[0].weber_fraction_ci95 : Interval{}, truth);
    if (exists) logs.push_back(std::log(*fit.conditions[0].weber_fraction / truth));
  }
  [[nodiscard]] std::string words() const {
    const Summary summary = summary_of(logs);
    std::string cell = coverage.words();
    if (summary.mean) cell += ", " + percent(std::expm1(*summary.mean));
    if (coverage.num_without > 0) {
      cell += " (" + std::to_string(coverage.num_without) + " without)";
    }
    return cell;
  }
};

std::string cover_scattered(double rho, int num_trials, int num_sets, std::uint64_t seed) {
  constexpr int kPeople = 13;
  const Population population{.weber_fraction = 0.22, .spread_ln = 0.25, .place_sd_ln = 0.05};
  RandomStream random(seed, "coverage of scattered answers",
                      {static_cast<std::int64_t>(1000.0 * rho), num_trials});
  ScatteredEstimate independent, beta_binomial;
  int num_found = 0;
  for (int set = 0; set < num_sets; ++set) {
    std::vector<ParticipantAnswers> group;
    for (int person = 0; person < kPeople; ++person) {
      const double slope_z = random.normal(), place_z = random.normal();
      group.push_back({"P" + std::to_string(person), "", kEasyLevels.reference,
                       scattered_answers_of(population.person(slope_z, place_z), kEasyLevels,
                                            num_trials, rho, random)});
    }
    independent.add(fit_hierarchical(group, {}), population.truth());
    const HierarchicalFit fit =
        fit_hierarchical(group, {.beta_binomial = true, .correlation_interval = false});
    beta_binomial.add(fit, population.truth());
    num_found += fit.scatter && fit.scatter->p_value.value_or(1.0) < 0.05 ? 1 : 0;
  }
  char words[16];
  std::snprintf(words, sizeof words, "%.2f", rho);
  return row_of({words, std::to_string(num_trials), independent.words(), beta_binomial.words(),
                 percent(static_cast<double>(num_found) / num_sets).substr(1)});
}

}  // namespace

void cover_robust(int num_sets, std::uint64_t seed) {
  std::printf(
      "\n## A group whose answers scatter: the median person's Weber fraction\n\n"
      "%d groups of 13 a row, w = 0.22, the levels called easy above; two answers of one "
      "person "
      "to one level correlate by rho.\nPse and lapse rate free. Coverage of the interval, and "
      "bias of the geometric mean; last, in how many sets the test against\nrho = 0 has p < "
      "0.05.\n\n",
      num_sets);
  print_row({"rho", "answers a level", "without the option", "--overdispersion beta-binomial",
             "rho found"});
  std::printf("| --- | --- | --- | --- | --- |\n");
  std::vector<std::function<std::string()>> rows;
  for (const int num_trials : {5, 20}) {
    for (const double rho : {0.0, 0.1, 0.25}) {
      rows.emplace_back([=] { return cover_scattered(rho, num_trials, num_sets, seed); });
    }
  }
  print_rows(rows);
}

}  // namespace jnd::coverage
