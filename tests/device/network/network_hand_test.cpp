#include <gtest/gtest.h>

#include <functional>
#include <vector>

#include "core/error.h"
#include "device/exoskeleton/exoskeleton_device.h"
#include "device/lumped_hand_device.h"
#include "network_fixture.h"

namespace jnd::device {
namespace network_hand_test {

using NetworkHandTest = NetworkTest;

TEST_F(NetworkHandTest, OrdersReachASimulatedHandThroughABadNetwork) {
  LumpedHandDevice lumped({});
  lumped.open();
  served = &lumped;
  serve({});
  start();
  network.on_send = [this, n = 0](const SimulatedNetwork::Sent& sent) mutable {
    if (++n % 40 >= 10) network.post(sent);
  };
  SimulatedHand* hand = device->simulated_hand();
  ASSERT_NE(hand, nullptr);
  EXPECT_THROW(hand->begin_strokes({.amplitude_m = -1.0}, core::RandomStream(1, "x")),
               core::Error);
  hand->begin_strokes({.num_strokes = 2}, core::RandomStream(4, "strokes"));
  EXPECT_FALSE(hand->is_home()) << "an order given counts at once";
  EXPECT_EQ(hand->strokes_finished(), 0);
  network.on_send = nullptr;
  int num_ms = 0;
  while (!hand->is_home() && num_ms++ < 60'000) run(1);
  EXPECT_EQ(hand->strokes_finished(), 2);
  hand->begin_strokes({}, core::RandomStream(4, "strokes"));
  EXPECT_EQ(hand->strokes_finished(), 0);
  run(3000);
  EXPECT_FALSE(hand->is_home());
  EXPECT_GT(device->contact_sums().num_ticks, 3000);
  EXPECT_GT(device->contact_sums().rendered_opposing_n, 0.0);
  hand->go_home();
  run(5000);
  EXPECT_TRUE(hand->is_home());
}

TEST_F(NetworkHandTest, AFingerThatCameOffIsPutBackThroughABadNetwork) {
  ExoskeletonDevice robot({});
  served = &robot;
  serve({});
  connect();
  commands.publish({.sequence = 2});
  run(50);
  robot.detach(3);
  robot.detach(4);
  run(5);
  published_telemetry.fetch();
  EXPECT_EQ(published_telemetry.value().sample.attached_bits, 0b00111);
  lose_every(3, kServer);
  device->simulated_hand()->put_fingers_back();
  run(30);
  network.on_send = nullptr;
  run(1500);
  published_telemetry.fetch();
  EXPECT_EQ(published_telemetry.value().sample.attached_bits, 0b11111);
  robot.detach(3);
  run(300);
  published_telemetry.fetch();
  EXPECT_EQ(published_telemetry.value().sample.attached_bits, 0b10111)
      << "asked once, done once";
}

TEST_F(NetworkHandTest, TheHandMovesAsItWouldWithoutANetwork) {
  const StrokePlan plan{.num_strokes = 1};
  const core::RandomStream random(9, "strokes");
  const auto path_of = [](LumpedHandDevice& lumped, const std::function<void()>& tick) {
    std::vector<double> path;
    core::HapticState state;
    while (path.size() < 2000) {
      tick();
      (void)lumped.read(state);
      if (!path.empty() || state.tip_velocity_m_per_s[0].norm() > 0.0) {
        path.push_back(state.tip_position_m[0].x());
      }
    }
    return path;
  };
  LumpedHandDevice near({}), far({});
  near.open();
  near.simulated_hand()->begin_strokes(plan, random);
  const std::vector<double> expected =
      path_of(near, [&] { (void)near.write(core::zero_vectors()); });
  far.open();
  served = &far;
  serve({});
  device = make_device();
  device->open();
  device->simulated_hand()->begin_strokes(plan, random);
  core::HapticState state;
  EXPECT_EQ(path_of(far,
                    [&] {
                      run(1);
                      (void)device->read(state);
                      (void)device->write(core::zero_vectors());
                    }),
            expected);
}

TEST_F(NetworkHandTest, AHandWhoseProgramIsGoneGoesHome) {
  LumpedHandDevice lumped({});
  lumped.open();
  served = &lumped;
  serve({});
  start();
  device->simulated_hand()->begin_strokes({}, core::RandomStream(4, "strokes"));
  run(1000);
  loop_runs = false;
  run(4000);
  EXPECT_TRUE(lumped.simulated_hand()->is_home());
}

}  // namespace network_hand_test
}  // namespace jnd::device
