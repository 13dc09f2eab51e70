#pragma once

#include <functional>
#include <string>

#include "device/bench.h"

namespace jnd::app {

/// A person at a real device, who is asked to do each thing.
class AskedBench final : public device::Bench {
 public:
  /// Tells the person what to do, in whole sentences, and returns when it is done. May throw
  /// `core::Error` if nobody answers.
  using Ask = std::function<void(const std::string& to_do)>;

  explicit AskedBench(Ask ask) : ask_(std::move(ask)) {}

  void take_hand_out() override;
  void home() override;
  void clamp() override;
  void expect_force() override;
  void touch(const Eigen::Vector3d& mark_m) override;
  void let_go() override;
  void let_go_without_force() override;
  void hang(double load_kg) override;

 private:
  Ask ask_;
  bool is_held_ = false;
};

}  // namespace jnd::app
