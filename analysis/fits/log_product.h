#pragma once

namespace jnd::analysis {

/// ln of a product of evenly spaced factors and its derivatives in the first factor and in the
/// step between factors.
struct LogProduct {
  double value = 0.0, by_first = 0.0, by_step = 0.0;
  double squares = 0.0;  ///< Minus the second derivative in the first factor.
};

/// first (first + step) ... (first + (count - 1) step), by its factors; where they are many, by
/// gamma functions. The likelihood of a beta-binomial count is made of three of them. `first` >
/// 0, `step` >= 0, `count` a whole number; 1 where it is 0 or less.
[[nodiscard]] LogProduct log_product(double first, double step, double count);

/// Its value alone, which is all that most of a search asks for.
[[nodiscard]] double log_product_value(double first, double step, double count);

}  // namespace jnd::analysis
