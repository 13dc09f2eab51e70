#include <algorithm>
#include <cmath>

#include "analysis/results/number_words.h"
#include "analysis/results/threshold_group.h"
#include "analysis/results/threshold_results.h"
#include "analysis/words/said.h"
#include "core/psychometric_function.h"
#include "experiments/procedures/procedure_registry.h"
#include "experiments/study/media.h"

namespace jnd::analysis {
namespace {

/// The Weber fraction that follows from the threshold of a staircase, if the pse is at the
/// reference. If there is none, `reason` says why.
struct FractionAtTarget {
  std::optional<double> value;
  std::string reason;
};

/// On the curve whose pse is at the reference, the level answered "yes" with probability p is
/// reference (1 + w)^z(p).
FractionAtTarget fraction_at_target(double threshold, double reference, double probability) {
  const double z = core::standard_normal_quantile(probability);
  constexpr double kFlattest = 0.05;
  if (std::fabs(z) < kFlattest) {
    return {.reason =
                said("the staircase converges to 50 %, which is the pse, not a difference")};
  }
  const double ratio = std::log(threshold / reference) / z;
  if (!(ratio > 0.0)) {
    return {.reason = said("the threshold lies on the other side of the reference than where "
                           "the pse at the reference has it")};
  }
  return {.value = std::expm1(ratio)};
}

/// Why a value of the posterior may be wrong; "" if the posterior stays away from the ends of
/// its grids.
std::string edge_words(const AdaptiveRun& run) {
  std::string words;
  for (const std::string& end : run.reached_ends)
    words += (words.empty() ? "" : said(" and ")) + end;
  return words.empty() ? ""
                       : said(
                             "the posterior reaches {}, which decides about the value; it has "
                             "no interval",
                             words);
}

std::string percent_words(double probability) {
  return number_words(100.0 * probability, 1) + " %";
}

/// Writes the section of one block.
class AdaptiveWriter {
 public:
  AdaptiveWriter(const StudyData& data, const BlockDesign& block)
      : data_(data), block_(block), section_{.name = block.block + "_" + block.procedure} {}

  [[nodiscard]] ResultsSection finish() && { return std::move(section_); }

  void write_staircase();
  void write_limits();
  void write_quest_plus();
  void write_other();

 private:
  /// The runs that have a result. Runs with a problem are named as excluded.
  [[nodiscard]] std::vector<const AdaptiveRun*> runs() {
    std::vector<const AdaptiveRun*> found;
    for (const AdaptiveRun& run : data_.runs) {
      if (run.block != block_.block) continue;
      if (run.problem.empty()) {
        found.push_back(&run);
        if (run.num_set_aside > 0 && block_.rule != AdaptiveRule::kQuestPlus)
          tell_set_aside(run);
      } else {
        section_.excluded.push_back({run.participant, block_.block + ": " + run.problem});
      }
    }
    return found;
  }
  void tell_set_aside(const AdaptiveRun& run) {
    section_.excluded.push_back(
        {run.participant,
         said("{}: nothing; {} set aside had decided which came next, and stay in it",
              block_.block, counted_words(run.num_set_aside, "trial"))});
  }
  void tell(const AdaptiveRun& run, const std::string& name, const std::optional<double>& value,
            const std::string& reason, const Interval& ci95 = {},
            const std::string& caution = "") {
    section_.participants.push_back({run.participant, full(name), value, ci95, reason});
    if (!caution.empty()) section_.participants.back().cautions = {caution};
  }
  [[nodiscard]] std::string full(const std::string& name) const {
    return block_.block + "." + name;
  }
  [[nodiscard]] std::string unit() const {
    return experiments::unit_of_quantity(block_.quantity);
  }
  void add_level(const std::string& name, const std::string& meaning,
                 const OwnNumbers& values) {
    add_geometric_mean(section_, {.name = full(name), .meaning = meaning, .unit = unit()},
                       values);
  }
  void add_fraction(const std::string& name, const std::string& meaning,
                    const OwnNumbers& values) {
    add_median_fraction(section_, full(name), {.name = full(name), .meaning = meaning}, values);
  }
  void tell_tracks(const AdaptiveRun& run);
  /// How many answers a correction has put behind the end of the rule, where there are any.
  void tell_after_end(const AdaptiveRun& run, const std::string& name) {
    if (run.num_after_end > 0) tell(run, name, run.num_after_end, "");
  }
  /// Of the estimates from `first` on: who brought what to an end of the grid.
  void caution_group(std::size_t first, int num_at_edge, int num_runs);
  /// A caution that the rules of staircases and of QUEST+ ignore the order of the intervals; ""
  /// if the block has no intervals.
  [[nodiscard]] std::string of_both_orders() const {
    return has_intervals(data_, block_) ? said(
                                              "; too large where people favour an interval, "
                                              "for both orders are taken for one")
                                        : "";
  }

