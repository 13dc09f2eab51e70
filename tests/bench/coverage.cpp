// What intervals and group values are worth: draws people whose Weber fractions are known,
// analyses their answers, and counts how often the intervals hold the truth. `./dev coverage`
// prints the page data/reference/coverage/README.md. The same seed gives the same page.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "analysis/fits/psychometric_fit.h"
#include "analysis/fits/sigmoid.h"
#include "analysis/groups/hierarchical_fit.h"
#include "analysis/groups/summary.h"
#include "core/random_stream.h"

namespace {

using namespace jnd::analysis;
using jnd::core::RandomStream;

constexpr double kReference = 1.853;
const std::vector<double> kLevels = {1.093, 1.237, 1.646, 1.7495, 2.203, 2.553, 3.185, 3.883};

/// A person: z = slope (ln(x / reference) - place), with what no fit knows of.
struct Person {
  double slope = 1.0, place = 0.0, drift = 0.0, lapse = 0.0;
  Sigmoid sigmoid = Sigmoid::kNormal;

  /// `time` from -0.5 at the first trial to 0.5 at the last.
  [[nodiscard]] double probability(double x, double time) const {
    const double z = slope * (std::log(x / kReference) - place - drift * time);
    return lapse + (1.0 - 2.0 * lapse) * sigmoid_tails(sigmoid, z).lower;
  }
};

/// Whom people are drawn from.
struct Population {
  std::string words;
  double weber_fraction = 0.7;  ///< Of the median person.
  double spread_ln = 0.0;       ///< Sd of ln ln(1 + w).
  double place_sd_ln = 0.0;
  double drift_ln = 0.0, lapse = 0.0;
  Sigmoid sigmoid = Sigmoid::kNormal;

  [[nodiscard]] Person person(double slope_z, double place_z) const {
    return {sigmoid_jnd(sigmoid) / std::log1p(weber_fraction) * std::exp(spread_ln * slope_z),
            place_sd_ln * place_z, drift_ln, lapse, sigmoid};
  }
};

std::vector<AnswerCount> answers_of(const Person& person, int num_trials,
                                    RandomStream& random) {
  std::vector<AnswerCount> rows;
  for (const double x : kLevels) {
    AnswerCount row{.intensity = x, .num_trials = num_trials};
    for (int trial = 0; trial < num_trials; ++trial) {
      const double time = (trial + 0.5) / num_trials - 0.5;
      row.num_yes += random.with_probability(person.probability(x, time)) ? 1 : 0;
    }
    rows.push_back(row);
  }
  return rows;
}

/// How often an interval held the truth; an open end holds whatever lies there.
struct Coverage {
  int num_sets = 0, num_without = 0, num_held = 0;

