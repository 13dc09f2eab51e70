#pragma once

#include <array>
#include <cstdint>

#include "core/exchange/latest_value.h"
#include "core/require.h"
#include "device/bench.h"

namespace jnd::device {

/// What has been done at a device so far. Trivially copyable.
struct BenchState {
  bool has_hand = true;
  double load_kg = 0.0;
  std::uint32_t num_homings = 0;
  std::uint32_t num_holds = 0;  ///< How often it was clamped or brought to a mark so far.
  bool is_clamped = false;
  bool is_touching = false;
  std::array<double, 3> mark_m{};  ///< The mark, in the workspace frame.
};

/// The bench of a simulated device. One thread acts, and the loop's thread reads the result.
class OrderedBench final : public Bench {
 public:
  void take_hand_out() override {
    done_.has_hand = false;
    told_.publish(done_);
  }
  void home() override {
    ++done_.num_homings;
    told_.publish(done_);
  }
  void clamp() override {
    ++done_.num_holds;
    done_.is_clamped = true;
    done_.is_touching = false;
    told_.publish(done_);
  }
  void touch(const Eigen::Vector3d& mark_m) override {
    ++done_.num_holds;
    done_.is_clamped = false;
    done_.is_touching = true;
    done_.mark_m = {mark_m.x(), mark_m.y(), mark_m.z()};
    told_.publish(done_);
  }
  void let_go() override {
    done_.is_clamped = false;
    done_.is_touching = false;
    told_.publish(done_);
  }
  void let_go_without_force() override { let_go(); }
  void hang(double load_kg) override {
    core::require_not_negative(load_kg, "load_kg");
    done_.load_kg = load_kg;
    told_.publish(done_);
  }

  /// Call it when a device is opened again. The hand is in it, and of what was done only the
  /// homing remains. Not while another function runs.
  void reset() {
    done_ = {.num_homings = done_.num_homings};
    told_.publish(done_);
  }
  /// For the loop's thread. Real time.
  [[nodiscard]] const BenchState& newest() noexcept {
    (void)told_.fetch();
    return told_.value();
  }

 private:
  BenchState done_;  ///< For the thread that acts.
  core::LatestValue<BenchState> told_;
};

}  // namespace jnd::device
