#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "analysis/hierarchical/hierarchical_assumptions.h"
#include "analysis/hierarchical/hierarchical_fit.h"
#include "analysis/statistics/summary.h"
#include "bench/coverage_people.h"

namespace jnd::coverage {
namespace {

double pooled_truth(const Population& population, const Levels& levels, bool free_pse) {
  constexpr int kReach = 30;
  constexpr double kMany = 1e7;
  std::vector<AnswerCount> rows;
  for (const double x : levels.intensities) {
    double sum = 0.0, weight = 0.0;
    for (int i = -kReach; i <= kReach; ++i) {
      for (int j = -kReach; j <= kReach; ++j) {
        const double a = i / 6.0, b = j / 6.0, share = std::exp(-0.5 * (a * a + b * b));
        for (const double time : {-0.4, -0.2, 0.0, 0.2, 0.4}) {
          sum +=
              share * population.person(a, b).probability(std::log(x / levels.reference), time);
          weight += share;
        }
      }
    }
    rows.push_back({x, static_cast<std::int64_t>(std::llround(kMany * sum / weight)),
                    static_cast<std::int64_t>(kMany)});
  }
  return fit_psychometric(
             rows, {.reference = levels.reference, .free_pse = free_pse, .intervals = false})
      .weber_fraction.value_or(-1.0);
}

struct GroupEstimate {
  Coverage coverage;
  std::vector<double> logs;  ///< The values are ln(estimate / truth).

  void add(const std::optional<double>& value, const Interval& interval, double truth) {
    coverage.add(value.has_value(), interval, truth);
    if (value) logs.push_back(std::log(*value / truth));
  }
  /// Returns the bias of the geometric mean. Without bias it is above the truth as often as
  /// below.
  [[nodiscard]] std::string bias() const {
    const Summary summary = summary_of(logs);
    return summary.mean ? percent(std::expm1(*summary.mean)) : "-";
  }
};

using Group = std::vector<ParticipantAnswers>;

PsychometricFit pooled_fit(const Group& group, const std::vector<std::size_t>& drawn,
                           bool free_pse) {
  std::vector<AnswerCount> rows;
  for (const std::size_t person : drawn) {
    rows.insert(rows.end(), group[person].rows.begin(), group[person].rows.end());
  }
  return fit_psychometric(rows, {.reference = group.front().reference,
                                 .free_pse = free_pse,
                                 .intervals = false,
                                 .solver = Solver::kNewton});
}

void add_pooled(GroupEstimate& to, const Group& group, bool free_pse, double truth,
                std::uint64_t seed) {
  std::vector<std::size_t> everyone(group.size());
  for (std::size_t i = 0; i < group.size(); ++i) everyone[i] = i;
  const std::optional<double> fraction = pooled_fit(group, everyone, free_pse).weber_fraction;
  if (!fraction) return to.add(fraction, {}, truth);
  const Interval interval =
      resample_factor(group.size(), 400, seed, *fraction,
                      [&](const std::vector<std::size_t>& drawn) {
                        return pooled_fit(group, drawn, free_pse).weber_fraction;
                      })
          .ci95;
  to.add(fraction, interval, truth);
}

/// The people of a row of the table.
struct Row {
  Population population;
  Levels levels = kHardLevels;
  int num_people = 13;
};

/// The median person's fraction: in all sets, and in those without a caution.
struct MedianPerson {
  GroupEstimate all, without_caution;
  Coverage lapse_rate;
  int num_cautions = 0;