  const StudyData& data_;
  const BlockDesign& block_;
  ResultsSection section_;
};

void AdaptiveWriter::tell_tracks(const AdaptiveRun& run) {
  if (run.tracks.size() < 2) return;
  for (const AdaptiveTrack& track : run.tracks) {
    tell(run, "staircase_threshold_" + std::to_string(track.series), track.threshold,
         track.threshold ? "" : said("fewer than two reversals"));
  }
}

void AdaptiveWriter::write_staircase() {
  OwnNumbers thresholds, fractions;
  std::string rule;
  double target = 0.5;
  for (const AdaptiveRun* run : runs()) {
    rule = run->rule;
    target = run->target_probability.value_or(target);
    tell(*run, "staircase_threshold", run->threshold,
         run->threshold ? "" : said("fewer than two reversals in every staircase"));
    tell_tracks(*run);
    int at_bound = 0;
    for (const AdaptiveTrack& track : run->tracks) at_bound += track.num_at_bound;
    if (at_bound > 0) tell(*run, "staircase_reversals_at_bound", at_bound, "");
    tell_after_end(*run, "staircase_answers_after_end");
    if (!run->threshold) continue;
    thresholds[run->participant] = *run->threshold;
    if (block_.identifies()) {
      const double w = *run->threshold / block_.reference_intensity.value() - 1.0;
      tell(*run, "staircase_weber_fraction", w, "");
      fractions[run->participant] = w;
    }
    if (!block_.compares()) continue;
    const FractionAtTarget w =
        fraction_at_target(*run->threshold, *block_.reference_intensity, target);
    tell(*run, "staircase_weber_fraction", w.value, w.reason);
    if (w.value) fractions[run->participant] = *w.value;
  }
  if (rule.empty()) return;
  const std::string more = block_.compares()     ? said("\"more\"")
                           : block_.identifies() ? "right"
                                                 : said("\"yes\"");
  section_.estimates.push_back(
      {.name = full("staircase_target_probability"),
       .value = target,
       .unit = "1",
       .meaning =
           said("share of {} at the level that the staircase converges to: {}", more, rule),
       .n = static_cast<int>(thresholds.size())});
  add_level("staircase_threshold",
            said("level answered {} in {} ({}): mean of the last reversals, then of "
                 "interleaved staircases; geometric mean over participants",
                 more, percent_words(target), rule),
            thresholds);
  if (block_.identifies()) {
    add_fraction("staircase_weber_fraction",
                 said("w = threshold / reference - 1, at which so many answers are right; no "
                      "d' model; median person"),
                 fractions);
    return;
  }
  add_fraction(
      "staircase_weber_fraction",
      said("w = (threshold / reference)^(1 / z) - 1 with z = {} of that share, the pse at the "
           "reference: so that (1 + w) is where the curve is 84.13 %; median person{}",
           number_words(core::standard_normal_quantile(target), 4), of_both_orders()),
      fractions);
}

void AdaptiveWriter::write_limits() {
  OwnNumbers levels, ascending, descending, errors;
  bool is_logarithmic = true;
  for (const AdaptiveRun* run : runs()) {
    is_logarithmic = run->is_logarithmic;
    const LimitsEstimate& limits = run->limits;
    const std::string none = said("no series in which the answer changed");
    tell(*run, "limits_threshold", run->threshold, run->threshold ? "" : none);
    tell(*run, "limits_ascending", limits.ascending, limits.ascending ? "" : none);
    tell(*run, "limits_descending", limits.descending, limits.descending ? "" : none);
    tell(*run, "limits_constant_error", limits.constant_error,
         limits.constant_error ? "" : said("no transition in one of the directions"));
    tell_after_end(*run, "limits_answers_after_end");
    if (run->threshold) levels[run->participant] = *run->threshold;
    if (limits.ascending) ascending[run->participant] = *limits.ascending;
    if (limits.descending) descending[run->participant] = *limits.descending;
    if (limits.constant_error) errors[run->participant] = *limits.constant_error;
  }
  const std::string what = block_.compares() ? said("a pse, for \"more\" begins at 50 %")
                                             : said("the absolute threshold");
  add_level("limits_threshold",
            said("mean of all transitions, {}; geometric mean over participants", what),
            levels);
  add_level("limits_ascending", said("mean transition of rising series; geometric mean"),
            ascending);
  add_level("limits_descending", said("mean transition of falling series; geometric mean"),
            descending);
  if (errors.empty()) return;
  add_mean(section_,
           {.name = full("limits_constant_error"),
            .meaning = said("rising less falling series{}: above 0 habituation, below 0 "
                            "expectation; mean over participants",
                            (is_logarithmic ? said(", in ln") : "")),
            .unit = is_logarithmic ? "1" : unit()},
           errors);
  std::vector<double> values;
  for (const auto& [participant, error] : errors) values.push_back(error);
  section_.comparisons.push_back(
      {.name = said("{}: rising - falling series{}", block_.block,
                    (is_logarithmic ? said(", ln of the transition") : "")),
       .comparison = one_sample_t_test(values),
       .ratio_of = is_logarithmic ? "transition" : ""});
}

void AdaptiveWriter::write_quest_plus() {
  std::map<std::string, OwnNumbers> values;
  int num_at_edge = 0, num_runs = 0;
  for (const AdaptiveRun* run : runs()) {
    for (const PosteriorEstimate& one : run->posterior) {
      const std::string name = "quest_plus_" + one.parameter;
      tell(*run, name, one.mean, "", {one.low, one.high}, edge_words(*run));
      values[name][run->participant] = one.mean;
    }
    num_at_edge += run->reached_ends.empty() ? 0 : 1;
    ++num_runs;
  }
  for (const auto& [name, own] : values) {
    const std::size_t first = section_.estimates.size();
    const std::string end = said(
        ": mean of the posterior at the end, with its central 95 % for each participant; ");
    if (name == "quest_plus_weber_fraction") {
      if (block_.identifies()) {
        add_fraction(name,
                     said("w at which the share of right answers is half way from a guess to "
                          "1{}median person",
                          end),
                     own);
        continue;
      }
      add_fraction(name,
                   said("w of the curve that is 84.13 % at pse (1 + w){}median person{}", end,
                        of_both_orders()),
                   own);
    } else if (name == "quest_plus_slope") {
      add_geometric_mean(
          section_,
          {.name = full(name),
           .meaning =
               said("slope 1 / s per ln of intensity{}geometric mean over participants", end)},
          own);
    } else {
      add_level(name,
                said("{}{}geometric mean over participants",
                     (name == "quest_plus_pse"
                          ? "pse"
                          : said("threshold, half way between guesses and lapses")),
                     end),
                own);
    }
    // For fewer participants their own values say so, and the mean of all hardly changes.
    if (10 * num_at_edge > num_runs) caution_group(first, num_at_edge, num_runs);
  }
}

void AdaptiveWriter::write_other() {
  const std::string name = block_.procedure + "_threshold";
  OwnNumbers thresholds;
  for (const AdaptiveRun* run : runs()) {
    tell(*run, name, run->threshold,
         run->threshold ? "" : said("the answers come to no level"));
    tell_after_end(*run, block_.procedure + "_answers_after_end");
    if (run->threshold) thresholds[run->participant] = *run->threshold;
  }
  add_level(name,
            said("level that the answers come to: {}; geometric mean over participants",
                 said_of(experiments::procedure_named(block_.procedure).words())),
            thresholds);
}

void AdaptiveWriter::caution_group(std::size_t first, int num_at_edge, int num_runs) {
  const std::string other = block_.compares() ? "weber_fraction_median_person" : "threshold";
  for (std::size_t i = first; i < section_.estimates.size(); ++i) {
    Estimate& estimate = section_.estimates[i];
    estimate.ci95 = {};
    estimate.cautions = {
        said("of {} of {} the posterior reaches an end of its grid, which decides about their "
             "values; {} rests on the answers alone",
             std::to_string(num_at_edge), counted_words(num_runs, "participant"), full(other))};
  }
}

}  // namespace

ResultsSection adaptive_results(const StudyData& data, const BlockDesign& block) {
  AdaptiveWriter writer(data, block);
  if (block.rule == AdaptiveRule::kStaircase) writer.write_staircase();
  if (block.rule == AdaptiveRule::kLimits) writer.write_limits();
  if (block.rule == AdaptiveRule::kQuestPlus) writer.write_quest_plus();
  if (block.rule == AdaptiveRule::kOther) writer.write_other();
  return std::move(writer).finish();
}

}  // namespace jnd::analysis
