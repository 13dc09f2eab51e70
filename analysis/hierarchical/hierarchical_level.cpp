#include "analysis/hierarchical/hierarchical_level.h"

#include <cmath>

#include "analysis/fits/log_product.h"
#include "analysis/fits/normal_tail.h"

namespace jnd::analysis {

Predictor predictor(HierarchicalLink link, double slope, double place, double u) noexcept {
  if (link == HierarchicalLink::kLinear) return {slope * u + place, u, 1.0};
  const double z = slope * (u - place);  // Here `slope` is e^a.
  return {z, z, -slope};
}

double slope_of(HierarchicalLink link, double number) noexcept {
  return link == HierarchicalLink::kLinear ? number : std::exp(number);
}

AnswerProbabilities answer_probabilities(double z, double lapse_rate, double guess_rate,
                                         AnswersWanted wanted) noexcept {
  if (lapse_rate == 0.0 && guess_rate == 0.0) {
    const LogNormalTails tails = log_normal_tails(z);
    return {tails.log_lower, tails.log_upper, tails.mills_lower, tails.mills_upper};
  }
  const NormalTails tails = normal_tails(z);
  if (guess_rate == 0.0) {
    const double share = 1.0 - 2.0 * lapse_rate;
    const double yes = lapse_rate + share * tails.lower, no = lapse_rate + share * tails.upper;
    const double by_z = share * tails.density, by_lapse = tails.upper - tails.lower;
    // Most levels far from the reference have answers of one kind only, and logarithms take
    // time.
    AnswerProbabilities found{};
    if (wanted.of_yes) {
      found.log_yes = std::log(yes);
      found.by_z_yes = by_z / yes;
      found.by_lapse_yes = by_lapse / yes;
    }
    if (wanted.of_no) {
      found.log_no = std::log(no);
      found.by_z_no = by_z / no;
      found.by_lapse_no = -by_lapse / no;
    }
    return found;
  }
  const double share = 1.0 - guess_rate - lapse_rate;
  const double right = guess_rate + share * tails.lower;
  const double by_z = share * tails.density, by_lapse = -tails.lower;
  if (lapse_rate == 0.0) {  // Without lapses a wrong answer may be arbitrarily improbable.
    const LogNormalTails logs = log_normal_tails(z);
    return {std::log(right), std::log(share) + logs.log_upper, by_z / right, logs.mills_upper};
  }
  const double wrong = lapse_rate + share * tails.upper;
  return {std::log(right), std::log(wrong),  by_z / right,
          by_z / wrong,    by_lapse / right, -by_lapse / wrong};
}

ScatteredSide scattered_side(double count, double log_p, double by_z, double by_lapse,
                             double phi) {
  if (!(count > 0.0)) return {};
  // The first factor may be arbitrarily small, so the caller passes its logarithm.
  const double p = std::exp(log_p);
  const LogProduct others = log_product(p + phi, phi, count - 1.0);
  const double by_p = 1.0 + p * others.by_first;
  return {.value = log_p + others.value,
          .by_z = by_z * by_p,
          .squares = by_z * by_z * (1.0 + p * p * others.squares),
          .by_lapse = by_lapse * by_p,
          .by_scatter = others.by_first + others.by_step};
}

double scattered_value(double count, double log_p, double phi) {
  if (!(count > 0.0)) return 0.0;
  return log_p + log_product_value(std::exp(log_p) + phi, phi, count - 1.0);
}

ScatterTotal scatter_total(double num_answers, double phi) {
  const LogProduct all = log_product(1.0, phi, num_answers);
  return {all.value, all.by_step};
}

}  // namespace jnd::analysis
