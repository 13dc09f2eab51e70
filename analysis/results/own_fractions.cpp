#include "analysis/results/own_fractions.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "analysis/results/number_words.h"
#include "analysis/statistics/summary.h"
#include "analysis/words/said.h"
#include "core/require.h"

namespace jnd::analysis {
namespace {

using Places = std::vector<std::size_t>;
using Statistic = std::function<CensoredValue(const Places&)>;

using core::kInfinity;

/// Does what `percentile` does, for values in any order. Only the two values next to the
/// quantile are put in place.
double quantile_of(std::vector<double> values, double probability) {
  const auto below =
      static_cast<std::ptrdiff_t>(probability * static_cast<double>(values.size() - 1));
  std::ranges::nth_element(values, values.begin() + below);
  if (below + 1 < std::ssize(values)) {
    std::iter_swap(values.begin() + below + 1,
                   std::ranges::min_element(values.begin() + below + 1, values.end()));
  }
  return percentile(values, probability);
}

/// Percentiles over resampled people. The lower end comes from `at_least` and the upper end
/// from `at_most`. An infinite end is open.
Interval interval_of(const Statistic& statistic, std::size_t num_people,
                     const ResultsOptions& options) {
  const std::vector<ResampledInterval> ends =
      resample_participants(num_people, options.num_resamples, options.seed, 2,
                            [&](const Places& drawn, std::span<std::optional<double>> values) {
                              const CensoredValue found = statistic(drawn);
                              values[0] = found.at_least;
                              values[1] = found.at_most;
                            });
  return {ends[0].ci95.low, ends[1].ci95.high};
}

/// Words for a median that the stimuli do not determine, such as "> 0.5: 2 of 3 lie beyond the
/// largest stimulus".
std::string untold_words(const OwnFractions& fractions, const CensoredValue& median) {
  const auto num = fractions.people.size();
  const auto num_beyond = static_cast<std::size_t>(fractions.num_beyond());
  if (std::isfinite(median.at_most)) {
    const auto num_separated =
        std::ranges::count_if(fractions.people, [](const OwnFraction& one) {
          return one.at_least < one.at_most && std::isfinite(one.at_most);
        });
    return said(
        "< {}: the answers of {} of {} are separated without an error, so that the stimuli "
        "only bound their fraction",
        number_words(median.at_most), std::to_string(num_separated), std::to_string(num));
  }
  std::string beyond = said("{} of {} lie beyond the largest stimulus",
                            std::to_string(num_beyond), std::to_string(num));
  // If exactly half of the people lie beyond, the median is the mean of a known fraction and
  // one beyond.
  if (2 * num_beyond == num) return beyond;
  return said("> {}: {}, or have flat or inverted answers", number_words(fractions.largest),
              beyond);
}

/// Writes the estimates with one kind of pse.
class OwnFractionWriter {
 public:
  OwnFractionWriter(ResultsSection& section, const std::vector<DiscriminationAnswers>& all,
                    const BlockDesign& block, const ResultsOptions& options, bool is_primary)
      : section_(section),
        options_(options),
        is_primary_(is_primary),
        free_pse_(section.own_fractions_free_pse == is_primary),
        block_(block.block),
        fractions_(own_fractions(all, {.free_pse = free_pse_})) {
    for (std::size_t i = 0; i < all.size(); ++i) everyone_.push_back(i);
  }

  void write() {
    if (is_primary_) name_those_without();
    write_median();
    write_spread();
    write_plain();
  }

 private:
  [[nodiscard]] std::string pse_words() const {
    return free_pse_ ? said(", pse free") : said(", pse at the reference");
  }

  Estimate& add(const std::string& name, const std::string& meaning) {
    const std::string suffix = is_primary_ ? "" : free_pse_ ? "_free_pse" : "_at_reference";
    section_.estimates.push_back(
        {.name = block_ + ".individual_weber_fraction_" + name + suffix,
         .unit = "1",
         .meaning = meaning,
         .n = static_cast<int>(fractions_.people.size())});
    return section_.estimates.back();
  }

  void name_those_without() {
    for (const OwnFraction& one : fractions_.people) {
      if (one.weber_fraction) continue;
      section_.excluded.push_back(
          {one.participant, without_words(block_, free_pse_) + one.reason});
    }
  }

  void write_median() {
    Estimate& median =
        add("median", said("median of the participants' own fractions{}", pse_words()));
    const Statistic statistic = [&](const Places& places) {
      return own_fraction_quantile(fractions_, places, 0.5);
    };
    const CensoredValue found = statistic(everyone_);
    median.value = found.value();
    median.ci95 = interval_of(statistic, everyone_.size(), options_);
    // The fraction is above 0 in any case.
    if (median.ci95.low && *median.ci95.low <= 0.0) median.ci95.low.reset();
    if (median.value) return;
    median.reason = untold_words(fractions_, found);
    section_.excluded.push_back(
        {"everyone", said("{}: no value, {}", median.name, median.reason)});
  }

