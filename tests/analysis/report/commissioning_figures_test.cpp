#include "analysis/report/commissioning_figures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace jnd::analysis {
namespace commissioning_figures_test {

/// Returns the fit of a device with 2 N s/m and 0.5 N, whose force is 10 % too weak. Its y axis
/// points up.
ForceFit force_by_hand() {
  ForceFit fit{.gain = {0.9, 0.89, 0.91},
               .offset_n = {0.0, -1.0, 0.0},
               .damping_n_s_per_m = {2.0, 1.9, 2.1},
               .friction_n = {0.5, 0.4, 0.6},
               .num_ways = 3,
               .up = Eigen::Vector3d::UnitY(),
               .mass_per_gain_kg = 1.0};
  fit.ways = {{.direction = Eigen::Vector3d::UnitX(),
               .speed_m_per_s = 0.1,
               .acceleration_m_per_s2 = 0.2,
               .commanded_n = (0.5 + 2.0 * 0.1) / 0.9 + 0.2},
              {.direction = Eigen::Vector3d::UnitY(),
               .speed_m_per_s = 0.05,
               .commanded_n = (3.0 + 0.5 + 2.0 * 0.05 + 1.0 + 0.009) / 0.9,
               .load_n = 3.0},
              {.direction = -Eigen::Vector3d::UnitY(),
               .speed_m_per_s = 0.05,
               .commanded_n = (-3.0 + 0.5 + 2.0 * 0.05 - 1.0) / 0.9,
               .load_n = 3.0}};
  return fit;
}

const Figure* find(const std::vector<Figure>& figures, const std::string& name) {
  const auto found = std::ranges::find(figures, name, &Figure::name);
  return found == figures.end() ? nullptr : &*found;
}

double number(const Figure& figure, std::size_t row, const std::string& column) {
  const FigureTable& table = figure.tables.front();
  return table.rows.at(row).at(table.place_of(column)).number.value();
}

TEST(CommissioningFigures, ForceGivenIsOverWhatWasCommandedForTheLoadAlone) {
  const std::vector<Figure> figures = commissioning_figures({.force = force_by_hand()});
  const Figure* const force = find(figures, "device_force");
  ASSERT_NE(force, nullptr);
  ASSERT_EQ(force->tables.front().rows.size(), 2U) << "ways that go up or down";
  EXPECT_NEAR(number(*force, 0, "given_n"), 3.0, 1e-12);
  EXPECT_NEAR(number(*force, 0, "commanded_n"), 3.009 / 0.9, 1e-12);
  EXPECT_NEAR(number(*force, 0, "residual_n"), -0.009, 1e-12) << "9 mN more than for the load";
  EXPECT_NEAR(number(*force, 1, "given_n"), -3.0, 1e-12);
  EXPECT_NEAR(number(*force, 1, "commanded_n"), -3.0 / 0.9, 1e-12);
  EXPECT_NEAR(number(*force, 1, "residual_n"), 0.0, 1e-12);
}

TEST(CommissioningFigures, ResistanceIsWhatTheDeviceOpposesWithoutMassAndLoad) {
  const std::vector<Figure> figures = commissioning_figures({.force = force_by_hand()});
  const Figure* const resistance = find(figures, "device_resistance");
  ASSERT_NE(resistance, nullptr);
  ASSERT_EQ(resistance->tables.front().rows.size(), 1U) << "ways without a load";
  EXPECT_NEAR(number(*resistance, 0, "resistance_n"), 0.7, 1e-12);
  EXPECT_NEAR(number(*resistance, 0, "residual_n"), 0.0, 1e-12);
  EXPECT_EQ(number(*resistance, 0, "series"), 1.0);
  EXPECT_NE(resistance->caption.find("axis of the device"), std::string::npos);
}

TEST(CommissioningFigures, AxesAreThoseOfTheWorkspaceWhereTheFrameIsKnown) {
  FrameFit frame;
  // The device's x axis is the workspace's y axis.
  frame.rotation << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  const std::vector<Figure> figures =
      commissioning_figures({.frame = frame, .force = force_by_hand()});
  const Figure* const resistance = find(figures, "device_resistance");
  ASSERT_NE(resistance, nullptr);
  EXPECT_EQ(number(*resistance, 0, "series"), 2.0);
  EXPECT_EQ(find(figures, "device_marks"), nullptr) << "no marks are kept";
}

TEST(CommissioningFigures, MarksHaveWhatTheyWereMissedBy) {
  FrameFit frame{.offset_m = {0.01, 0.0, 0.0}, .residual_m = 0.001, .num_marks = 4};
  for (const double x : {-0.1, 0.1}) {
    for (const double z : {-0.1, 0.1}) {
      frame.marks.push_back({.device_m = {x - 0.01, 0.0, z + 0.002}, .workspace_m = {x, 0, z}});
    }
  }
  const std::vector<Figure> figures = commissioning_figures({.frame = frame});
  ASSERT_EQ(figures.size(), 1U);
  EXPECT_NEAR(number(figures[0], 0, "z_missed_mm"), 2.0, 1e-9);
  EXPECT_NEAR(number(figures[0], 0, "x_missed_mm"), 0.0, 1e-9);
  EXPECT_EQ(number(figures[0], 0, "is_upper"), 0.0);
  EXPECT_EQ(number(figures[0], 1, "is_upper"), 1.0);
  EXPECT_NEAR(number(figures[0], 0, "z_arrow_mm"), 40.0, 1e-9)
      << "20 times as long: a fifth of 200 mm";
  EXPECT_NE(figures[0].caption.find("20 times as long"), std::string::npos);
  EXPECT_NE(figures[0].caption.find("2.00 mm"), std::string::npos) << figures[0].caption;
}

TEST(CommissioningFigures, AreThereForWhatKeepsItsPointsAlone) {
  EXPECT_TRUE(commissioning_figures({}).empty());
  EXPECT_TRUE(commissioning_figures({.noise = NoiseFit{}, .delay = DelayFit{}}).empty());
  DelayFit delay{.delay_s = {0.002, 0.0019, 0.0021}, .mass_per_gain_kg = {1.0, 0.9, 1.1}};
  delay.ways = {{0.0018, 1.05}, {0.0022, 0.95}};
  NoiseFit noise{.position_sd_m = {1e-5, 9e-6, 1.1e-5}};
  noise.first_readings_m = {{1e-6, -2e-6, 3e-6}};
  const std::vector<Figure> figures = commissioning_figures({.noise = noise, .delay = delay});
  ASSERT_EQ(figures.size(), 2U);
  EXPECT_NEAR(number(*find(figures, "device_delay"), 1, "delay_ms"), 2.2, 1e-12);
  EXPECT_NEAR(number(*find(figures, "device_noise"), 0, "y_um"), -2.0, 1e-12);
}

}  // namespace commissioning_figures_test
}  // namespace jnd::analysis
