#include "analysis/results/contrast_words.h"
#include "analysis/words/said.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace jnd::analysis {
namespace {

using experiments::ContrastDirection;
using experiments::ContrastMeasure;
using experiments::PlannedContrast;

std::string joined(const std::vector<std::string>& words) {
  std::string all;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) all += i + 1 == words.size() ? said(" and ") : ", ";
    all += words[i];
  }
  return all;
}

/// Names in a study join words by `_`.
std::string shown(std::string name) {
  std::ranges::replace(name, '_', ' ');
  return name;
}

using Weights = std::map<std::string, double>;

std::vector<std::string> levels_with(const Weights& weights, bool above) {
  std::vector<std::string> levels;
  for (const auto& [level, weight] : weights) {
    if (above ? weight > 0.0 : weight < 0.0) levels.push_back(shown(level));
  }
  return levels;
}

bool compares(const Weights& weights) { return !levels_with(weights, false).empty(); }

/// The levels to which a contrast is restricted, such as " (priming: primed)".
std::string restriction_words(const PlannedContrast& plan) {
  std::string words;
  for (const auto& [factor, weights] : plan.weights) {
    if (compares(weights)) continue;
    words += " (" + shown(factor) + ": " + joined(levels_with(weights, true)) + ")";
  }
  return words;
}

std::string decimals(double value, int num_decimals) {
  return with_decimal_sign(fmt::format("{:.{}f}", value, num_decimals));
}

/// Two decimals for values of the order of 1, and about three significant digits for others.
std::string effect_words(const std::optional<double>& value) {
  if (!value) return said("open");
  const double size = std::abs(*value);
  const int num_decimals = size >= 100.0 ? 0 : size >= 10.0 ? 1 : size >= 0.1 ? 2 : 3;
  return decimals(*value, num_decimals);
}

std::string interval_text(const Interval& interval) {
  return "[" + effect_words(interval.low) + between_numbers() + effect_words(interval.high) +
         "]";
}

std::string test_words(const ContrastTest& test, const PlannedContrast& plan) {
  std::string words;
  if (test.statistic && test.degrees_of_freedom) {
    const double df = *test.degrees_of_freedom;
    const bool is_whole = std::abs(df - std::round(df)) < 1e-6;
    words = ", " + test.statistic_name + "(" + decimals(df, is_whole ? 0 : 1) +
            ") = " + decimals(*test.statistic, 2);
  }
  if (test.p_value) {
    words += ", " + journal_p_words(*test.p_value);
    if (plan.direction != ContrastDirection::kEither) words += said(" (one-sided)");
  }
  return words;
}

/// For example " larger"; " higher" for steps and other answers.
std::string difference_words(ContrastMeasure measure, double effect) {
  if (measure == ContrastMeasure::kExponent) {
    return effect < 0.0 ? said(" smaller") : said(" larger");
  }
  return effect < 0.0 ? said(" lower") : said(" higher");
}

/// The effect of a single factor, such as "was 2.10 times as large in thin as in thick".
std::string main_words(const PlannedContrast& plan, double effect, const Weights& weights) {
  const std::string above = joined(levels_with(weights, true));
  const std::string below = joined(levels_with(weights, false));
  const std::string large =
      plan.measure == ContrastMeasure::kResponseTime ? said("long") : said("large");
  if (is_ratio(plan.measure)) {
    const std::string what = plan.measure == ContrastMeasure::kPse
                                 ? said(", relative to its reference, was ")
                                 : said(" was ");
    return said("{}{} times as {} in {} as in {}", what, effect_words(effect), large, above,
                below);
  }
  return said(" was {}{} in {} than in {}", effect_words(std::abs(effect)),
              difference_words(plan.measure, effect), above, below);
}

/// The effect of several factors, such as "The ratio of the Weber fraction in thin to that in
/// thick was 1.30 times as large in primed as in control".
std::string interaction_words(const PlannedContrast& plan, double effect,
                              const std::vector<const Weights*>& factors) {
  const bool of_ratios = is_ratio(plan.measure);
  std::string subject = said("the {}", said_measure(plan));
  for (std::size_t i = 0; i + 1 < factors.size(); ++i) {
    const std::string above = joined(levels_with(*factors[i], true));
    const std::string below = joined(levels_with(*factors[i], false));
    subject = of_ratios
                  ? said("the ratio of {} in {} to that in {}", subject, above, below)
                  : said("the difference of {} in {} less that in {}", subject, above, below);
  }
  // The sentence begins with a capital letter.
  if (subject.front() >= 'a' && subject.front() <= 'z') {
    subject.front() = static_cast<char>(subject.front() - 'a' + 'A');
  }
  const std::string above = joined(levels_with(*factors.back(), true));
  const std::string below = joined(levels_with(*factors.back(), false));
  if (of_ratios) {
    return said("{} was {} times as large in {} as in {}", subject, effect_words(effect), above,
                below);
  }
  return said("{} was {}{} in {} than in {}", subject, effect_words(std::abs(effect)),
              difference_words(plan.measure, effect), above, below);
}

