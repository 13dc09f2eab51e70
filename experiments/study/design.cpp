#include "experiments/study/design.h"

#include <algorithm>

namespace jnd::experiments {

namespace {

struct MeasureWords {
  ContrastMeasure measure;
  const char *key, *words;  ///< Spelling in the study file, and words for a sentence.
};

constexpr MeasureWords kMeasures[] = {
    {ContrastMeasure::kWeberFraction, "weber_fraction", "Weber fraction"},
    {ContrastMeasure::kPse, "pse", "point of subjective equality"},
    {ContrastMeasure::kExponent, "exponent", "exponent"},
    {ContrastMeasure::kMagnitude, "magnitude", "magnitude"},
    {ContrastMeasure::kMatch, "match", "match"},
    {ContrastMeasure::kRating, "rating", "rating"},
    {ContrastMeasure::kQuestion, "question", "answer to the question"},
    {ContrastMeasure::kResponseTime, "response_time", "response time"}};

const MeasureWords& words_of(ContrastMeasure measure) {
  return *std::ranges::find(kMeasures, measure, &MeasureWords::measure);
}

}  // namespace

std::string to_string(ContrastMeasure measure) { return words_of(measure).key; }

std::string measure_words(const PlannedContrast& plan) {
  const std::string words = words_of(plan.measure).words;
  return plan.question.empty() ? words : words + " " + plan.question;
}

const std::vector<ContrastMeasure>& contrast_measures() {
  static const std::vector<ContrastMeasure> kAll = [] {
    std::vector<ContrastMeasure> all;
    for (const MeasureWords& one : kMeasures) all.push_back(one.measure);
    return all;
  }();
  return kAll;
}

std::string to_string(Correction correction) {
  return correction == Correction::kHolm         ? "holm"
         : correction == Correction::kBonferroni ? "bonferroni"
                                                 : "none";
}

std::string to_string(ContrastDirection direction) {
  return direction == ContrastDirection::kGreater ? "greater"
         : direction == ContrastDirection::kLess  ? "less"
                                                  : "either";
}

std::string to_string(AlphaSpending spending) {
  return spending == AlphaSpending::kPocock ? "pocock" : "obrien_fleming";
}

std::string spending_words(AlphaSpending spending) {
  return spending == AlphaSpending::kPocock ? "Pocock" : "O'Brien-Fleming";
}

bool is_ratio(ContrastMeasure measure) noexcept {
  return measure != ContrastMeasure::kExponent && measure != ContrastMeasure::kRating &&
         measure != ContrastMeasure::kQuestion;
}

}  // namespace jnd::experiments