  void add(bool exists, const Interval& interval, double truth) {
    ++num_sets;
    if (!exists || (!interval.low && !interval.high)) {
      ++num_without;
      return;
    }
    num_held +=
        interval.low.value_or(-1e300) <= truth && truth <= interval.high.value_or(1e300);
  }
  [[nodiscard]] std::string words() const {
    const int with = num_sets - num_without;
    if (with == 0) return "-";
    char text[64];
    std::snprintf(text, sizeof text, "%.1f %%", 100.0 * num_held / with);
    return text;
  }
};

void print_row(const std::vector<std::string>& cells) {
  for (const std::string& cell : cells) std::printf("| %s ", cell.c_str());
  std::printf("|\n");
}

std::string percent(double value) {
  char text[64];
  std::snprintf(text, sizeof text, "%+.1f %%", 100.0 * value);
  return text;
}

// --- one person
// -------------------------------------------------------------------------------

void cover_one_person(int num_sets, std::uint64_t seed) {
  std::printf(
      "\n## One person: intervals of the Weber fraction\n\n"
      "%d data sets, eight levels. LR: likelihood ratio; the bootstraps: 400 refits of "
      "the first %d.\nSets without a fit have no interval and are left out of the "
      "share.\n\n",
      num_sets, num_sets / 4);
  print_row({"answers a level", "w", "LR", "LR, pse free", "parametric percentile",
             "parametric BCa", "nonparametric percentile", "nonparametric BCa",
             "sets without a fit"});
  std::printf("| --- | --- | --- | --- | --- | --- | --- | --- | --- |\n");
  for (const int num_trials : {5, 65}) {
    for (const double w : {0.3, 0.7}) {
      RandomStream random(seed, "coverage of one person",
                          {num_trials, static_cast<std::int64_t>(100.0 * w)});
      Coverage ratio, ratio_free, bootstrap[4];
      for (int set = 0; set < num_sets; ++set) {
        const std::vector<AnswerCount> rows =
            answers_of(Population{.weber_fraction = w}.person(0, 0), num_trials, random);
        const auto fit = [&](bool free_pse, BootstrapKind kind, int num_bootstrap) {
          return fit_psychometric(rows, {.reference = kReference,
                                         .free_pse = free_pse,
                                         .num_bootstrap = num_bootstrap,
                                         .bootstrap_kind = kind,
                                         .solver = Solver::kNewton});
        };
        const PsychometricFit fixed = fit(false, BootstrapKind::kParametric, 0);
        const PsychometricFit free = fit(true, BootstrapKind::kParametric, 0);
        ratio.add(fixed.status == FitStatus::kOk, fixed.weber_fraction_ci95, w);
        ratio_free.add(free.status == FitStatus::kOk, free.weber_fraction_ci95, w);
        if (set >= num_sets / 4) continue;
        int place = 0;
        for (const BootstrapKind kind :
             {BootstrapKind::kParametric, BootstrapKind::kNonparametric}) {
          const BootstrapInterval interval = fit(false, kind, 400).bootstrap;
          bootstrap[place++].add(fixed.status == FitStatus::kOk, interval.ci95, w);
          bootstrap[place++].add(fixed.status == FitStatus::kOk, interval.bca_ci95, w);
        }
      }
      char fraction[16];
      std::snprintf(fraction, sizeof fraction, "%.1f", w);
      print_row({std::to_string(num_trials), fraction, ratio.words(), ratio_free.words(),
                 bootstrap[0].words(), bootstrap[1].words(), bootstrap[2].words(),
                 bootstrap[3].words(), std::to_string(ratio.num_without)});
    }
  }
}

// --- a group
// ----------------------------------------------------------------------------------

/// What an endless study would find for the pooled curve: the fit to the mean probabilities
/// over people on an even grid of their normal scores.
double pooled_truth(const Population& population, bool free_pse) {
  constexpr int kReach = 30;
  constexpr double kMany = 1e7;
  std::vector<AnswerCount> rows;
  for (const double x : kLevels) {
    double sum = 0.0, weight = 0.0;
    for (int i = -kReach; i <= kReach; ++i) {
      for (int j = -kReach; j <= kReach; ++j) {
        const double a = i / 6.0, b = j / 6.0, share = std::exp(-0.5 * (a * a + b * b));
        for (const double time : {-0.4, -0.2, 0.0, 0.2, 0.4}) {
          sum += share * population.person(a, b).probability(x, time);
          weight += share;
        }
      }
    }
    rows.push_back({x, static_cast<std::int64_t>(std::llround(kMany * sum / weight)),
                    static_cast<std::int64_t>(kMany)});
  }
  return fit_psychometric(rows,
                          {.reference = kReference, .free_pse = free_pse, .intervals = false})
      .weber_fraction.value_or(-1.0);
}

struct GroupEstimate {
  Coverage coverage;
  std::vector<double> logs;  ///< ln(estimate / truth)

