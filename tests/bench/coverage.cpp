// What intervals and group values are worth: draws people whose Weber fractions are known,
// analyses their answers, and counts how often the intervals hold the truth. `./dev coverage`
// prints the page data/reference/coverage/README.md. The same seed gives the same page.

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "analysis/fits/psychometric_fit.h"
#include "bench/coverage_people.h"

namespace jnd::coverage {
namespace {

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
        const std::vector<AnswerCount> rows = answers_of(
            Population{.weber_fraction = w}.person(0, 0), kHardLevels, num_trials, random);
        const auto fit = [&](bool free_pse, BootstrapKind kind, int num_bootstrap) {
          return fit_psychometric(rows, {.reference = kHardLevels.reference,
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

}  // namespace
}  // namespace jnd::coverage

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
  using namespace jnd::coverage;
  cover_one_person(num_sets, kSeed);
  cover_groups(num_sets, kSeed);
  cover_difference(std::max(4, num_sets / 2), kSeed);
  return 0;
}
