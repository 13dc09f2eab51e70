#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>

#include "analysis/discrimination_answers.h"
#include "analysis/discrimination_group.h"
#include "analysis/discrimination_own_values.h"
#include "analysis/groups/summary.h"
#include "analysis/report/report_words.h"
#include "analysis/study_results.h"

namespace jnd::analysis {
namespace {

using Everybody = std::vector<DiscriminationAnswers>;

/// Individual Weber fractions of a block, and who has none.
struct OwnFractions {
  std::map<std::string, double> plain;
  std::map<std::string, double> corrected;  ///< Of those who have none, as far as that helps.
  std::vector<ExcludedParticipant> without;
};

OwnFractions own_fractions(const Everybody& all, bool free_pse, const std::string& block) {
  OwnFractions fractions;
  const std::string what =
      block + ": no Weber fraction of their own" + (free_pse ? " with a free pse, " : ", ");
  for (const DiscriminationAnswers& answers : all) {
    const PsychometricFit fit = own_fit(answers, {.free_pse = free_pse});
    if (fit.weber_fraction) {
      fractions.plain[answers.participant] = *fit.weber_fraction;
      continue;
    }
    const PsychometricFit mended = own_fit(answers, {.corrected = true, .free_pse = free_pse});
    if (mended.weber_fraction) {
      fractions.corrected[answers.participant] = *mended.weber_fraction;
    }
    fractions.without.push_back(
        {answers.participant,
         what + fit.reason + (mended.weber_fraction ? "" : "; nor with half an answer added")});
  }
  return fractions;
}

std::map<std::string, double> everybody_of(const OwnFractions& fractions) {
  std::map<std::string, double> all = fractions.plain;
  all.insert(fractions.corrected.begin(), fractions.corrected.end());
  return all;
}

std::vector<double> values_of(const std::map<std::string, double>& by_participant) {
  std::vector<double> values;
  for (const auto& [participant, value] : by_participant) values.push_back(value);
  return values;
}

/// One participant's own fraction, or what stands for it in ranks: nothing above the stimuli
/// can be told from anything else up there, so it counts as infinite, as do flat and inverted
/// answers; perfectly separated ones count as 0.
struct IndividualFraction {
  double for_ranks = 0.0;
  bool beyond_stimuli = false;
};

/// Everybody's own fractions of a block, as far as they can be told.
struct IndividualFractions {
  std::vector<IndividualFraction> ranked;  ///< In the order of the participants.
  std::vector<double> with_fit;
  double largest = 0.0;  ///< That of the block's largest stimulus: what can be told.
  int num_beyond = 0;
};

IndividualFractions individual_fractions(ResultsSection& section, const Everybody& all,
                                         const BlockDesign& block, bool free_pse) {
  IndividualFractions fractions;
  // Of everybody: where answers choose the levels, those near one's own threshold are no end.
  for (const DiscriminationAnswers& answers : all) {
    fractions.largest =
        std::max(fractions.largest, answers.levels.rbegin()->first / answers.reference - 1.0);
  }
  const double largest = fractions.largest;
  for (const DiscriminationAnswers& answers : all) {
    const PsychometricFit fit = own_fit(answers, {.free_pse = free_pse});
    IndividualFraction one{.for_ranks = std::numeric_limits<double>::infinity(),
                           .beyond_stimuli = true};
    if (fit.weber_fraction) {
      fractions.with_fit.push_back(*fit.weber_fraction);
      if (*fit.weber_fraction <= largest) one = {.for_ranks = *fit.weber_fraction};
    } else {
      section.excluded.push_back(
          {answers.participant, block.block + ": no Weber fraction of their own" +
                                    (free_pse ? " with a free pse, " : ", ") + fit.reason});
      if (own_fit(answers, {.corrected = true, .free_pse = free_pse})
              .weber_fraction.value_or(largest) < largest) {
        one = {};
      }
    }
    fractions.num_beyond += one.beyond_stimuli ? 1 : 0;
    fractions.ranked.push_back(one);
  }
  return fractions;
}

/// "> 0.5: 2 of 3 lie beyond the largest stimulus": of a median that is infinite in ranks.
std::string beyond_words(const IndividualFractions& fractions) {
  const std::size_t num = fractions.ranked.size();
  const std::string beyond = std::to_string(fractions.num_beyond) + " of " +
                             std::to_string(num) + " lie beyond the largest stimulus";
  // Of an even number, the half: the median is the mean of a known one and one beyond.
  if (2 * static_cast<std::size_t>(fractions.num_beyond) == num) return beyond;
  return "> " + number_words(fractions.largest) + ": " + beyond +
         ", or have flat or inverted answers";
}

/// Median, quartiles and robust spread, which some fractions beyond the stimuli leave as they
/// are. With the pse of the primary value; a published median has it at the reference.
void add_individual(ResultsSection& section, const Everybody& all, const BlockDesign& block,
                    const ResultsOptions& options, bool is_median_published) {
  const bool free_pse = section.own_fractions_free_pse;
  const IndividualFractions fractions = individual_fractions(section, all, block, free_pse);
  const auto quantile = [&](const std::vector<std::size_t>& drawn,
                            double probability) -> std::optional<double> {
    std::vector<double> values;
    for (const std::size_t i : drawn) values.push_back(fractions.ranked[i].for_ranks);
    std::sort(values.begin(), values.end());
    const double value = percentile(values, probability);
    return std::isfinite(value) ? std::optional(value) : std::nullopt;
  };
  using Statistic = std::function<std::optional<double>(const std::vector<std::size_t>&)>;
  std::vector<std::size_t> everyone(all.size());
  for (std::size_t i = 0; i < all.size(); ++i) everyone[i] = i;
  const std::string prefix = block.block + ".individual_weber_fraction_";
  const std::string pse = free_pse ? ", pse free" : ", pse at the reference";
  const auto add = [&](const std::string& name, const std::string& meaning,
                       const Statistic& statistic) {
    Estimate estimate{.name = prefix + name,
                      .value = statistic(everyone),
                      .unit = "1",
                      .meaning = meaning,
                      .n = static_cast<int>(all.size())};
    if (estimate.value && all.size() > 1) {
      estimate.ci95 =
          resample_participants(all.size(), options.num_resamples, options.seed, statistic)
              .ci95;
    }
    section.estimates.push_back(std::move(estimate));
  };
  add("median",
      "median of the participants' own fractions" + pse +
          (is_median_published ? " (Schmidt (2018) gives a mean)" : ""),
      [&](const std::vector<std::size_t>& drawn) { return quantile(drawn, 0.5); });
  if (!section.estimates.back().value) {
    section.excluded.push_back(
        {"everyone", prefix + "median: no value, " + beyond_words(fractions)});
  }
  add("robust_sd",
      "interquartile range / 1.349 of the participants' own fractions" + pse +
          (is_median_published
               ? " (that of Schmidt (2018) is a plain standard deviation, which one flat curve "
                 "can make as large as it likes)"
               : ""),
      [&](const std::vector<std::size_t>& drawn) -> std::optional<double> {
        const auto low = quantile(drawn, 0.25);
        const auto high = quantile(drawn, 0.75);
        if (!low || !high) return std::nullopt;
        return (*high - *low) / 1.349;
      });
  const Summary summary = summary_of(fractions.with_fit);
  const auto add_plain = [&](const std::string& name, std::optional<double> value, int n,
                             const std::string& meaning) {
    section.estimates.push_back(
        {.name = prefix + name, .value = value, .unit = "1", .meaning = meaning, .n = n});
  };
  add_plain("beyond_stimuli", fractions.num_beyond, static_cast<int>(all.size()),
            "participants whose own fraction" + pse +
                ", lies beyond the largest stimulus of the block, or is not finite");
  // One fraction beyond the stimuli, which they cannot tell from any other, makes both
  // meaningless.
  const bool all_within = fractions.num_beyond == 0 && fractions.with_fit.size() == all.size();
  add_plain("mean", all_within ? summary.mean : std::nullopt, summary.num_values,
            "plain mean" + pse +
                ", where all lie within the stimuli (biased upwards at few answers)");
  add_plain("sd", all_within ? summary.standard_deviation : std::nullopt, summary.num_values,
            "plain standard deviation" + pse + ", where all lie within the stimuli");
}

/// Where individual Weber fractions are compared: their spread is even there.
double log_log(double weber_fraction) { return std::log(std::log1p(weber_fraction)); }

std::vector<double> log_log_of(const std::map<std::string, double>& fractions) {
  std::vector<double> values = values_of(fractions);
  for (double& value : values) value = log_log(value);
  return values;
}

/// Student's t with pooled variance, the test that was published.
Comparison pooled(const std::vector<double>& a, const std::vector<double>& b) {
  const Summary first = summary_of(a);
  const Summary second = summary_of(b);
  if (!first.standard_deviation || !second.standard_deviation) {
    return {.status = FitStatus::kDegenerate, .reason = "fewer than two values on one side"};
  }
  return pooled_t_test({*first.mean, *first.standard_deviation, first.num_values},
                       {*second.mean, *second.standard_deviation, second.num_values});
}

/// Tests between two blocks' fractions that people have of their own; `words` say whose and
/// how.
void add_own_fraction_tests(ResultsSection& section, const std::map<std::string, double>& a,
                            const std::map<std::string, double>& b, const std::string& pair,
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
  if (!paired_a.empty()) {
    add("ln ln(1 + w), paired", paired_t_test(paired_a, paired_b));
    add("ln ln(1 + w), Wilcoxon, sensitivity", wilcoxon_test(paired_a, paired_b));
  }
  if (free_pse) return;
  add("ln ln(1 + w), unpaired, Welch", welch_t_test(log_log_of(a), log_log_of(b)));
  add("w, unpaired, Welch", welch_t_test(values_of(a), values_of(b)));
  add("w, unpaired, pooled variance, as Schmidt (2018)", pooled(values_of(a), values_of(b)));
}

/// With a free pse or with that at the reference; where somebody has no fraction, both without
/// and with them.
void add_own_fractions(ResultsSection& section, const Everybody& first_answers,
                       const BlockDesign& first, const Everybody& second_answers,
                       const BlockDesign& second, bool free_pse) {
  const OwnFractions a = own_fractions(first_answers, free_pse, first.block);
  const OwnFractions b = own_fractions(second_answers, free_pse, second.block);
  section.excluded.insert(section.excluded.end(), a.without.begin(), a.without.end());
  section.excluded.insert(section.excluded.end(), b.without.begin(), b.without.end());
  const std::string pair = first.block + " - " + second.block + ": ";
  const std::string words = free_pse ? ", pse free" : "";
  const bool all_have_one = a.without.empty() && b.without.empty();
  add_own_fraction_tests(section, a.plain, b.plain, pair,
                         words + (all_have_one ? "" : ", without degenerate participants"),
                         free_pse);
  if (a.corrected.empty() && b.corrected.empty()) return;
  add_own_fraction_tests(section, everybody_of(a), everybody_of(b), pair,
                         words +
                             ", with degenerate participants (half a yes and half a no "
                             "added to theirs alone, spread evenly over the levels)",
                         free_pse);
}

}  // namespace

ResultsSection discrimination_results(const StudyData& data, const BlockDesign& block,
                                      const ResultsOptions& options, bool is_median_published) {
  ResultsSection section{.name = block.block};
  const Everybody all = discrimination_answers(data, block, false, section.excluded);
  if (all.empty()) return section;
  section.own_fractions_free_pse =
      !is_median_published && primary_pse(all) == HierarchicalPse::kPersonal;
  add_group_estimates(section, data, block, options);
  add_own_values(section, all, block, options);
  add_individual(section, all, block, options, is_median_published);
  add_trial_trends(section, all, block);
  return section;
}

ResultsSection discrimination_comparison(const StudyData& data, const ComparedBlocks& blocks) {
  const auto& [first, second, is_planned] = blocks;
  ResultsSection section{.name = first.block + "_against_" + second.block};
  const Everybody first_answers = discrimination_answers(data, first, false, section.excluded);
  const Everybody second_answers =
      discrimination_answers(data, second, false, section.excluded);
  const std::string pair = first.block + " - " + second.block + ": ";
  const bool frees = primary_pse(first_answers, second_answers) == HierarchicalPse::kPersonal;
  for (const bool free_pse : {frees, !frees}) {
    section.comparisons.push_back(
        {pair + "ln ln(1 + w) of the median person, hierarchical, " +
             (free_pse ? "pse free" : "pse at the reference") +
             (free_pse == frees && is_planned ? " (primary)" : " (secondary)"),
         median_person_difference(
             first_answers, first, second_answers, second,
             free_pse ? HierarchicalPse::kPersonal : HierarchicalPse::kReference)});
  }
  for (const bool free_pse : {false, true}) {
    add_own_fractions(section, first_answers, first, second_answers, second, free_pse);
  }
  return section;
}

}  // namespace jnd::analysis
