#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/random_stream.h"

namespace jnd::experiments {

/// Constraints on an order of trials. Labels say what counts as equal: a condition, a stimulus,
/// a side.
struct OrderConstraints {
  std::optional<int> max_in_a_row;  ///< Equal labels in a row, >= 1.
  /// Places from a label to the next equal one, >= 1. 2 means never in a row, 3 means at least
  /// two others in between.
  int min_distance = 1;
  std::vector<std::string> not_first;  ///< Labels that must not come first.
};

/// Whether labels in this order meet the constraints.
[[nodiscard]] bool meets(const std::vector<std::string>& labels,
                         const OrderConstraints& constraints);

/// How an order was found.
enum class OrderMethod {
  kRejection,  ///< Shuffled until an order met the constraints: uniform.
  /// Each place drawn by the number of ways to continue: uniform, apart from rounding.
  kCounting,
  kSearch,  ///< Built with back-tracking: not uniform.
};

struct ConstrainedOrder {
  std::vector<std::size_t> order;  ///< Indices of the items in order.
  OrderMethod method = OrderMethod::kRejection;

  /// Whether every order that meets the constraints was equally likely.
  [[nodiscard]] bool is_uniform() const noexcept { return method != OrderMethod::kSearch; }
};

/// After how much work a method gives way to the next. The defaults take less than a second.
struct ShuffleEffort {
  int max_shuffles = 500;
  int max_states = 50'000;  ///< Largest number of states that counting may visit.
  int max_steps = 200'000;  ///< Largest number of steps that the search may take.
};

/// Shuffles items with these labels. It tries the methods in the order of `OrderMethod`. The
/// first two make every order that meets the constraints equally likely, and succeed except for
/// large lists with many labels and wide distances. The order depends on the stream alone.
///
/// Throws `Error` if a constraint is invalid, if no order can meet the constraints (by counting
/// places, or because all orders were tried), or if none was found. Not real time.
[[nodiscard]] ConstrainedOrder mixed_order(const std::vector<std::string>& labels,
                                           const OrderConstraints& constraints,
                                           core::RandomStream& stream,
                                           const ShuffleEffort& effort = {});

}  // namespace jnd::experiments
