#include "device/network/remote_hand.h"

namespace jnd::device {

void RemoteHand::begin_strokes(const StrokePlan& plan, const core::RandomStream& random) {
  require_valid(plan);
  last_order_.plan = plan;
  last_order_.random = random;
  move(true);
}

void RemoteHand::go_home() noexcept { move(false); }

void RemoteHand::put_fingers_back() noexcept {
  ++last_order_.num_put_back;
  give();
}

void RemoteHand::move(bool stroke) noexcept {
  last_order_.stroke = stroke;
  last_order_.movement_number = last_order_.number + 1;
  if (stroke) last_stroke_order_ = last_order_.movement_number;
  give();
}

void RemoteHand::give() noexcept {
  ++last_order_.number;
  orders_.publish(last_order_);
}

// Until an order has arrived, the reported progress is that of the order before.
std::int64_t RemoteHand::strokes_finished() const noexcept {
  const std::uint64_t progress = progress_.load(std::memory_order_relaxed);
  const bool in_force = progress >> 32 >= last_stroke_order_;
  return in_force ? static_cast<std::int64_t>((progress & 0xffffffff) >> 1) : 0;
}

bool RemoteHand::is_home() const noexcept {
  const std::uint64_t progress = progress_.load(std::memory_order_relaxed);
  return progress >> 32 == last_order_.number && (progress & 1) == 1;
}

void RemoteHand::reset() noexcept {
  last_order_ = {};
  last_stroke_order_ = 0;
  progress_.store(1, std::memory_order_relaxed);
  orders_.publish(last_order_);
}

const wire::Order* RemoteHand::order_after(const wire::State& state) noexcept {
  orders_.fetch();
  const std::uint64_t home = state.is_home ? 1 : 0;
  const auto strokes = static_cast<std::uint64_t>(state.strokes_finished) & 0x7fffffff;
  progress_.store(std::uint64_t{state.order_number} << 32 | strokes << 1 | home,
                  std::memory_order_relaxed);
  const wire::Order& newest = orders_.value();
  return newest.number != state.order_number ? &newest : nullptr;
}

}  // namespace jnd::device