  void add(const std::optional<double>& value, const Interval& interval, double truth) {
    coverage.add(value.has_value(), interval, truth);
    if (value) logs.push_back(std::log(*value / truth));
  }
  /// Of the geometric mean: as often above the truth as below.
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
  return fit_psychometric(rows, {.reference = kReference,
                                 .free_pse = free_pse,
                                 .intervals = false,
                                 .solver = Solver::kNewton});
}

void add_pooled(GroupEstimate& to, const Group& group, bool free_pse, double truth,
                std::uint64_t seed) {
  std::vector<std::size_t> everyone(group.size());
  for (std::size_t i = 0; i < group.size(); ++i) everyone[i] = i;
  const Interval interval =
      resample_participants(group.size(), 400, seed,
                            [&](const std::vector<std::size_t>& drawn) {
                              return pooled_fit(group, drawn, free_pse).weber_fraction;
                            })
          .ci95;
  to.add(pooled_fit(group, everyone, free_pse).weber_fraction, interval, truth);
}

void cover_group(const Population& population, int num_people, int num_sets,
                 std::uint64_t seed) {
  constexpr int kTrials = 5;
  RandomStream random(seed, "coverage of a group",
                      {num_people, static_cast<std::int64_t>(1000.0 * population.spread_ln),
                       static_cast<std::int64_t>(1000.0 * population.place_sd_ln),
                       static_cast<std::int64_t>(1000.0 * population.lapse)});
  const double truth = population.weber_fraction;
  const double pooled = pooled_truth(population, false);
  const double pooled_free = pooled_truth(population, true);
  GroupEstimate of_pooled, of_pooled_free, of_median, of_median_lapses, of_median_reference;
  for (int set = 0; set < num_sets; ++set) {
    Group group;
    for (int person = 0; person < num_people; ++person) {
      const double slope_z = random.normal(), place_z = random.normal();
      group.push_back({"P" + std::to_string(person), "", kReference,
                       answers_of(population.person(slope_z, place_z), kTrials, random)});
    }
    const auto own_seed = seed + static_cast<std::uint64_t>(set);
    add_pooled(of_pooled, group, false, pooled, own_seed);
    add_pooled(of_pooled_free, group, true, pooled_free, own_seed);
    const auto add_median = [&](GroupEstimate& to, const HierarchicalOptions& options) {
      const HierarchicalFit fit = fit_hierarchical(group, options);
      if (fit.status == FitStatus::kOk) {
        to.add(fit.conditions[0].weber_fraction, fit.conditions[0].weber_fraction_ci95, truth);
      } else {
        to.add(std::nullopt, {}, truth);
      }
    };
    add_median(of_median_lapses, {.lapses = HierarchicalLapses::kCommon});
    add_median(of_median, {});
    add_median(of_median_reference, {.pse = HierarchicalPse::kReference});
  }
  const auto cell = [](const GroupEstimate& one) {
    std::string words = one.coverage.words() + ", " + one.bias();
    if (one.coverage.num_without > 0) {
      words += " (" + std::to_string(one.coverage.num_without) + " without)";
    }
    return words;
  };
  print_row({population.words, std::to_string(num_people), cell(of_median_lapses),
             cell(of_median), cell(of_median_reference), cell(of_pooled_free),
             cell(of_pooled)});
  std::fflush(stdout);
}

void cover_groups(int num_sets, std::uint64_t seed) {
  std::printf(
      "\n## A group: interval's coverage, and bias of the value\n\n"
      "%d groups a row, five answers at each of eight levels, median person's w = 0.7. Truth "
      "of "
      "a median person's value:\nthat w. Truth of a pooled curve's: what endlessly many people "
      "would give it, which is larger the more they differ.\nBias: of the geometric mean.\n\n",
      num_sets);
  print_row({"people differ", "n", "median person, pse and lapse rate free",
             "median person, pse free", "median person, pse = reference",
             "pooled curve, pse free", "pooled curve, pse = reference"});
  std::printf("| --- | --- | --- | --- | --- | --- | --- |\n");
  for (const double spread : {0.25, 0.4}) {
    for (const double place : {0.0, 0.15}) {
      char words[96];
      std::snprintf(words, sizeof words, "by %.2f in ln, pse by %.2f", spread, place);
      cover_group({.words = words, .spread_ln = spread, .place_sd_ln = place}, 13, num_sets,
                  seed);
    }
  }
  cover_group({.words = "by 0.40 in ln, pse by 0.15", .spread_ln = 0.4, .place_sd_ln = 0.15},
              26, num_sets, seed);
  for (const double lapse : {0.01, 0.03}) {
    char words[96];
    std::snprintf(words, sizeof words, "by 0.25 in ln, pse by 0.15, %.0f %% lapses",
                  100.0 * lapse);
    cover_group({.words = words, .spread_ln = 0.25, .place_sd_ln = 0.15, .lapse = lapse}, 13,
                num_sets, seed);
  }
  cover_group({.words = "misspecified: Weibull noise, drift 0.2 in ln, 5 % lapses",
               .spread_ln = 0.25,
               .place_sd_ln = 0.15,
               .drift_ln = 0.2,
               .lapse = 0.05,
               .sigmoid = Sigmoid::kWeibull},
              13, num_sets, seed);
}

// --- two conditions
// ---------------------------------------------------------------------------

/// People in two conditions: how far their slopes go together, and whether their places do.
struct Pair {
  std::string words;
  int num_people = 13;
  double spread_ln = 0.3;  ///< Sd of what is the same in both conditions.
  double own_ln = 0.0;     ///< Sd of what is of its own in each.
  bool own_places = false;
  double lapse = 0.0;
};

void cover_pair(const Pair& pair, int num_sets, std::uint64_t seed) {
  const double truth = std::log(std::log1p(0.3)) - std::log(std::log1p(0.7));
  RandomStream random(seed, "coverage of a difference",
                      {pair.num_people, static_cast<std::int64_t>(1000.0 * pair.spread_ln),
                       static_cast<std::int64_t>(1000.0 * pair.own_ln), pair.own_places,
                       static_cast<std::int64_t>(1000.0 * pair.lapse)});
  Coverage coverage;
  std::vector<double> errors, widths;
  for (int set = 0; set < num_sets; ++set) {
    Group group;
    for (int person = 0; person < pair.num_people; ++person) {
      const double slope_z = random.normal();
      double place_z = random.normal();
      for (const double w : {0.7, 0.3}) {
        if (pair.own_places) place_z = random.normal();
        Person drawn = Population{.weber_fraction = w,
                                  .spread_ln = pair.spread_ln,
                                  .place_sd_ln = 0.15,
                                  .lapse = pair.lapse}
                           .person(slope_z, place_z);
        drawn.slope *= std::exp(pair.own_ln * random.normal());
        group.push_back({"P" + std::to_string(person), w == 0.7 ? "d" : "e", kReference,
                         answers_of(drawn, 5, random)});
      }
    }
    const HierarchicalFit fit =
        fit_hierarchical(group, {.lapses = HierarchicalLapses::kCommon});
    const bool exists = fit.status == FitStatus::kOk && fit.differences[0].standard_error;
    coverage.add(exists, exists ? fit.differences[0].ci95 : Interval{}, truth);
    if (!exists) continue;
    errors.push_back(fit.differences[0].estimate - truth);
    widths.push_back(0.5 * (*fit.differences[0].ci95.high - *fit.differences[0].ci95.low));
  }
  std::sort(widths.begin(), widths.end());
  char bias[32], width[32];
  std::snprintf(bias, sizeof bias, "%+.3f", summary_of(errors).mean.value_or(0.0));
  std::snprintf(width, sizeof width, "%.3f", widths.empty() ? 0.0 : widths[widths.size() / 2]);
  print_row({pair.words, pair.own_places ? "of its own in each" : "the same in both",
             std::to_string(pair.num_people), coverage.words(), width, bias,
             std::to_string(coverage.num_without)});
  std::fflush(stdout);
}

void cover_difference(int num_sets, std::uint64_t seed) {
  std::printf(
      "\n## Two conditions of the same people: difference of ln ln(1 + w)\n\n"
      "%d studies a row, w = 0.7 and 0.3, five answers at each of eight levels, pse differs "
      "by 0.15 in ln between people.\nHierarchical fit, pse and lapse rate free; the error of "
      "the sandwich. Half width: in the median study.\n\n",
      num_sets);
  print_row({"people differ", "pse", "n", "coverage", "half width", "bias", "without"});
  std::printf("| --- | --- | --- | --- | --- | --- | --- |\n");
  const std::string alike = "by 0.3 in ln in both alike";
  const std::string partly = alike + ", by 0.2 in each alone";
  const std::string alone = "by 0.3 in ln in each alone";
  for (const Pair& pair :
       {Pair{.words = alike}, Pair{.words = alike, .num_people = 5},
        Pair{.words = partly, .own_ln = 0.2},
        Pair{.words = partly, .own_ln = 0.2, .own_places = true},
        Pair{.words = alone, .spread_ln = 0.0, .own_ln = 0.3, .own_places = true},
        Pair{.words = alone,
        .num_people = 5,
        .spread_ln = 0.0,
        .own_ln = 0.3,
        .own_places = true},
        Pair{.words = partly + ", 1 % lapses",
        .own_ln = 0.2,
        .own_places = true,
        .lapse = 0.01}}) {
    cover_pair(pair, num_sets, seed);
  }
}

}  // namespace

int main(int argc, char** argv) {
  const int num_sets = argc > 1 ? std::atoi(argv[1]) : 1000;
  if (num_sets < 4) {
    std::fprintf(stderr, "coverage: expected a number of data sets >= 4, found %s\n", argv[1]);
    return 2;
  }
  constexpr std::uint64_t kSeed = 2018;
  std::printf(
      "# What the intervals cover\n\nWritten by `./dev coverage %d`; seed %d. People are "
      "simulated, their Weber fractions known.\n",
      num_sets, static_cast<int>(kSeed));
  cover_one_person(num_sets, kSeed);
  cover_groups(num_sets, kSeed);
  cover_difference(std::max(4, num_sets / 2), kSeed);
  return 0;
}
