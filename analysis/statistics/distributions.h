#pragma once

namespace jnd::analysis {

// Tails and quantiles of the distributions that tests and intervals need, in double precision.
// Degrees of freedom are > 0 and need not be whole. A probability of 0 or 1 has no finite
// quantile and throws std::overflow_error. Arguments out of range throw std::domain_error.
// Not real time.

/// The z with P(Z < z) = probability for a standard normal Z.
[[nodiscard]] double normal_quantile(double probability);
/// The z with P(Z > z) = probability for a standard normal Z. It is accurate for the smallest
/// probabilities.
[[nodiscard]] double normal_quantile_above(double probability);

/// P(T > t) of Student's t.
[[nodiscard]] double student_t_above(double t, double degrees_of_freedom);
[[nodiscard]] double student_t_quantile(double probability, double degrees_of_freedom);
/// The t that is exceeded with this probability.
[[nodiscard]] double student_t_quantile_above(double probability, double degrees_of_freedom);

/// P(T <= t) and P(T > t) of the noncentral t. If a series does not converge, the result is its
/// last value or NaN. They never throw.
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

/// P(X >= successes) in `trials` fair trials. `successes` is at least 1.
[[nodiscard]] double fair_trials_at_least(double successes, double trials);

/// ln Gamma(x) and its first two derivatives, for x > 0.
[[nodiscard]] double log_gamma(double x);
[[nodiscard]] double digamma(double x);
[[nodiscard]] double trigamma(double x);

}  // namespace jnd::analysis
