#pragma once

#include <atomic>
#include <cstdint>

#include "core/exchange/latest_value.h"
#include "device/network/datagram.h"
#include "device/simulated_hand.h"

namespace jnd::device {

/// The simulated person on a device elsewhere: orders wait here until they have been taken
/// there. What a `SimulatedHand` offers belongs to the one who orders, everything else to the
/// loop's thread.
class RemoteHand final : public SimulatedHand {
 public:
  void begin_strokes(const StrokePlan& plan, const core::RandomStream& random) override;
  void go_home() noexcept override;
  [[nodiscard]] std::int64_t strokes_finished() const noexcept override;
  [[nodiscard]] bool is_home() const noexcept override;
  void put_fingers_back() noexcept override;

  /// Orders forgotten. While nobody else uses it.
  void reset() noexcept;
  /// Takes in how far the hand has come; returns the order that it does not know yet, or
  /// nullptr. Real time.
  [[nodiscard]] const wire::Order* order_after(const wire::State& state) noexcept;

 private:
  void move(bool stroke) noexcept;
  void give() noexcept;

  core::LatestValue<wire::Order> orders_;
  wire::Order last_order_;
  std::uint32_t last_stroke_order_ = 0;
  /// Number of the order in force in the upper half, 2 * strokes + home in the lower.
  std::atomic<std::uint64_t> progress_{1};
};

}  // namespace jnd::device
