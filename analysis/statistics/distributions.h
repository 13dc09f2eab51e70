#pragma once

namespace jnd::analysis {

// Tails and quantiles of the distributions that tests and intervals stand on, in double
// precision. Degrees of freedom are numbers > 0, not necessarily whole. A probability of 0 or 1
// has no finite quantile and throws std::overflow_error; what is out of range throws
// std::domain_error. Not real time.

/// The z below which a standard normal number lies with this probability.
[[nodiscard]] double normal_quantile(double probability);
/// The z that a standard normal number exceeds with this probability, exact for the smallest.
[[nodiscard]] double normal_quantile_above(double probability);

/// P(T > t) of Student's t.
[[nodiscard]] double student_t_above(double t, double degrees_of_freedom);
[[nodiscard]] double student_t_quantile(double probability, double degrees_of_freedom);
/// The t that is exceeded with this probability.
[[nodiscard]] double student_t_quantile_above(double probability, double degrees_of_freedom);

/// P(T <= t) and P(T > t) of the noncentral t. Where its series do not converge, what they came
/// to, or no number; never an exception.
[[nodiscard]] double noncentral_t_below(double t, double degrees_of_freedom,
                                        double noncentrality);
[[nodiscard]] double noncentral_t_above(double t, double degrees_of_freedom,
                                        double noncentrality);

/// P(X > statistic) of chi-squared.
[[nodiscard]] double chi_squared_above(double statistic, double degrees_of_freedom);
[[nodiscard]] double chi_squared_quantile(double probability, double degrees_of_freedom);

/// P(X > statistic) of F.
[[nodiscard]] double fisher_f_above(double statistic, double numerator_degrees_of_freedom,
                                    double denominator_degrees_of_freedom);
[[nodiscard]] double fisher_f_quantile(double probability, double numerator_degrees_of_freedom,
                                       double denominator_degrees_of_freedom);

/// P(X > value) of the gamma distribution with this shape and scale.
[[nodiscard]] double gamma_above(double value, double shape, double scale);

/// P(X >= successes) in this many fair trials; `successes` is at least 1.
[[nodiscard]] double fair_trials_at_least(double successes, double trials);

/// ln Gamma(x) and its first two derivatives, for x > 0.
[[nodiscard]] double log_gamma(double x);
[[nodiscard]] double digamma(double x);
[[nodiscard]] double trigamma(double x);

}  // namespace jnd::analysis
