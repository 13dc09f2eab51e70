#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "app/planning/power_files.h"

namespace jnd::app {
namespace {

using namespace analysis;

std::string decimals(const std::optional<double>& value) {
  return value ? fmt::format("{:.4f}", *value) : "-";
}

/// The mean effect over the runs; for a ratio, its geometric mean.
std::optional<double> effect_of(const PlannedPower& power, const PlannedName& name) {
  if (!power.mean_difference || !name.is_ratio) return power.mean_difference;
  return std::exp(*power.mean_difference);
}

std::string percent(double share) { return fmt::format("{:.1f} %", 100.0 * share); }

std::string heading(const PowerDesign& design) {
  return fmt::format(
      "{}: {} SIMULATED studies of each size, laboratory \"{}\"{}, seed {}\n", design.study,
      design.request.num_runs, design.laboratory,
      design.request.null_hypothesis ? " MADE ALIKE for both blocks (null hypothesis)" : "",
      design.request.seed);
}

/// The results of the looks; "" if none are planned.
std::string sequential_table(const PlannedSequential& planned, const SequentialPower& power,
                             bool alike) {
  const SequentialRule& rule = planned.boundaries.rule;
  std::string table = fmt::format(
      "\nBy looks at {}: alpha {:.3g}{}, spent as by {}, boundaries of t tests\n"
      "  {:>12} {:>10}  {:>10}  {:>20}\n",
      planned.contrast, rule.alpha, rule.tail == Tail::kTwoSided ? "" : ", one-sided",
      rule.spending == SpendingFunction::kPocock ? "Pocock" : "O'Brien-Fleming", "participants",
      "ends if p <", "ends here", "finds a difference");
  const auto num_runs = static_cast<double>(power.num_runs);
  for (std::size_t look = 0; look < rule.looks.size(); ++look) {
    table += fmt::format("  {:>12} {:>10.5f}  {:>10}  {:>20}\n", rule.looks[look],
                         planned.boundaries.nominal_level[look],
                         percent(static_cast<double>(power.num_ended[look]) / num_runs),
                         percent(static_cast<double>(power.num_significant[look]) / num_runs));
  }
  table +=
      fmt::format("  {}: {} ({} .. {}), without looks {} with all {}\n",
                  alike ? "Differences found where there are none" : "Power",
                  percent(power.power), percent(power.power_low), percent(power.power_high),
                  percent(power.fixed_power), rule.looks.back());
  table += fmt::format("  Expected participants: {:.1f} (standard error {:.1f})",
                       power.mean_participants, power.standard_error);
  if (!alike) {
    table +=
        power.fixed_participants
            ? fmt::format("; without looks as much power takes {}", *power.fixed_participants)
            : fmt::format("; without looks as much power takes more than {}",
                          rule.looks.back());
  }
  return table + "\n";
}

}  // namespace

std::string power_table(const PowerDesign& design, const std::vector<PlannedSummary>& summaries,
                        const std::optional<SequentialPower>& sequential) {
  std::string table = heading(design);
  const std::vector<PlannedName> tests = test_names(design.analysis);
  const bool alike = design.request.null_hypothesis || nothing_differs(design.analysis);
  if (design.analysis.compared) {
    table += fmt::format("\nTrue difference in ln ln(1 + w): {}{}\n",
                         decimals(true_difference(design.analysis)),
                         alike ? ". Nothing differs: the share with p < 0.05 is the rate of "
                                 "false positives, not a power"
                               : "");
  }
  for (std::size_t test = 0; test < tests.size(); ++test) {
    const bool is_null = alike && !tests[test].of_contrast;
    table += fmt::format(
        "\n{}{}\n  {:>12} {:>8}  {:>18}  {:>9}  {:>10}\n", tests[test].name,
        tests[test].meaning.empty() ? "" : " (" + tests[test].meaning + ")", "participants",
        is_null ? fmt::format("p < {:.3g}", tests[test].alpha) : "power", "95 % of the share",
        "undefined", tests[test].is_ratio ? "ratio" : "difference");
    for (const PlannedSummary& summary : summaries) {
      const PlannedPower& power = summary.tests[test];
      table += fmt::format(
          "  {:>12} {:>8}  {:>18}  {:>9}  {:>10}\n", summary.num_participants,
          percent(power.power),
          fmt::format("{} .. {}", percent(power.power_low), percent(power.power_high)),
          power.num_undefined, decimals(effect_of(power, tests[test])));
    }
  }
  if (sequential) {
    table += sequential_table(*design.analysis.sequential, *sequential, alike);
  }
  const std::vector<PlannedName> estimates = estimate_names(design.analysis);
  for (std::size_t estimate = 0; estimate < estimates.size(); ++estimate) {
    const PlannedName& name = estimates[estimate];
    table += fmt::format(
        "\n{}: {}; true value {}\n  {:>12} {:>8} {:>9}  {:>10} {:>10}  {:>9}  {:>10}\n",
        name.name, name.meaning, decimals(design.analysis.blocks[name.block].true_value),
        "participants", "median", "bias", "half width", "90 % below", "coverage", "degenerate");
    for (const PlannedSummary& summary : summaries) {
      const PlannedPrecision& one = summary.estimates[estimate];
      table += fmt::format("  {:>12} {:>8} {:>9}  {:>10} {:>10}  {:>9}  {:>10}\n",
                           summary.num_participants, decimals(one.median), decimals(one.bias),
                           decimals(one.half_width_median), decimals(one.half_width_90),
                           one.coverage ? percent(*one.coverage) : "-",
                           one.degenerate ? percent(*one.degenerate) : "-");
    }
  }
  table += fmt::format("\nExpected duration, as `jnd plan` has it\n  {:>12} {:>22} {:>10}\n",
                       "participants", "min per participant", "h in all");
  for (std::size_t size = 0; size < summaries.size(); ++size) {
    table += fmt::format("  {:>12} {:>22.0f} {:>10.1f}\n", summaries[size].num_participants,
                         design.durations[size].mean_s / 60.0,
                         design.durations[size].total_s / 3600.0);
  }
  if (!design.left_out.empty()) {
    table += fmt::format("\nNot planned for, but in the duration: {}\n",
                         fmt::join(design.left_out, ", "));
  }
  if (sequential && alike) {
    const std::string doubt = sequential_doubt(*design.analysis.sequential, *sequential);
    if (!doubt.empty()) table += "\nWARNING: " + doubt + "\n";
  }
  for (const std::string& doubt :
       planning_doubts(design.analysis, summaries, design.request.null_hypothesis)) {
    table += "\nWARNING: " + doubt + "\n";
  }
  return table +
         "\nHalf width: of the 95 % interval over participants, in the median study, and what "
         "nine\nstudies in ten stay below. Degenerate: participants without a fit of their "
         "own.\n";
}

}  // namespace jnd::app