std::string equivalence_words(const ContrastResult& result) {
  if (!result.equivalence) return "";
  const Equivalence& found = *result.equivalence;
  const bool of_ratios = is_ratio(result.plan.measure);
  const std::string range =
      of_ratios ? said("{} to {}", effect_words(1.0 / found.margin), effect_words(found.margin))
                : said("{} to {}", effect_words(-found.margin), effect_words(found.margin));
  const std::string confidence =
      with_decimal_sign(fmt::format("{:.4g}", 100.0 * (1.0 - 2.0 * result.plan.alpha)));
  return said(
      "{}{}, {} % CI {}, {} (two one-sided tests).",
      (found.is_shown ? said(" It is equivalent to no effect within the margin of ")
                      : said(" Equivalence to no effect was not shown within the margin of ")),
      range, confidence, interval_text(found.interval), journal_p_words(found.p_value));
}

}  // namespace

std::string said_measure(const PlannedContrast& plan) {
  const std::string words = measure_words(plan);
  if (plan.question.empty()) return said_of(words);
  const std::size_t length = words.size() - plan.question.size() - 1;
  return said_of(words.substr(0, length)) + " " + plan.question;
}

std::string journal_p_words(double p_value) {
  if (p_value < 0.001) return said("p < .001");
  if (p_value > 0.999) return said("p > .999");
  const std::string digits = fmt::format("{:.{}f}", p_value, p_value < 0.01 ? 4 : 3);
  return said("p = .{}", digits.substr(2));
}

std::vector<std::string> condition_words(const experiments::ContrastConditions& conditions) {
  std::vector<std::pair<double, std::string>> all;
  for (std::size_t group = 0; group < conditions.groups.size(); ++group) {
    for (std::size_t at = 0; at < conditions.conditions.size(); ++at) {
      const double weight = conditions.weights[group][at];
      const std::string& of_group = conditions.groups[group].name;
      std::string name = conditions.conditions[at].name;
      if (!of_group.empty()) name += ", " + of_group;
      all.emplace_back(-weight, with_decimal_sign(fmt::format("{} ({:+.3g})", name, weight)));
    }
  }
  std::ranges::stable_sort(all, {}, &std::pair<double, std::string>::first);
  std::vector<std::string> words;
  for (const auto& [weight, name] : all) words.push_back(name);
  return words;
}

std::string contrast_sentence(const ContrastResult& result) {
  const PlannedContrast& plan = result.plan;
  if (!result.test.effect) return "";
  std::vector<const Weights*> factors;
  for (const auto& [factor, weights] : plan.weights) {
    if (compares(weights)) factors.push_back(&weights);
  }
  std::string sentence = factors.size() == 1
                             ? said("The {}{}", said_measure(plan),
                                    main_words(plan, *result.test.effect, *factors.front()))
                             : interaction_words(plan, *result.test.effect, factors);
  sentence += said("{}, 95 % CI {}{}", restriction_words(plan), interval_text(result.test.ci95),
                   test_words(result.test, plan));
  if (result.p_value_adjusted && result.test.p_value &&
      *result.p_value_adjusted != *result.test.p_value) {
    sentence += said(", {} adjusted for the family", journal_p_words(*result.p_value_adjusted));
  }
  if (result.sequential && result.sequential->ended)
    sentence += said(", adjusted for the looks");
  return sentence + "." + equivalence_words(result);
}

std::string looks_sentence(const ContrastResult& result) {
  if (!result.sequential) return "";
  const SequentialResult& sequential = *result.sequential;
  std::vector<std::string> looks;
  for (std::size_t look = 0; look < sequential.looks.size(); ++look) {
    looks.push_back(std::to_string(sequential.looks[look]) + " (p < " +
                    with_decimal_sign(fmt::format("{:.2g}", sequential.nominal_levels[look])) +
                    ")");
  }
  return said(
      "The study was to be looked at by the contrast {} after so many complete sessions, and "
      "to end where p is below the level beside: {}. {}",
      shown(result.plan.name), joined(looks),
      (sequential.ended ? said("Its rule ended it at look {}, with {} participants.",
                               std::to_string(sequential.num_looks_taken),
                               std::to_string(sequential.num_participants))
                        : said("Its rule had not ended it when these results were computed.")));
}

}  // namespace jnd::analysis
