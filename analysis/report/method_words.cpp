#include "analysis/report/method_words.h"

#include <algorithm>
#include <set>

#include "analysis/data/presentation_use.h"
#include "analysis/report/literature.h"
#include "analysis/report/test_methods.h"
#include "analysis/report/threshold_methods.h"
#include "analysis/results/inverted_answers.h"
#include "analysis/words/said.h"

namespace jnd::analysis {
namespace {

/// Writes the paragraphs and collects what they cite.
class MethodWriter {
 public:
  explicit MethodWriter(const ReportSource& source) : source_(source) {
    for (const ResultsSection& section : source.results.sections) {
      for (const NamedComparison& named : section.comparisons) {
        if (named.comparison.status == FitStatus::kOk) comparisons_.push_back(&named);
      }
    }
  }

  [[nodiscard]] MethodWords finish() && { return {std::move(topics_), literature_of(cited_)}; }

  void write_analysis();
  void write_psychometric();
  void write_wrong_way_round();
  void write_thresholds();
  void write_hierarchical();
  void write_power_laws();
  void write_matching();
  void write_groups();
  void write_tests();
  void write_movement();

 private:
  /// Returns a citation such as "Holm 1979", and adds it to the list of references.
  std::string cite(const std::string& work) {
    cited_.insert(work);
    return work;
  }
  void add(const std::string& topic, const std::string& text) {
    if (!text.empty()) topics_.emplace_back(topic, text);
  }
  [[nodiscard]] bool any_block(bool (BlockDesign::*measure)() const) const {
    return std::ranges::any_of(source_.data.blocks, measure);
  }
  [[nodiscard]] bool discriminates() const { return any_block(&BlockDesign::compares); }
  /// Whether a participant answers the wrong way round, and is either included in the numbers
  /// or left out for it.
  [[nodiscard]] bool any_inverted() const {
    return std::ranges::any_of(source_.data.participants,
                               [](const auto& one) { return !one.left_out.empty(); }) ||
           !inverted_answers(source_.data).empty();
  }
  [[nodiscard]] bool has_magnitudes() const {
    return any_block(&BlockDesign::estimates) || any_block(&BlockDesign::produces);
  }