  void write_spread() {
    Estimate& spread = add(
        "robust_sd",
        said("interquartile range / 1.349 of the participants' own fractions{}", pse_words()));
    if (everyone_.size() < 2) {
      spread.reason = said("one participant has no spread");
      return;
    }
    const Statistic statistic = [&](const Places& places) {
      return own_fraction_spread(fractions_, places);
    };
    spread.value = statistic(everyone_).value();
    spread.ci95 = interval_of(statistic, everyone_.size(), options_);
    if (!spread.value) {
      spread.reason = said("a quartile lies among the fractions that the stimuli do not tell");
    }
  }

  void write_plain() {
    const int num_beyond = fractions_.num_beyond();
    add("beyond_stimuli", said("participants whose own fraction{}, lies beyond the largest "
                               "stimulus of the block, or is not finite",
                               pse_words()))
        .value = num_beyond;
    std::vector<double> values;
    for (const OwnFraction& one : fractions_.people) {
      if (one.weber_fraction) values.push_back(*one.weber_fraction);
    }
    const Summary summary = summary_of(values);
    // A single fraction beyond the stimuli, whose size they cannot determine, makes mean and
    // standard deviation meaningless.
    const bool are_all_told = num_beyond == 0 && values.size() == fractions_.people.size();
    const auto add_plain = [&](const std::string& name, const std::optional<double>& value,
                               const std::string& meaning) {
      Estimate& estimate = add(name, meaning);
      estimate.n = summary.num_values;
      if (are_all_told) estimate.value = value;
      if (estimate.value) return;
      estimate.reason = are_all_told ? said("one participant has no spread")
                                     : said("somebody has no fraction within the stimuli");
    };
    add_plain(
        "mean", summary.mean,
        said("plain mean{}, where all lie within the stimuli (biased upwards at few answers)",
             pse_words()));
    add_plain(
        "sd", summary.standard_deviation,
        said("plain standard deviation{}, where all lie within the stimuli", pse_words()));
  }

  ResultsSection& section_;
  const ResultsOptions& options_;
  bool is_primary_, free_pse_;
  std::string block_;
  OwnFractions fractions_;
  Places everyone_;
};

}  // namespace

bool OwnFraction::is_beyond_stimuli() const { return !std::isfinite(at_most); }

int OwnFractions::num_beyond() const {
  return static_cast<int>(std::ranges::count_if(people, &OwnFraction::is_beyond_stimuli));
}

OwnFractions own_fractions(const std::vector<DiscriminationAnswers>& all,
                           const OwnFitOptions& options) {
  OwnFractions fractions;
  // The largest stimulus of everybody is used. If answers choose the levels, a participant's
  // own levels near the threshold are no limit.
  for (const DiscriminationAnswers& answers : all) {
    fractions.largest =
        std::max(fractions.largest, answers.levels.rbegin()->first / answers.reference - 1.0);
  }
  for (const DiscriminationAnswers& answers : all) {
    OwnFitOptions plain = options;
    plain.corrected = plain.intervals = false;
    plain.num_goodness = 0;
    const PsychometricFit fit = own_fit(answers, plain);
    OwnFraction one{.participant = answers.participant,
                    .weber_fraction = fit.weber_fraction,
                    .reason = fit.reason,
                    .at_least = fractions.largest,
                    .at_most = kInfinity};
    if (fit.weber_fraction && *fit.weber_fraction <= fractions.largest) {
      one.at_least = one.at_most = *fit.weber_fraction;
    } else if (!fit.weber_fraction) {
      plain.corrected = true;
      one.mended = own_fit(answers, plain).weber_fraction;
      if (one.mended && *one.mended < fractions.largest) {
        one.at_least = 0.0;
        one.at_most = *one.mended;
      }
    }
    fractions.people.push_back(std::move(one));
  }
  return fractions;
}

std::optional<double> CensoredValue::value() const {
  const bool is_told = at_least == at_most && std::isfinite(at_most);
  return is_told ? std::optional(at_most) : std::nullopt;
}

std::string without_words(const std::string& block, bool free_pse) {
  return said("{}: no Weber fraction of their own with {}", block,
              (free_pse ? said("a free pse, ") : said("the pse at the reference, ")));
}

CensoredValue own_fraction_quantile(const OwnFractions& fractions, const Places& places,
                                    double probability) {
  std::vector<double> at_least, at_most;
  for (const std::size_t place : places) {
    at_least.push_back(fractions.people[place].at_least);
    at_most.push_back(fractions.people[place].at_most);
  }
  return {quantile_of(std::move(at_least), probability),
          quantile_of(std::move(at_most), probability)};
}

CensoredValue own_fraction_spread(const OwnFractions& fractions, const Places& places) {
  constexpr double kOfNormal = 1.349;
  const CensoredValue low = own_fraction_quantile(fractions, places, 0.25);
  const CensoredValue high = own_fraction_quantile(fractions, places, 0.75);
  return {std::max(0.0, high.at_least - low.at_most) / kOfNormal,
          (high.at_most - low.at_least) / kOfNormal};
}

void add_individual_fractions(ResultsSection& section,
                              const std::vector<DiscriminationAnswers>& all,
                              const BlockDesign& block, const ResultsOptions& options) {
  for (const bool is_primary : {true, false}) {
    OwnFractionWriter(section, all, block, options, is_primary).write();
  }
}

}  // namespace jnd::analysis
