#include "analysis/movement/presentation_meter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>

#include "analysis/movement/made_up_recording.h"
#include "support/reference_data.h"

namespace jnd::analysis {
namespace presentation_meter_test {

using nlohmann::json;

constexpr std::int64_t kNumTicks = 16000;

/// Returns whether the sample was recorded.
using Change = std::function<bool(core::Sample&)>;

bool keep(core::Sample&) { return true; }

PresentationMeter::Result metered(std::int64_t num_ticks, const Change& change = keep,
                                  const PresentationMeter::Parameters& parameters = {
                                      .forward = {0.8, 0.6}, .has_joints = true}) {
  PresentationMeter meter(parameters);
  meter.begin({.trial = 1, .first_tick = 0, .last_tick = num_ticks - 1},
              {"viscous", 2.0, std::nullopt});
  for (std::int64_t tick = 0; tick < num_ticks; ++tick) {
    core::Sample sample = made_up_sample(tick);
    if (change(sample)) (void)meter.feed(sample);
  }
  return meter.finish();
}

/// Returns a sample of strokes of 1 s along x, which are 0.4 m wide and begin in the middle.
core::Sample even_sample(std::int64_t tick) {
  const double phase = 2.0 * std::numbers::pi * static_cast<double>(tick) / 1000.0;
  core::Sample sample{.tick = tick, .attached_bits = 31};
  for (auto& position : sample.tip_position_m) position = {0.2 * std::sin(phase), 0.0, -0.1};
  for (auto& velocity : sample.tip_velocity_m_per_s) {
    velocity = {0.4 * std::numbers::pi * std::cos(phase), 0.0, 0.0};
  }
  return sample;
}

PresentationMeter::Result metered_evenly(std::int64_t first_tick, std::int64_t last_tick,
                                         const Change& change = keep) {
  PresentationMeter meter({});
  meter.begin({.first_tick = first_tick, .last_tick = last_tick}, {});
  for (std::int64_t tick = first_tick; tick <= last_tick; ++tick) {
    core::Sample sample = even_sample(tick);
    if (change(sample)) (void)meter.feed(sample);
  }
  return meter.finish();
}

TEST(PresentationMeter, WhatSensorsOfForceMeasureIsWhatWasDelivered) {
  const auto delivered = [](const Change& change) {
    return metered_evenly(0, 4000,
                          [&](core::Sample& sample) {
                            for (std::size_t point = 0; point < 5; ++point) {
                              sample.tip_force_n[point] = {
                                  -2.0 * sample.tip_velocity_m_per_s[point][0], 0, 0};
                            }
                            return change(sample);
                          })
        .movement.force;
  };
  const DeliveredForce sent = delivered(keep);
  EXPECT_NEAR(sent.delivered_damping_n_s_per_m.value(), 10.0, 1e-9);
  EXPECT_FALSE(sent.is_measured);
  const DeliveredForce measured = delivered([](core::Sample& sample) {
    sample.channels.bits = core::kMeasuredForce;
    for (std::size_t point = 0; point < 5; ++point) {
      sample.channels.force_n[point] = {0.8 * sample.tip_force_n[point][0], 0, 0};
    }
    return true;
  });
  EXPECT_NEAR(measured.delivered_damping_n_s_per_m.value(), 8.0, 1e-9);
  EXPECT_TRUE(measured.is_measured);
}

/// The reference in data/reference/movement was measured by NumPy and SciPy with the script
/// beside it.
TEST(PresentationMeter, AgreesWithScipyOnARecordingWithTremorRestAndGap) {
  const json& expected = test_support::reference_data("movement/movement_reference.json");
  const PresentationMeter::Result found =
      metered(kNumTicks,
              [](core::Sample& sample) { return sample.tick < 11000 || sample.tick >= 11100; },
              {.forward = {0.8, 0.6}, .ramp_ticks = 50, .has_joints = true});
  const PresentationMovement& movement = found.movement;
  const auto expect = [&](const char* key, std::optional<double> value) {
    const double number = expected.at(key);
    EXPECT_NEAR(value.value_or(HUGE_VAL), number, 1e-7 * std::abs(number)) << key;
  };
  EXPECT_EQ(movement.marks.missing_ticks, 100);
  EXPECT_EQ(movement.strokes.num_strokes, expected.at("num_strokes"));
  expect("stroke_width_m", movement.strokes.stroke_width_m);
  expect("max_speed_m_per_s", movement.strokes.max_speed_m_per_s);
  expect("mean_speed_m_per_s", movement.strokes.mean_speed_m_per_s);
  expect("stroke_duration_s", movement.strokes.stroke_duration_s);
  expect("pause_s", movement.strokes.pause_s);
  expect("stroke_energy_j", movement.strokes.stroke_energy_j);
  expect("mean_height_m", movement.mean_height_m);
  expect("delivered_n", movement.force.delivered_n);
  expect("commanded_n", movement.force.commanded_n);
  expect("delivered_damping_n_s_per_m", movement.force.delivered_damping_n_s_per_m);
  expect("delivered_ratio", movement.force.delivered_ratio);

  const StrokeCurves curves = found.sums.curves.curves();
  EXPECT_EQ(curves.num_strokes, expected.at("num_curves"));
  EXPECT_EQ(curves.num_joined, 0);
  expect("turn_forward_percent", curves.turn_forward_percent);
  expect("turn_back_percent", curves.turn_back_percent);
  const std::pair<const char*, const CurveBand*> kBands[] = {
      {"forward_velocity_m_per_s", &curves.forward_velocity_m_per_s},
      {"height_m", &curves.height_m},
      {"opposing_force_n", &curves.opposing_force_n},
      {"tip_distance_m.2", &curves.tip_distance_m[2]},
      {"joint_position_rad.0", &curves.joint_position_rad[0]},
      {"joint_position_rad.9", &curves.joint_position_rad[9]},
      {"joint_torque_n_m.21", &curves.joint_torque_n_m[21]}};
  for (const auto& [name, band] : kBands) {
    const json& values = expected.at("curves").at(name);
    ASSERT_EQ(band->mean.size(), 101U);
    for (std::size_t i = 0; i < expected.at("points_percent").size(); ++i) {
      const auto point = expected.at("points_percent")[i].get<std::size_t>();
      EXPECT_NEAR(band->mean[point], values.at("mean")[i].get<double>(), 1e-6) << name;
      EXPECT_NEAR(band->standard_deviation[point], values.at("sd")[i].get<double>(), 1e-7)
          << name;
    }
  }
}

TEST(PresentationMeter, LaysStrokesFromTheMiddleOfTheWayBackOverTheTurnAndForward) {
  const StrokeCurves curves = metered_evenly(0, 5600).sums.curves.curves();
  ASSERT_EQ(curves.num_strokes, 4);
  EXPECT_EQ(curves.num_joined, 0);
  EXPECT_NEAR(*curves.turn_forward_percent, 25.0, 1e-6);
  EXPECT_NEAR(*curves.turn_back_percent, 75.0, 1e-6);
  const double top = 0.4 * std::numbers::pi;
  EXPECT_NEAR(curves.forward_velocity_m_per_s.mean[0], -top, 1e-6);
  EXPECT_NEAR(curves.forward_velocity_m_per_s.mean[25], 0.0, 1e-6);
  EXPECT_NEAR(curves.forward_velocity_m_per_s.mean[50], top, 1e-6);
  EXPECT_NEAR(curves.forward_velocity_m_per_s.mean[100], -top, 1e-6);
  EXPECT_NEAR(curves.forward_velocity_m_per_s.standard_deviation[10], 0.0, 1e-6);
  EXPECT_FALSE(curves.has_joints);
  EXPECT_TRUE(curves.joint_position_rad[0].mean.empty());
}

TEST(PresentationMeter, AShortWayBackToTheUsualEndIsNoHalfOfAStroke) {
  // The recording begins 8 cm from the near end, on the way out. The hand turns and strokes
  // once.
  const auto near_end_first = [](core::Sample& sample) {
    double x_m = 0.0;
    const auto tick = static_cast<double>(sample.tick);
    if (sample.tick < 100) {
      x_m = -0.16 + 0.0008 * tick;
    } else if (sample.tick < 300) {
      x_m = -0.08 - 0.0006 * (tick - 100.0);
    } else {
      x_m = -0.2 * std::cos(2.0 * std::numbers::pi * (tick - 300.0) / 1000.0);
    }
    for (auto& position : sample.tip_position_m) position = {x_m, 0.0, -0.1};
    return true;
  };
  const PresentationMeter::Result found = metered_evenly(0, 1500, near_end_first);
  ASSERT_EQ(found.movement.strokes.num_strokes, 1);
  EXPECT_NEAR(*found.movement.strokes.stroke_width_m, 0.4, 1e-6);
}

TEST(PresentationMeter, JoinsTheEndOfASingleStrokeToItsBeginning) {
  // The hand goes forward from 750 to 1250, and back to 1750. In the second case the way back
  // comes first.
  for (const std::int64_t first_tick : {std::int64_t{600}, std::int64_t{1100}}) {
    const StrokeCurves curves =
        metered_evenly(first_tick, first_tick + 1300).sums.curves.curves();
    ASSERT_EQ(curves.num_strokes, 1) << first_tick;
    EXPECT_EQ(curves.num_joined, 1);
    EXPECT_NEAR(*curves.turn_forward_percent, 25.0, 1e-6);
    EXPECT_NEAR(*curves.turn_back_percent, 75.0, 1e-6);
    for (std::size_t percent = 0; percent <= 100; ++percent) {
      const double phase = 2.0 * std::numbers::pi * static_cast<double>(percent) / 100.0;
      EXPECT_NEAR(curves.forward_velocity_m_per_s.mean[percent],
                  -0.4 * std::numbers::pi * std::cos(phase), 1e-5)
          << percent;
    }
    EXPECT_TRUE(curves.height_m.standard_deviation.empty());
  }
}

TEST(PresentationMeter, DoesNotJoinAStrokeThatEndsFarFromItsBeginning) {
  const StrokeCurves curves = metered_evenly(600, 1900, [](core::Sample& sample) {
                                // The hand comes back only half the way.
                                for (auto& position : sample.tip_position_m) {
                                  if (sample.tick > 1250) position[0] = 0.1 + 0.5 * position[0];
                                }
                                return true;
                              }).sums.curves.curves();
  EXPECT_EQ(curves.num_strokes, 0);
}

TEST(PresentationMeter, NoStrokeReachesAcrossAGap) {
  const PresentationMeter::Result whole = metered_evenly(0, 5600);
  const PresentationMeter::Result torn = metered_evenly(
      0, 5600, [](core::Sample& sample) { return sample.tick < 2500 || sample.tick >= 2510; });
  EXPECT_EQ(whole.movement.marks.missing_ticks, 0);
  EXPECT_EQ(torn.movement.marks.missing_ticks, 10);
  EXPECT_TRUE(torn.movement.marks.any());
  EXPECT_EQ(whole.movement.strokes.num_strokes, 5);
  // Turning points are at 250, 750 ... 2250 and at 2750 ... 5250.
  EXPECT_EQ(torn.movement.strokes.num_strokes, 4);
  EXPECT_NEAR(*torn.movement.strokes.stroke_width_m, 0.4, 1e-9);
  EXPECT_EQ(torn.sums.curves.curves().num_strokes, 2);
}

TEST(PresentationMeter, CountsWhatIsMissingAtBothEndsAndWhatIsNotFinite) {
  const PresentationMeter::Result found = metered_evenly(0, 999, [](core::Sample& sample) {
    if (sample.tick == 500) {
      sample.tip_velocity_m_per_s[3][1] = std::numeric_limits<double>::quiet_NaN();
    }
    return sample.tick >= 7 && sample.tick < 990;
  });
  EXPECT_EQ(found.movement.marks.missing_ticks, 7 + 1 + 10);
  EXPECT_TRUE(std::isfinite(*found.movement.mean_height_m));
}

TEST(PresentationMeter, AStrokeOfWhichAJointIsNotFiniteIsNotLaidOverOthers) {
  const auto num_curves = [](float torque_n_m) {
    const PresentationMeter::Result found = metered(10000, [&](core::Sample& sample) {
      if (sample.tick / 50 == 38) sample.joint_torque_n_m[4] = torque_n_m;
      return true;
    });
    const StrokeCurves curves = found.sums.curves.curves();
    for (const double value : curves.joint_torque_n_m[4].mean) {
      EXPECT_TRUE(std::isfinite(value));
    }
    return curves.num_strokes;
  };
  EXPECT_EQ(num_curves(std::numeric_limits<float>::quiet_NaN()), num_curves(0.0F) - 1);
}

TEST(PresentationMeter, TakesATickOnce) {
  PresentationMeter meter({});
  meter.begin({.first_tick = 0, .last_tick = 9}, {});
  for (std::int64_t tick = 0; tick < 5; ++tick) EXPECT_TRUE(meter.feed(even_sample(tick)));
  EXPECT_FALSE(meter.feed(even_sample(4)));
  EXPECT_FALSE(meter.feed(even_sample(2)));
  for (std::int64_t tick = 5; tick < 10; ++tick) EXPECT_TRUE(meter.feed(even_sample(tick)));
  EXPECT_EQ(meter.finish().movement.marks.missing_ticks, 0);
}

TEST(PresentationMeter, MarksLostContactFaultsAndTheLimiterAndKeepsTheirStrokesOut) {
  const PresentationMeter::Result lost = metered_evenly(0, 5600, [](core::Sample& sample) {
    if (sample.tick >= 2000 && sample.tick < 2100) sample.attached_bits = 0b10111;
    return true;
  });
  EXPECT_EQ(lost.movement.marks.lost_contact_ticks, 100);
  EXPECT_EQ(lost.movement.strokes.num_strokes, 4);
  EXPECT_EQ(lost.sums.curves.curves().num_strokes, 3);

  const PresentationMeter::Result fault = metered_evenly(0, 5600, [](core::Sample& sample) {
    if (sample.tick == 2000) sample.fault = 3;
    return true;
  });
  EXPECT_EQ(fault.movement.marks.fault_ticks, 1);
  EXPECT_EQ(fault.movement.strokes.num_strokes, 4);

  const PresentationMeter::Result limited = metered_evenly(0, 5600, [](core::Sample& sample) {
    sample.limited = sample.tick < 30 ? 1 : 0;
    return true;
  });
  EXPECT_EQ(limited.movement.marks.limited_ticks, 30);
  EXPECT_EQ(limited.movement.strokes.num_strokes, 5);
}

TEST(PresentationMeter, APointThatNeverHeldIsNotLost) {
  const PresentationMeter::Result found = metered_evenly(0, 100, [](core::Sample& sample) {
    sample.attached_bits = 0b00001;
    return true;
  });
  EXPECT_EQ(found.movement.marks.lost_contact_ticks, 0);
}

TEST(PresentationMeter, AStrokeWithAPauseCountsButIsNotLaidOverOthers) {
  PresentationMeter meter({});
  meter.begin({.first_tick = 0, .last_tick = 5899}, {});
  for (std::int64_t tick = 0; tick < 5900; ++tick) {
    // The hand rests for 300 ticks in the middle of a way back.
    const bool rests = tick >= 2500 && tick < 2800;
    core::Sample sample = even_sample(tick < 2500 ? tick : (rests ? 2500 : tick - 300));
    sample.tick = tick;
    if (rests) sample.tip_velocity_m_per_s = {};
    (void)meter.feed(sample);
  }
  const PresentationMeter::Result found = meter.finish();
  EXPECT_EQ(found.movement.marks.missing_ticks, 0);
  EXPECT_EQ(found.movement.strokes.num_strokes, 5);
  EXPECT_NEAR(*found.movement.strokes.pause_s, 0.3 / 5.0, 1e-12);
  EXPECT_NEAR(*found.movement.strokes.stroke_duration_s, 1.0 + 0.3 / 5.0, 1e-12);
  EXPECT_NEAR(*found.movement.strokes.stroke_width_m, 0.4, 1e-9);
  EXPECT_EQ(found.sums.curves.curves().num_strokes, 2);
}

TEST(PresentationMeter, StartsAnewWithEveryPresentation) {
  PresentationMeter meter({});
  PresentationMeter::Result found;
  for (int i = 0; i < 2; ++i) {
    meter.begin({.trial = i, .first_tick = 0, .last_tick = 5600}, {});
    for (std::int64_t tick = 0; tick <= 5600; ++tick) (void)meter.feed(even_sample(tick));
    found = meter.finish();
  }
  EXPECT_EQ(found.movement.trial, 1);
  EXPECT_EQ(found.movement.strokes.num_strokes, 5);
  EXPECT_EQ(found.sums.curves.curves().num_strokes, 4);
}

TEST(MovementSums, ThatAreAddedUpAreThoseOfAllTogether) {
  MovementSums apart;
  BandSums together, first, second;
  for (int stroke = 0; stroke < 5; ++stroke) {
    const std::vector<double> values = {1.0 * stroke, 3.0 - stroke * stroke};
    together.add(values);
    (stroke < 2 ? first : second).add(values);
  }
  first.add(second);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(first.band(i, 1).mean[0], together.band(i, 1).mean[0], 1e-14);
    EXPECT_NEAR(first.band(i, 1).standard_deviation[0],
                together.band(i, 1).standard_deviation[0], 1e-14);
  }
  // The values are 0, 1, 2, 3, 4, with the mean 2 and the variance 10 / 4.
  EXPECT_NEAR(together.band(0, 1).mean[0], 2.0, 1e-15);
  EXPECT_NEAR(together.band(0, 1).standard_deviation[0], std::sqrt(2.5), 1e-15);
  const PresentationMeter::Result once = metered_evenly(0, 5600);
  apart.add(once.sums);
  apart.add(once.sums);
  EXPECT_EQ(apart.curves.curves().num_strokes, 8);
  EXPECT_EQ(*apart.mean_height_m(), *once.movement.mean_height_m);
}

}  // namespace presentation_meter_test
}  // namespace jnd::analysis
