#pragma once

#include <atomic>
#include <cstdint>

#include "core/exchange/latest_value.h"
#include "device/network/datagram.h"
#include "device/simulated_hand.h"

namespace jnd::device {

/// The simulated person at a remote device. Orders wait here until the device has taken them.
/// The functions of `SimulatedHand` are for the thread that gives orders, all others for the
/// loop's thread.
class RemoteHand final : public SimulatedHand {
 public:
  void begin_strokes(const StrokePlan& plan, const core::RandomStream& random) override;
  void go_home() noexcept override;
  [[nodiscard]] std::int64_t strokes_finished() const noexcept override;
  [[nodiscard]] bool is_home() const noexcept override;
  void put_fingers_back() noexcept override;

  /// Forgets the orders. Call it while nobody else uses the object.
  void reset() noexcept;
  /// Takes in the hand's progress. Returns the order that the device does not know yet, or
  /// nullptr. Real time.
  [[nodiscard]] const wire::Order* order_after(const wire::State& state) noexcept;

 private:
  void move(bool stroke) noexcept;
  void give() noexcept;

  core::LatestValue<wire::Order> orders_;
  wire::Order last_order_;
  std::uint32_t last_stroke_order_ = 0;
  /// Number of the order in force in the upper half, 2 * strokes + home in the lower half.
  std::atomic<std::uint64_t> progress_{1};
};

}  // namespace jnd::device
