#include <algorithm>
#include <cmath>
#include <map>

#include "analysis/results/discrimination_answers.h"
#include "analysis/results/discrimination_group.h"
#include "analysis/results/discrimination_own_values.h"
#include "analysis/results/own_fractions.h"
#include "analysis/results/study_results.h"
#include "analysis/results/trial_trends.h"
#include "analysis/statistics/summary.h"
#include "analysis/words/said.h"

namespace jnd::analysis {
namespace {

using Everybody = std::vector<DiscriminationAnswers>;

/// Participants' own fractions by name. They include either only people with a fit, or also
/// people whose fraction needs half an answer added.
using FractionsByName = std::map<std::string, double>;

FractionsByName with_fit(const OwnFractions& fractions) {
  FractionsByName found;
  for (const OwnFraction& one : fractions.people) {
    if (one.weber_fraction) found[one.participant] = *one.weber_fraction;
  }
  return found;
}

FractionsByName with_mended(const OwnFractions& fractions) {
  FractionsByName found = with_fit(fractions);
  for (const OwnFraction& one : fractions.people) {
    if (one.mended) found[one.participant] = *one.mended;
  }
  return found;
}

std::vector<double> values_of(const FractionsByName& by_participant) {
  std::vector<double> values;
  for (const auto& [participant, value] : by_participant) values.push_back(value);
  return values;
}

void name_those_without(ResultsSection& section, const OwnFractions& fractions,
                        const std::string& block, bool free_pse) {
  for (const OwnFraction& one : fractions.people) {
    if (one.weber_fraction) continue;
    section.excluded.push_back(
        {one.participant, without_words(block, free_pse) + one.reason +
                              (one.mended ? "" : said("; nor with half an answer added"))});
  }
}

/// The scale on which individual Weber fractions are compared, because their spread is even
/// there.
double log_log(double weber_fraction) { return std::log(std::log1p(weber_fraction)); }

std::vector<double> log_log_of(const FractionsByName& fractions) {
  std::vector<double> values = values_of(fractions);
  for (double& value : values) value = log_log(value);
  return values;
}

/// Student's t with pooled variance, which is the test that was published.
Comparison pooled(const std::vector<double>& a, const std::vector<double>& b) {
  const Summary first = summary_of(a);
  const Summary second = summary_of(b);
  if (!first.standard_deviation || !second.standard_deviation) {
    return {.status = FitStatus::kDegenerate,
            .reason = said("fewer than two values on one side")};
  }
  return pooled_t_test({*first.mean, *first.standard_deviation, first.num_values},
                       {*second.mean, *second.standard_deviation, second.num_values});
}

/// Adds tests between two blocks of people's own fractions. `words` say whose they are and how
/// they were computed.
void add_own_fraction_tests(ResultsSection& section, const FractionsByName& a,
                            const FractionsByName& b, const std::string& pair,
                            const std::string& words, bool free_pse) {
  std::vector<double> paired_a, paired_b;
  for (const auto& [participant, fraction] : a) {
    const auto other = b.find(participant);
    if (other == b.end()) continue;
    paired_a.push_back(log_log(fraction));
    paired_b.push_back(log_log(other->second));
  }
  const auto add = [&](const std::string& name, const Comparison& comparison) {
    section.comparisons.push_back({pair + name + words, comparison});
  };
  const auto add_of_logarithms = [&](const std::string& name, const Comparison& comparison) {
    add(said("ln ln(1 + w), {}", name), comparison);
    section.comparisons.back().ratio_of = "ln(1 + w)";
  };
  if (!paired_a.empty()) {
    add_of_logarithms(said("paired"), paired_t_test(paired_a, paired_b));
    add_of_logarithms(said("Wilcoxon, sensitivity"), wilcoxon_test(paired_a, paired_b));
  }
  if (free_pse) return;
  add_of_logarithms(said("unpaired, Welch"), welch_t_test(log_log_of(a), log_log_of(b)));
  add(said("w, unpaired, Welch"), welch_t_test(values_of(a), values_of(b)));
  add(said("w, unpaired, pooled variance, as Schmidt (2018)"),
      pooled(values_of(a), values_of(b)));
}

/// Adds these tests with a free pse, or with the pse at the reference. If some participants
/// have no fraction, the tests are computed without and with them.
void add_own_fractions(ResultsSection& section, const Everybody& first_answers,
                       const BlockDesign& first, const Everybody& second_answers,
                       const BlockDesign& second, bool free_pse) {
  const OwnFractions a = own_fractions(first_answers, {.free_pse = free_pse});
  const OwnFractions b = own_fractions(second_answers, {.free_pse = free_pse});
  name_those_without(section, a, first.block, free_pse);
  name_those_without(section, b, second.block, free_pse);
  const std::string pair = first.block + " - " + second.block + ": ";
  const std::string words = free_pse ? said(", pse free") : "";
  const bool all_have_one =
      with_fit(a).size() == a.people.size() && with_fit(b).size() == b.people.size();
  add_own_fraction_tests(
      section, with_fit(a), with_fit(b), pair,
      words + (all_have_one ? "" : said(", without degenerate participants")), free_pse);
  const bool any_mended =
      with_mended(a).size() > with_fit(a).size() || with_mended(b).size() > with_fit(b).size();
  if (!any_mended) return;
  add_own_fraction_tests(section, with_mended(a), with_mended(b), pair,
                         said("{}, with degenerate participants (half a yes and half a no "
                              "added to theirs alone, spread evenly over the levels)",
                              words),
                         free_pse);
}

}  // namespace

ResultsSection discrimination_results(const StudyData& data, const BlockDesign& block,
                                      const ResultsOptions& options) {
  ResultsSection section{.name = block.block};
  const Everybody all = discrimination_answers(data, block, false, section.excluded);
  if (all.empty()) return section;
  section.own_fractions_free_pse = primary_pse(all) == HierarchicalPse::kPersonal;
  add_group_estimates(section, data, block, options);
  ResultsOptions of_people = options;
  of_people.on_progress = core::part_of(options.on_progress, 0.5, 1.0);
  add_own_values(section, all, block, of_people);
  add_individual_fractions(section, all, block, options);
  add_trial_trends(section, all, block, options);
  return section;
}

ResultsSection discrimination_comparison(const StudyData& data, const ComparedBlocks& blocks) {
  const auto& [first, second, has_primary] = blocks;
  ResultsSection section{.name = first.block + "_against_" + second.block};
  const Everybody first_answers = discrimination_answers(data, first, false, section.excluded);
  const Everybody second_answers =
      discrimination_answers(data, second, false, section.excluded);
  const std::string pair = first.block + " - " + second.block + ": ";
  const bool frees = primary_pse(first_answers, second_answers) == HierarchicalPse::kPersonal;
  for (const bool free_pse : {frees, !frees}) {
    const bool is_primary = free_pse == frees && has_primary;
    section.comparisons.push_back(
        {.name = said("{}ln ln(1 + w) of the median person, hierarchical, {}{}", pair,
                      (free_pse ? said("pse free") : said("pse at the reference")),
                      (is_primary ? said(" (primary)") : said(" (secondary)"))),
         .comparison = median_person_difference(
             first_answers, first, second_answers, second,
             free_pse ? HierarchicalPse::kPersonal : HierarchicalPse::kReference),
         .primary = is_primary,
         .ratio_of = "ln(1 + w)"});
  }
  for (const bool free_pse : {false, true}) {
    add_own_fractions(section, first_answers, first, second_answers, second, free_pse);
  }
  return section;
}

}  // namespace jnd::analysis