  const ReportSource& source_;
  std::vector<const NamedComparison*> comparisons_;
  std::vector<std::pair<std::string, std::string>> topics_;
  std::set<std::string> cited_;
};

void MethodWriter::write_analysis() {
  std::string text = said("Computed by jnd {}. Each table says what is estimated and how.",
                          source_.program_version);
  if (!source_.data.blocks.empty()) {
    text += said(
        " Where a value does not exist for the data, it is left out with the reason, never "
        "replaced by a number. Trials that were undone or set aside and sessions of "
        "participants who withdrew are left out");
  } else {
    text += said(" Sessions of participants who withdrew are left out");
  }
  text +=
      source_.pilot ? said("; PILOT sessions are included.") : said(", as are pilot sessions.");
  if (!source_.results.citation.empty()) {
    text += said(" Published values, for comparison alone: {}", source_.results.citation);
  }
  add(said("Analysis"), text);
}

void MethodWriter::write_psychometric() {
  if (!discriminates()) return;
  add(said("Psychometric function"),
      said(
          "The probability of the answer “more than the reference” at intensity x is P(x) = "
          "Φ(ln(x / PSE) / ln(1 + w)), Φ being the standard normal distribution function ({}): "
          "50 % at the point of subjective equality PSE, 84.13 % at PSE (1 + w) and 15.87 % at "
          "PSE / (1 + w), w being the Weber fraction: half the distance between the two on the "
          "logarithmic scale. There are no lapses in it (lapse rate 0). “PSE at the reference” "
          "fixes PSE = reference; otherwise it is free. Group curves “as Schmidt (2018)” are "
          "unweighted least squares on the proportions pooled over participants, one term a "
          "level; all others are of maximum likelihood, answers being binomial. Intervals of "
          "one participant’s w and PSE are those of the likelihood ratio, profiled over the "
          "other parameter: all values whose log-likelihood is at most 1.92 (half the 95 % "
          "quantile of χ² with 1 degree of freedom) below the greatest; an end that the "
          "answers do not bound is open. No curve exists for answers that one threshold "
          "separates without overlap, or that do not rise with the intensity. Goodness of fit: "
          "1000 sets of answers are drawn from the fitted curve (seed {}) and fitted anew; p = "
          "(1 + number with at least the deviance of the data) / 1001 ({}). Error bars of "
          "single proportions are Wilson’s ({}).",
          cite("Bergmann Tiest et al. 2013"), std::to_string(source_.results_options.seed),
          cite("Wichmann and Hill 2001"), cite("Wilson 1927")));
}

void MethodWriter::write_wrong_way_round() {
  if (!any_inverted()) return;
  std::string text;
  if (discriminates()) {
    text = said(
        "Who gives the answer “more” significantly less often the more there is, by the exact "
        "one-sided trend test on the ranks of the intensities ({}) with p < 0.01, is named: as "
        "if the question or the answers had been taken for each other.",
        cite("Armitage 1955"));
  }
  if (has_magnitudes()) {
    text += said(
        "{}Whose magnitudes fall significantly as the intensity grows, or the intensities set "
        "as the target grows, is named as well: Spearman’s rank correlation over all trials, "
        "one-sided, p < 0.01, exact up to 14 trials and beyond by the normal distribution.",
        std::string(text.empty() ? "" : " "));
  }
  add(said("Wrong way round"), text);
}

void MethodWriter::write_thresholds() {
  add_threshold_methods(
      source_.data, [this](const std::string& work) { return cite(work); },
      [this](const std::string& topic, const std::string& text) { add(topic, text); });
}

void MethodWriter::write_hierarchical() {
  const bool any =
      std::ranges::any_of(source_.results.sections, [](const ResultsSection& section) {
        return std::ranges::any_of(section.estimates, [](const Estimate& one) {
          return one.name.ends_with(".weber_fraction_median_person") && one.value;
        });
      });
  if (!any) return;
  add(said("Hierarchical model"),
      said("Everybody’s answers at once: participant i says “more” with probability λ + (1 − "
           "2λ) Φ(e^a_i (ln(x / reference) − p_i)), with a_i = −ln ln(1 + w_i) and p_i = "
           "ln(PSE_i / reference). Over people a and p are normal. The a of two conditions "
           "have a spread each and are correlated; each condition’s p has its own spread and "
           "is independent of all others. “PSE at the reference” sets every p to 0. The "
           "likelihood, integrated over people by adaptive Gauss-Hermite quadrature ({}), is "
           "maximised. The lapse rate λ, one for everybody, keeps the few slips in very easy "
           "comparisons from flattening every curve; the share of random answers, 2λ, has the "
           "prior Beta(1, 20), as answers to hard comparisons alone cannot tell it ({}). The "
           "estimand is the median person’s Weber fraction, which a curve through pooled "
           "answers flattens. Intervals and tests are Wald’s on ln ln(1 + w), the interval of "
           "a condition over all lapse rates that answers and prior leave, with the standard "
           "error times √(n / (n − 1)) and Student’s t with n − 1 degrees of freedom, n being "
           "the number of participants; the standard error of one condition is of the observed "
           "information, that of a difference of the sandwich over participants’ scores ({}; "
           "{}); nobody with answers is left out.",
           cite("Pinheiro and Bates 1995"), cite("Schütt et al. 2016"), cite("Huber 1967"),
           cite("Liang and Zeger 1986")));
}

void MethodWriter::write_power_laws() {
  if (!has_magnitudes()) return;
  std::string text = said(
      "S = k I^a ({}), S being the magnitude as a ratio to the modulus and I the intensity. "
      "Unless a name says otherwise, k and a are of nonlinear least squares of S, through the "
      "arithmetic means over participants, every mean of equal weight",
      cite("Stevens 1957"));
  if (any_block(&BlockDesign::estimates))
    text += said(
        "; means at intensity 0 are left out, where k I^a is 0 for every k and every a > 0, so "
        "that they tell nothing of either");
  text += ".";
  if (any_block(&BlockDesign::counts_in_standard)) {
    text += said(
        " Where a standard was felt that had a number, magnitudes are ratios to it, not to "
        "water.");
  }
  if (any_block(&BlockDesign::counts_in_own_numbers)) {
    text += said(
        " Where everybody chose their own numbers, each participant’s answers are divided by "
        "the geometric mean of their answers to the stimuli that all answered ({}) before "
        "anything else: exponents are as they were, k has no meaning, and nothing is compared "
        "in percent of water.",
        cite("Lane et al. 1961"));
  }
  if (any_block(&BlockDesign::produces)) {
    text += said(
        " Production: the magnitude asked for over the mean intensity set, as in Schmidt "
        "(2018); “intensity_on_magnitude” is instead the line ln I = c + d ln S, what was set "
        "on what was asked, turned around to a = 1 / d and k = e^(−c / d).");
  }
  if (source_.results.find("combined.a") != nullptr) {
    text += said(
        " Combined: the power law that lies nearest to both curves (least squares of S) at the "
        "intensities of the estimation.");
  }
  text += said(
      " “log_log” is a line through the logarithms of the arithmetic means above 0, "
      "“geometric” one through the geometric means, where an answer of 0 counts as half the "
      "person’s smallest above 0; both are without intensity 0. “equalised” brings all "
      "participants to the same geometric mean first ({}). Intervals of one participant’s a "
      "and ln k have Student’s t with as many degrees of freedom as points less 2.",
      cite("Lane et al. 1961"));
  add(said("Power laws"), text);
}

void MethodWriter::write_matching() {
  if (!any_block(&BlockDesign::matches)) return;
  add(said("Matching"),
      said("Method of adjustment (as in {}): a match is the intensity at which the comparison "
           "was said to feel like the standard, with free switching between both. Everything "
           "is computed with the logarithms of matches; matches of 0 are left out and counted. "
           "A participant’s value at a standard is the geometric mean over repetitions and "
           "starting values. Over the standard, where both have the same unit, it is the "
           "constant error as a ratio. The spread is the standard deviation of ln(match) about "
           "its mean at each standard, pooled over standards. The effect of the starting value "
           "is the slope of ln(match) on its logarithm that all standards share, each with a "
           "level of its own.",
           cite("Bergmann Tiest et al. 2013")));
}

void MethodWriter::write_groups() {
  std::string text;
  if (discriminates() || has_magnitudes() || any_block(&BlockDesign::matches)) {
    text = said(
        "Group intervals: participants are drawn anew with replacement, {} times (seed {}), "
        "and everything is computed again; the 95 % interval runs between the percentiles α "
        "and 1 − α with α = Φ(−√(n / (n − 1)) t), t being the 97.5 % quantile of Student’s t "
        "with n − 1 degrees of freedom (expanded percentiles, {}), so it respects that people "
        "differ; there is none below 5 participants. ",
        std::to_string(source_.results_options.num_resamples),
        std::to_string(source_.results_options.seed), cite("Hesterberg 2015"));
  }
  if (discriminates()) {
    text += said(
        "Of w and PSE of a curve through everybody’s answers the interval is the value times "
        "exp(±t √(n / (n − 1)) s), s being the standard deviation of the logarithms of those "
        "values ({}), for their percentiles are too narrow with few people. ",
        cite("Efron and Tibshirani 1993"));
  }
  if (!source_.data.blocks.empty() || !source_.data.items.empty()) {
    text += said("Means over participants have Student’s t intervals.");
  }
  add(said("Groups"), text);
}

void MethodWriter::write_tests() {
  add_test_methods(
      comparisons_, discriminates(), [this](const std::string& work) { return cite(work); },
      [this](const std::string& topic, const std::string& text) { add(topic, text); });
}

void MethodWriter::write_movement() {
  const bool presented = !presentation_uses(source_.data).empty();
  if (!presented && !source_.movement.any()) return;
  std::string text = said(
      "A stroke is a full cycle, from a turning point to the other side and back. The hand is "
      "the mean of its contact points, seen from above. The farthest point from the last "
      "turning point becomes one once the hand has come back from it by 3 cm (hysteresis); the "
      "way to the first turning point is left out, and so is a stroke that is not finished, or "
      "that ends farther from its beginning than 0.4 of its width. Width: mean distance "
      "between the turning points of whole strokes; highest speed: mean over strokes of the "
      "highest speed in each.");
  if (presented) {
    text += said(
        " A participant’s value is the mean over presentations with a whole stroke, free space "
        "between stimuli left out; the mean over participants follows.");
    if (source_.results.find("stroke_width_m") != nullptr &&
        std::ranges::any_of(source_.results.sections, [](const ResultsSection& section) {
          return std::ranges::any_of(section.estimates, [](const Estimate& one) {
            return one.name.ends_with(".equal_intervals");
          });
        })) {
      text += said(
          " “References and tests weighed equally”: the mean over references and the mean over "
          "tests, and the mean of the two.");
    }
  }
  if (source_.movement.any()) {
    text += said(
        " From recordings: all whole strokes, after the medium’s ramp, without those with "
        "missing samples, a lost contact or a fault; mean speed is over the time of the "
        "strokes, pauses included.");
  }
  add(said("Movement"), text);
}

}  // namespace

MethodWords method_words(const ReportSource& source) {
  MethodWriter writer(source);
  writer.write_analysis();
  writer.write_psychometric();
  writer.write_wrong_way_round();
  writer.write_thresholds();
  writer.write_hierarchical();
  writer.write_power_laws();
  writer.write_matching();
  writer.write_groups();
  writer.write_tests();
  writer.write_movement();
  return std::move(writer).finish();
}

}  // namespace jnd::analysis