  void add(const HierarchicalFit& fit, const Population& population) {
    const double truth = population.truth();
    if (fit.status != FitStatus::kOk) {
      all.add(std::nullopt, {}, truth);
      return;
    }
    const HierarchicalCondition& one = fit.conditions.front();
    all.add(one.weber_fraction, one.weber_fraction_ci95, truth);
    if (fit.lapse_rate) lapse_rate.add(true, fit.lapse_rate_ci95, population.lapse);
    num_cautions += one.cautions.empty() ? 0 : 1;
    if (one.cautions.empty()) {
      without_caution.add(one.weber_fraction, one.weber_fraction_ci95, truth);
    }
  }
};

std::string cell(const GroupEstimate& one) {
  std::string words = one.coverage.words() + ", " + one.bias();
  if (one.coverage.num_without > 0) {
    words += " (" + std::to_string(one.coverage.num_without) + " without)";
  }
  return words;
}

/// Returns the cell: all sets, the share with a caution, and those without.
std::string cell(const MedianPerson& one, int num_sets) {
  return cell(one.all) + "; " +
         percent(static_cast<double>(one.num_cautions) / num_sets).substr(1) + " cautions, " +
         one.without_caution.coverage.words() + " without";
}

std::string cover_group(const Row& row, int num_sets, std::uint64_t seed) {
  constexpr int kTrials = 5;
  const Population& population = row.population;
  RandomStream random(seed, "coverage of a group",
                      {row.num_people, static_cast<std::int64_t>(1000.0 * population.spread_ln),
                       static_cast<std::int64_t>(1000.0 * population.place_sd_ln),
                       static_cast<std::int64_t>(1000.0 * population.lapse)});
  const double pooled = pooled_truth(population, row.levels, false);
  const double pooled_free = pooled_truth(population, row.levels, true);
  GroupEstimate of_pooled, of_pooled_free;
  MedianPerson median, without_lapses, at_reference;
  for (int set = 0; set < num_sets; ++set) {
    Group group;
    for (int person = 0; person < row.num_people; ++person) {
      const double slope_z = random.normal(), place_z = random.normal();
      group.push_back(
          {"P" + std::to_string(person), "", row.levels.reference,
           answers_of(population.person(slope_z, place_z), row.levels, kTrials, random)});
    }
    const auto own_seed = seed + static_cast<std::uint64_t>(set);
    add_pooled(of_pooled, group, false, pooled, own_seed);
    add_pooled(of_pooled_free, group, true, pooled_free, own_seed);
    median.add(fit_hierarchical(group, {}), population);
    const auto add_median = [&](MedianPerson& to, HierarchicalPse pse) {
      const HierarchicalOptions options{.pse = pse, .lapses = HierarchicalLapses::kNone};
      HierarchicalFit fit = fit_hierarchical(group, options);
      tell_assumptions(fit, group, options);
      to.add(fit, population);
    };
    add_median(without_lapses, HierarchicalPse::kPersonal);
    add_median(at_reference, HierarchicalPse::kReference);
  }
  return row_of({population.words, row.levels.words, std::to_string(row.num_people),
                 cell(median.all), cell(median.without_caution),
                 percent(static_cast<double>(median.num_cautions) / num_sets).substr(1),
                 median.lapse_rate.words(), cell(without_lapses, num_sets),
                 cell(at_reference, num_sets), cell(of_pooled_free), cell(of_pooled)});
}

}  // namespace

void cover_groups(int num_sets, std::uint64_t seed) {
  std::printf(
      "\n## A group: interval's coverage, and bias of the value\n\n"
      "%d groups a row, five answers at each of eight levels: those of group D of "
      "`viscosity_discrimination`, of which\nthe easiest is right in 92 %% at the median "
      "person's w = 0.7 (hard), and of group E, w = 0.22 (easy: 99.9 %%). Truth of\na median "
      "person's value: that w. Truth of a pooled curve's: what endlessly many people would "
      "give it, which is\nlarger the more they differ. Bias: of the geometric mean. Cautions: "
      "the share of sets that carry one (levels that are too\nhard, answers that scatter); "
      "lapse rate: coverage of its "
      "interval. Weibull noise is no form that a fit has: w is half the distance in ln "
      "between 15.87 and 84.13 %%, as every curve\nthat is even in ln has it; by (x84.13 - "
      "pse) / pse it is another number, 17 %% less in ln, which such a fit does not tell. "
      "Without lapses, and with the pse at the\nreference, are options of `jnd fit "
      "hierarchical` that assume what few people do: a note names the assumption beside "
      "every\nvalue, and a caution says where the answers speak against it.\n\n",
      num_sets);
  print_row({"people differ", "levels", "n", "median person, pse and lapse rate free",
             "of those without a caution", "cautions", "lapse rate",
             "median person, no lapses, pse free", "median person, no lapses, pse = reference",
             "pooled curve, pse free", "pooled curve, pse = reference"});
  std::printf("| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n");
  std::vector<std::function<std::string()>> rows;
  const auto add = [&](Row row) {
    rows.emplace_back(
        [row = std::move(row), num_sets, seed] { return cover_group(row, num_sets, seed); });
  };
  for (const double spread : {0.25, 0.4}) {
    for (const double place : {0.0, 0.15}) {
      char words[96];
      std::snprintf(words, sizeof words, "by %.2f in ln, pse by %.2f", spread, place);
      add({{.words = words, .spread_ln = spread, .place_sd_ln = place}});
    }
  }
  add({.population = {.words = "by 0.40 in ln, pse by 0.15",
                      .spread_ln = 0.4,
                      .place_sd_ln = 0.15},
       .num_people = 26});
  for (const bool easy : {false, true}) {
    const Levels& levels = easy ? kEasyLevels : kHardLevels;
    const auto cover = [&](const std::string& words, double lapse, double drift,
                           Sigmoid sigmoid, bool even_truth) {
      add({.population = {.words = words,
                          .weber_fraction = easy ? 0.22 : 0.7,
                          .spread_ln = 0.25,
                          .place_sd_ln = 0.15,
                          .drift_ln = drift,
                          .lapse = lapse,
                          .sigmoid = sigmoid,
                          .even_truth = even_truth},
           .levels = levels});
    };
    const std::string people = "by 0.25 in ln, pse by 0.15";
    if (easy) cover(people, 0.0, 0.0, Sigmoid::kNormal, false);
    cover(people + ", 1 % lapses", 0.01, 0.0, Sigmoid::kNormal, false);
    cover(people + ", 3 % lapses", 0.03, 0.0, Sigmoid::kNormal, false);
    cover(people + ", 5 % lapses", 0.05, 0.0, Sigmoid::kNormal, false);
    cover(people + ", drift 0.2 in ln", 0.0, 0.2, Sigmoid::kNormal, false);
    const std::string misspecified = "misspecified: Weibull noise, drift 0.2 in ln, 5 % lapses";
    cover(misspecified, 0.05, 0.2, Sigmoid::kWeibull, true);
    cover(misspecified + ", truth (x84.13 - pse) / pse", 0.05, 0.2, Sigmoid::kWeibull, false);
  }
  print_rows(rows);
}

}  // namespace jnd::coverage
