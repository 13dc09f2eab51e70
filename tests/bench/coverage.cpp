// What intervals and group values are worth: draws people whose Weber fractions are known,
// analyses their answers, and counts how often the intervals hold the truth. `./dev coverage`
// prints the page data/reference/coverage/tables.md; README.md beside it says what the tables
// come to, so look at it where a number moves. The same seed gives the same page.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "analysis/fits/psychometric_fit.h"
#include "bench/coverage_people.h"

namespace jnd::coverage {
namespace {

std::string cover_one_person(int num_trials, double w, int num_sets, std::uint64_t seed) {
  RandomStream random(seed, "coverage of one person",
                      {num_trials, static_cast<std::int64_t>(100.0 * w)});
  Coverage ratio, ratio_free, calibrated, bootstrap[4];
  for (int set = 0; set < num_sets; ++set) {
    const std::vector<AnswerCount> rows = answers_of(
        Population{.weber_fraction = w}.person(0, 0), kHardLevels, num_trials, random);
    const auto fit = [&](bool free_pse, BootstrapKind kind, int num_bootstrap,
                         int num_calibration = 0) {
      return fit_psychometric(rows, {.reference = kHardLevels.reference,
                                     .free_pse = free_pse,
                                     .num_bootstrap = num_bootstrap,
                                     .bootstrap_kind = kind,
                                     .num_calibration = num_calibration,
                                     .solver = Solver::kNewton});
    };
    const PsychometricFit fixed = fit(false, BootstrapKind::kParametric, 0);
    const PsychometricFit free = fit(true, BootstrapKind::kParametric, 0);
    ratio.add(fixed.status == FitStatus::kOk, fixed.weber_fraction_ci95, w);
    ratio_free.add(free.status == FitStatus::kOk, free.weber_fraction_ci95, w);
    calibrated.add(free.status == FitStatus::kOk,
                   fit(true, BootstrapKind::kParametric, 0, 1000).weber_fraction_ci95, w);
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
  return row_of({std::to_string(num_trials), fraction, ratio.words(), ratio_free.words(),
                 calibrated.words(), bootstrap[0].words(), bootstrap[1].words(),
                 bootstrap[2].words(), bootstrap[3].words(),
                 std::to_string(ratio.num_without)});
}

void cover_one_person(int num_sets, std::uint64_t seed) {
  std::printf(
      "\n## One person: intervals of the Weber fraction\n\n"
      "%d data sets, eight levels. LR: likelihood ratio; the bootstraps: 400 refits.\n"
      "Sets without a fit have no interval and are left out of the share. Below 15 answers a "
      "level `jnd fit weber` warns\nof every interval here but LR and the calibrated one.\n\n",
      num_sets);
  print_row({"answers a level", "w", "LR", "LR, pse free", "LR, pse free, --calibration 1000",
             "parametric percentile", "parametric BCa", "nonparametric percentile",
             "nonparametric BCa", "sets without a fit"});
  std::printf("| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n");
  std::vector<std::function<std::string()>> rows;
  for (const int num_trials : {5, 65}) {
    for (const double w : {0.3, 0.7}) {
      rows.emplace_back([=] { return cover_one_person(num_trials, w, num_sets, seed); });
    }
  }
  print_rows(rows);
}

/// Draws the answers with the test in either interval, alternating.
std::vector<AnswerCount> answers_in_either_order(double w, const Levels& levels, int num_trials,
                                                 RandomStream& random) {
  std::vector<AnswerCount> rows;
  for (std::size_t level = 0; level < levels.intensities.size(); ++level) {
    const double x = levels.intensities[level];
    const double p = Population{.weber_fraction = w}.person(0, 0).probability(
        std::log(x / levels.reference), 0.0);
    AnswerCount first{.intensity = x, .order = kTestFirst};
    AnswerCount second{.intensity = x, .order = kTestSecond};
    for (int trial = 0; trial < num_trials; ++trial) {
      AnswerCount& row = (static_cast<int>(level) + trial) % 2 == 0 ? first : second;
      ++row.num_trials;
      row.num_yes += random.with_probability(p) ? 1 : 0;
    }
    rows.push_back(first);
    rows.push_back(second);
  }
  return rows;
}

std::string cover_own_values(const Levels& levels, int num_trials, double w, int num_sets,
                             std::uint64_t seed) {
  RandomStream random(seed, "coverage of own values " + levels.words,
                      {num_trials, static_cast<std::int64_t>(100.0 * w)});
  Coverage fixed, plain, calibrated, pse;
  for (int set = 0; set < num_sets; ++set) {
    const std::vector<AnswerCount> rows =
        answers_in_either_order(w, levels, num_trials, random);
    const auto fit = [&](bool free_pse, int num_calibration) {
      return fit_psychometric(rows, {.reference = levels.reference,
                                     .free_pse = free_pse,
                                     .by_order = true,
                                     .num_calibration = num_calibration,
                                     .seed = seed + static_cast<std::uint64_t>(set),
                                     .solver = Solver::kNewton});
    };
    const auto add = [&](Coverage& to, const PsychometricFit& one) {
      to.add(one.status == FitStatus::kOk, one.weber_fraction_ci95, w);
    };
    add(fixed, fit(false, 1000));
    add(plain, fit(true, 0));
    const PsychometricFit free = fit(true, 1000);
    add(calibrated, free);
    pse.add(free.pse_ci95.has_value(), free.pse_ci95.value_or(Interval{}), levels.reference);
  }
  char fraction[16];
  std::snprintf(fraction, sizeof fraction, "%.1f", w);
  return row_of({levels.words, std::to_string(num_trials), fraction, fixed.words(),
                 plain.words(), calibrated.words(), pse.words(),
                 std::to_string(calibrated.num_without)});
}

void cover_own_values(int num_sets, std::uint64_t seed) {
  std::printf(
      "\n## One person, as results of a study have them: the test in either interval\n\n"
      "%d data sets, eight levels (see below), each order of the intervals with a pse of its "
      "own. Likelihood ratio, but\nfor one column widened as `jnd results` has it: by a "
      "calibration of 1000 redraws where no level has 30 answers.\n\n",
      num_sets);
  print_row({"levels", "answers a level", "w", "w, pse = reference",
             "w, pse free, not calibrated", "w, pse free", "pse", "sets without a fit"});
  std::printf("| --- | --- | --- | --- | --- | --- | --- | --- |\n");
  std::vector<std::function<std::string()>> rows;
  for (const Levels* levels : {&kHardLevels, &kEasyLevels}) {
    for (const int num_trials : {5, 15, 30}) {
      for (const double w : {0.2, 0.3, 0.7}) {
        rows.emplace_back(
            [=] { return cover_own_values(*levels, num_trials, w, num_sets, seed); });
      }
    }
  }
  print_rows(rows);
}

}  // namespace
}  // namespace jnd::coverage

int main(int argc, char** argv) {
  const int num_sets = argc > 1 ? std::atoi(argv[1]) : 1000;
  if (num_sets < 4) {
    std::fprintf(stderr, "coverage: expected a number of data sets >= 4, found %s\n", argv[1]);
    return 2;
  }
  constexpr std::uint64_t kSeed = 2018;
  using namespace jnd::coverage;
  const int few = std::max(4, num_sets / 2);
  const std::vector<std::pair<std::string, std::function<void()>>> sections = {
      {"person", [=] { cover_one_person(num_sets, kSeed); }},
      {"own_values", [=] { cover_own_values(num_sets, kSeed); }},
      {"groups", [=] { cover_groups(num_sets, kSeed); }},
      {"difference", [=] { cover_difference(few, kSeed); }},
      {"curves", [=] { cover_curves(num_sets, kSeed); }},
      {"contrasts", [=] { cover_contrasts(num_sets, kSeed); }},
      {"sequential", [=] { cover_sequential(num_sets, kSeed); }},
      {"robust", [=] { cover_robust(num_sets, kSeed); }},
      {"mixed", [=] { cover_mixed_models(few, kSeed); }},
      {"power_laws", [=] { cover_power_laws(num_sets, kSeed); }}};
  const std::string wanted = argc > 2 ? argv[2] : "";
  const bool is_known = wanted.empty() || std::ranges::any_of(sections, [&](const auto& one) {
                          return one.first == wanted;
                        });
  if (!is_known) {
    std::fprintf(
        stderr,
        "coverage: expected person, own_values, groups, difference, curves, contrasts, "
        "sequential, robust, mixed or power_laws as the section, found %s\n",
        argv[2]);
    return 2;
  }
  if (wanted.empty()) {
    std::printf(
        "# What the intervals cover: the tables\n\nWritten by `./dev coverage %d`; seed %d. "
        "People are simulated, their Weber fractions known.\n[README](README.md) says in "
        "sentences what stands here.\n",
        num_sets, static_cast<int>(kSeed));
  }
  for (const auto& [name, write] : sections) {
    if (wanted.empty() || wanted == name) write();
  }
  return 0;
}
