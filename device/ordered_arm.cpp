#include "device/ordered_arm.h"

namespace jnd::device {

OrderedArm::OrderedArm(const StrokingArm::Parameters& parameters, double period_s)
    : parameters_(parameters), period_s_(period_s), arm_(parameters, period_s) {}

void OrderedArm::begin_strokes(const StrokePlan& plan, const core::RandomStream& random) {
  require_valid(plan);
  give({.stroke = true, .plan = plan, .random = random});
}

void OrderedArm::go_home() noexcept { give({}); }

void OrderedArm::give(const Order& order) noexcept {
  Order numbered = order;
  numbered.number = ++last_order_;
  if (order.stroke) last_stroke_order_ = last_order_;
  orders_.publish(numbered);
}

// Before the loop has taken an order, the progress is still that of the order before.
std::int64_t OrderedArm::strokes_finished() const noexcept {
  const std::uint64_t progress = progress_.load(std::memory_order_relaxed);
  const bool in_force = progress >> 32 >= last_stroke_order_;
  return in_force ? static_cast<std::int64_t>((progress & 0xffffffff) >> 1) : 0;
}

bool OrderedArm::is_home() const noexcept {
  const std::uint64_t progress = progress_.load(std::memory_order_relaxed);
  return progress >> 32 == last_order_ && (progress & 1) == 1;
}

void OrderedArm::reset() {
  arm_ = StrokingArm(parameters_, period_s_);
  puts_back_.store(false, std::memory_order_relaxed);
  (void)orders_.fetch();
  progress_.store(std::uint64_t{orders_.value().number} << 32 | 1, std::memory_order_relaxed);
}

void OrderedArm::follow_orders() noexcept {
  if (!orders_.fetch()) return;
  const Order& order = orders_.value();
  if (order.stroke) {
    arm_.begin_strokes(order.plan, order.random);
  } else {
    arm_.go_home();
  }
}

void OrderedArm::advance() noexcept {
  arm_.advance();
  const std::uint64_t home = arm_.is_home() ? 1 : 0;
  const auto strokes = static_cast<std::uint64_t>(arm_.strokes_finished());
  const std::uint64_t order = orders_.value().number;
  progress_.store(order << 32 | strokes << 1 | home, std::memory_order_relaxed);
}

}  // namespace jnd::device
