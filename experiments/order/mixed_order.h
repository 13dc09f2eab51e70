#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/random_stream.h"

namespace jnd::experiments {

/// What an order of trials must keep to. Labels say what counts as equal: a condition, a
/// stimulus, a side.
struct OrderConstraints {
  std::optional<int> max_in_a_row;  ///< Equal labels, >= 1.
  /// Places from a label to the next equal one, >= 1: 2 is never in a row, 3 is with two others
  /// in between.
  int min_distance = 1;
  std::vector<std::string> not_first;  ///< Labels that must not open the order.
};

/// Whether labels in this order keep to the constraints.
[[nodiscard]] bool meets(const std::vector<std::string>& labels,
                         const OrderConstraints& constraints);

/// How an order was found.
enum class OrderMethod {
  kRejection,  ///< Shuffled until one met the constraints: uniform.
  kCounting,   ///< Each place drawn by the number of ways to go on: uniform, to rounding.
  kSearch,     ///< Built with back-tracking: not uniform.
};

struct ConstrainedOrder {
  std::vector<std::size_t> order;  ///< Indices of the items, as they come.
  OrderMethod method = OrderMethod::kRejection;

  /// Every order that meets the constraints was equally likely.
  [[nodiscard]] bool is_uniform() const noexcept { return method != OrderMethod::kSearch; }
};

/// After how much work a method gives way to the next; the defaults take less than a second.
struct ShuffleEffort {
  int max_shuffles = 500;
  int max_states = 50'000;  ///< Most states that counting may visit.
  int max_steps = 200'000;  ///< Most steps that the search may take.
};

/// Shuffles items that have these labels. Tries the methods in the order of `OrderMethod`; the
/// first two make every order that meets the constraints equally likely, and cover all but
/// large lists with many labels and wide distances. The order depends on the stream alone.
///
/// Throws `Error` if a constraint is none, if no order can meet them (by counting places, or by
/// having gone through all), or if none was found. Not real time.
[[nodiscard]] ConstrainedOrder mixed_order(const std::vector<std::string>& labels,
                                           const OrderConstraints& constraints,
                                           core::RandomStream& stream,
                                           const ShuffleEffort& effort = {});

}  // namespace jnd::experiments
