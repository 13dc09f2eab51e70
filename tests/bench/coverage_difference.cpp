#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "analysis/hierarchical/hierarchical_fit.h"
#include "analysis/statistics/summary.h"
#include "bench/coverage_people.h"

namespace jnd::coverage {
namespace {

using Group = std::vector<ParticipantAnswers>;

/// People in two conditions. It says how far their slopes correlate, and whether their places
/// do.
struct Pair {
  std::string words;
  int num_people = 13;
  double spread_ln = 0.3;  ///< The sd of what a person has in common in both conditions.
  double own_ln = 0.0;     ///< The sd of what a person has separately in each condition.
  bool own_places = false;
  double lapse = 0.0;
};

std::string cover_pair(const Pair& pair, int num_sets, std::uint64_t seed) {
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
        group.push_back({"P" + std::to_string(person), w == 0.7 ? "d" : "e",
                         kHardLevels.reference, answers_of(drawn, kHardLevels, 5, random)});
      }
    }
    const HierarchicalFit fit = fit_hierarchical(group, {.lapse_profile = false});
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
  return row_of({pair.words, pair.own_places ? "of its own in each" : "the same in both",
                 std::to_string(pair.num_people), coverage.words(), width, bias,
                 std::to_string(coverage.num_without)});
}

}  // namespace

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
  std::vector<std::function<std::string()>> rows;
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
        Pair{
            .words = partly + ", 1 % lapses", .own_ln = 0.2, .own_places = true, .lapse = 0.01},
        Pair{
            .words = partly + ", 3 % lapses", .own_ln = 0.2, .own_places = true, .lapse = 0.03},
        Pair{.words = partly + ", 5 % lapses",
        .own_ln = 0.2,
        .own_places = true,
        .lapse = 0.05}}) {
    rows.emplace_back([pair, num_sets, seed] { return cover_pair(pair, num_sets, seed); });
  }
  print_rows(rows);
}

}  // namespace jnd::coverage
