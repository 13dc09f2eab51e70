#pragma once

namespace jnd::analysis {

/// The logarithm of a product of evenly spaced factors, with its derivatives by the first
/// factor and by the step between factors.
struct LogProduct {
  double value = 0.0, by_first = 0.0, by_step = 0.0;
  double squares = 0.0;  ///< Minus the second derivative by the first factor.
};

/// The product first (first + step) ... (first + (count - 1) step), computed from its factors
/// or, if they are many, from gamma functions. The likelihood of a beta-binomial count is made
/// of three such products. `first` is > 0, `step` is >= 0, and `count` is a whole number. The
/// product is 1 for a count of 0 or less.
[[nodiscard]] LogProduct log_product(double first, double step, double count);

/// Only the logarithm itself, which is all that most of a search needs.
[[nodiscard]] double log_product_value(double first, double step, double count);

}  // namespace jnd::analysis
