#pragma once

#include <atomic>
#include <cstdint>

#include "core/exchange/latest_value.h"
#include "device/simulated_hand.h"
#include "device/stroking_arm.h"

namespace jnd::device {

/// A `StrokingArm` inside of a device, with a place for orders from another thread. The
/// functions of `SimulatedHand` are for the thread that gives orders, all others for the loop's
/// thread.
class OrderedArm final : public SimulatedHand {
 public:
  /// Throws `core::Error` naming the field. Not real time.
  OrderedArm(const StrokingArm::Parameters& parameters, double period_s);

  void begin_strokes(const StrokePlan& plan, const core::RandomStream& random) override;
  void go_home() noexcept override;
  [[nodiscard]] std::int64_t strokes_finished() const noexcept override;
  [[nodiscard]] bool is_home() const noexcept override;
  void put_fingers_back() noexcept override {
    puts_back_.store(true, std::memory_order_relaxed);
  }

  /// Puts the arm home and forgets the orders. Not real time.
  void reset();
  /// Takes the newest order. Call it before the tick uses the arm. Real time.
  void follow_orders() noexcept;
  /// Whether fingers are to be put back now. It returns true once for each request. Real time.
  [[nodiscard]] bool takes_putting_back() noexcept {
    return puts_back_.load(std::memory_order_relaxed) &&
           puts_back_.exchange(false, std::memory_order_relaxed);
  }
  /// Advances by one tick and publishes the progress. Real time.
  void advance() noexcept;
  [[nodiscard]] const StrokingArm& arm() const noexcept { return arm_; }

 private:
  struct Order {
    std::uint32_t number = 0;
    bool stroke = false;  ///< Whether to stroke; if not, to go home.
    StrokePlan plan;
    core::RandomStream random{0, "stroke"};
  };
  void give(const Order& order) noexcept;

  StrokingArm::Parameters parameters_;
  double period_s_;
  StrokingArm arm_;
  core::LatestValue<Order> orders_;
  std::atomic<bool> puts_back_{false};
  std::uint32_t last_order_ = 0;
  std::uint32_t last_stroke_order_ = 0;
  /// Number of the order in force in the upper half, 2 * strokes + home in the lower half.
  std::atomic<std::uint64_t> progress_{1};
};

}  // namespace jnd::device
