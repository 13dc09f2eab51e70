#pragma once

#include <gtest/gtest.h>

#include "network_fixture.h"

namespace jnd::device {

/// Tests faults of the network, with this number of points attached. The tests judge the forces
/// that the served device received.
class NetworkFaultTest : public NetworkTest, public ::testing::WithParamInterface<int> {
 protected:
  void SetUp() override {
    attach_first(GetParam());
    start();
    ASSERT_GT(total_now_n(), 0.5);
  }
  void TearDown() override { expect_safe_forces(); }

  void delay_all(int num_ms) {
    network.on_send = [this, num_ms](const SimulatedNetwork::Sent& sent) {
      SimulatedNetwork::Sent later = sent;
      later.arrives_ns += num_ms * kMs;
      network.post(later);
    };
  }

  void expect_force_comes_back_when_armed(core::Fault latched = core::Fault::kLinkLost) {
    run(600);
    EXPECT_EQ(fault(), latched) << "latched";
    EXPECT_EQ(total_now_n(), 0.0) << "nobody has armed";
    const std::size_t armed_at = mark();
    loop->rearm();
    run(20);
    EXPECT_LT(max_total_since_n(armed_at), 2.0) << "it fades in";
    run(700);
    EXPECT_EQ(fault(), core::Fault::kNone);
    EXPECT_GT(total_now_n(), 0.5);
  }
};

}  // namespace jnd::device
