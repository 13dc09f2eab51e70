#include "analysis/statistics/distributions.h"

#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/gamma.hpp>
#include <boost/math/distributions/non_central_t.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <boost/math/special_functions/digamma.hpp>
#include <boost/math/special_functions/gamma.hpp>
#include <boost/math/special_functions/trigamma.hpp>

namespace jnd::analysis {
namespace {

namespace math = boost::math;

/// A policy under which a value that cannot be computed is NaN, and no exception is thrown.
using Quiet =
    math::policies::policy<math::policies::domain_error<math::policies::ignore_error>,
                           math::policies::pole_error<math::policies::ignore_error>,
                           math::policies::overflow_error<math::policies::ignore_error>,
                           math::policies::evaluation_error<math::policies::ignore_error>>;
using NoncentralT = math::non_central_t_distribution<double, Quiet>;

}  // namespace

double normal_quantile(double probability) {
  return math::quantile(math::normal(), probability);
}

double normal_quantile_above(double probability) {
  return math::quantile(math::complement(math::normal(), probability));
}

double student_t_above(double t, double degrees_of_freedom) {
  return math::cdf(math::complement(math::students_t(degrees_of_freedom), t));
}

double student_t_quantile(double probability, double degrees_of_freedom) {
  return math::quantile(math::students_t(degrees_of_freedom), probability);
}

double student_t_quantile_above(double probability, double degrees_of_freedom) {
  return math::quantile(math::complement(math::students_t(degrees_of_freedom), probability));
}

double noncentral_t_below(double t, double degrees_of_freedom, double noncentrality) {
  return math::cdf(NoncentralT(degrees_of_freedom, noncentrality), t);
}

double noncentral_t_above(double t, double degrees_of_freedom, double noncentrality) {
  return math::cdf(math::complement(NoncentralT(degrees_of_freedom, noncentrality), t));
}

double chi_squared_above(double statistic, double degrees_of_freedom) {
  return math::cdf(math::complement(math::chi_squared(degrees_of_freedom), statistic));
}

double chi_squared_quantile(double probability, double degrees_of_freedom) {
  return math::quantile(math::chi_squared(degrees_of_freedom), probability);
}

double fisher_f_above(double statistic, double numerator_degrees_of_freedom,
                      double denominator_degrees_of_freedom) {
  return math::cdf(math::complement(
      math::fisher_f(numerator_degrees_of_freedom, denominator_degrees_of_freedom), statistic));
}

double fisher_f_quantile(double probability, double numerator_degrees_of_freedom,
                         double denominator_degrees_of_freedom) {
  return math::quantile(
      math::fisher_f(numerator_degrees_of_freedom, denominator_degrees_of_freedom),
      probability);
}

double gamma_above(double value, double shape, double scale) {
  return math::cdf(math::complement(math::gamma_distribution<double>(shape, scale), value));
}

double fair_trials_at_least(double successes, double trials) {
  return math::cdf(math::complement(math::binomial(trials, 0.5), successes - 1.0));
}

double log_gamma(double x) { return math::lgamma(x); }

double digamma(double x) { return math::digamma(x); }

double trigamma(double x) { return math::trigamma(x); }

}  // namespace jnd::analysis
