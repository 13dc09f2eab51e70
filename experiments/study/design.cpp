#include "experiments/study/design.h"

namespace jnd::experiments {

std::string to_string(ContrastMeasure measure) {
  switch (measure) {
    case ContrastMeasure::kWeberFraction:
      return "weber_fraction";
    case ContrastMeasure::kPse:
      return "pse";
    case ContrastMeasure::kExponent:
      return "exponent";
    case ContrastMeasure::kMagnitude:
      return "magnitude";
    case ContrastMeasure::kMatch:
      return "match";
    case ContrastMeasure::kResponseTime:
      return "response_time";
  }
  return "";
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

std::string measure_words(ContrastMeasure measure) {
  switch (measure) {
    case ContrastMeasure::kWeberFraction:
      return "Weber fraction";
    case ContrastMeasure::kPse:
      return "point of subjective equality";
    case ContrastMeasure::kExponent:
      return "exponent";
    case ContrastMeasure::kMagnitude:
      return "magnitude";
    case ContrastMeasure::kMatch:
      return "match";
    case ContrastMeasure::kResponseTime:
      return "response time";
  }
  return "";
}

const std::vector<ContrastMeasure>& contrast_measures() {
  static const std::vector<ContrastMeasure> kAll = {
      ContrastMeasure::kWeberFraction, ContrastMeasure::kPse,   ContrastMeasure::kExponent,
      ContrastMeasure::kMagnitude,     ContrastMeasure::kMatch, ContrastMeasure::kResponseTime};
  return kAll;
}

bool is_ratio(ContrastMeasure measure) noexcept {
  return measure != ContrastMeasure::kExponent;
}

}  // namespace jnd::experiments
