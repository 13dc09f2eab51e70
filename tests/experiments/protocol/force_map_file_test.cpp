#include "experiments/protocol/force_map_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>

#include "core/error.h"
#include "core/media/water_drag.h"
#include "support/places.h"

namespace jnd::experiments {
namespace force_map_file_test {

const std::string kHeader =
    "angle_of_attack_rad,speed_m_per_s,drag_coefficient,lift_coefficient\n";

std::string reason(const std::string& text) {
  try {
    const core::ForceMap map = parse_force_map(text, "map.csv");
  } catch (const core::Error& error) {
    return error.what();
  }
  return "";
}

TEST(ForceMapFile, ReadsRowsCommentsAndLinesFromWindows) {
  const core::ForceMap map = parse_force_map(
      "# measured in a towing tank\r\n" + kHeader + "0,1,0.2,0\r\n\n1.5707,1,0.9,0\n",
      "map.csv");
  EXPECT_EQ(map.at(0.0, 1.0).drag, 0.2);
  EXPECT_EQ(map.at(2.0, 3.0).drag, 0.9);
}

TEST(ForceMapFile, TheShippedFitIsTheThesiss) {
  const core::ForceMap map =
      read_force_map(test_support::source_folder() / "data/force_maps/thesis_fit.csv");
  EXPECT_FALSE(map.has_lift());
  for (int i = 0; i <= 18; ++i) {
    const double angle = std::numbers::pi / 36.0 * i;
    EXPECT_NEAR(map.at(angle, 0.4).drag, core::WaterDrag::drag_coefficient(std::sin(angle)),
                1e-9);
  }
}

TEST(ForceMapFile, TheShippedPlateIsKirchhoffsAndRayleighs) {
  const core::ForceMap map =
      read_force_map(test_support::source_folder() / "data/force_maps/flat_plate.csv");
  EXPECT_TRUE(map.has_lift());
  // Lamb, Hydrodynamics, art. 77: head on it is 2 pi / (4 + pi) = 0.880.
  EXPECT_NEAR(map.at(std::numbers::pi / 2.0, 1.0).drag, 0.880, 5e-4);
  const double angle = 0.5;
  const double normal =
      2.0 * std::numbers::pi * std::sin(angle) / (4.0 + std::numbers::pi * std::sin(angle));
  EXPECT_NEAR(map.at(angle, 1.0).drag, normal * std::sin(angle), 2e-3);
  EXPECT_NEAR(map.at(angle, 1.0).lift, normal * std::cos(angle), 2e-3);
}

TEST(ForceMapFile, SaysInWhichLineWhatIsWrong) {
  EXPECT_EQ(reason(kHeader + "0,1,0.2,0\n1,1,abc,0\n"),
            "map.csv: line 3: drag_coefficient: expected a number, found `abc`");
  EXPECT_EQ(reason(kHeader + "0,1,0.2\n"),
            "map.csv: line 2: expected four numbers, one for each column, found 3");
  EXPECT_EQ(reason(kHeader + "0,1,0.2,0,\n"),
            "map.csv: line 2: expected four numbers, one for each column, found 5");
  EXPECT_EQ(reason("# degrees\nangle_deg,speed\n").substr(0, 40),
            "map.csv: line 2: expected the words angl");
  EXPECT_EQ(
      reason(kHeader + "0,1,0.2,0\n45,1,0.3,0\n"),
      "map.csv: line 3: angle_of_attack_rad: expected a number >= 0 and <= pi/2, found 45");
  EXPECT_EQ(reason(kHeader + "0,1,nan,0\n1,1,0.3,0\n"),
            "map.csv: line 2: drag_coefficient: expected a number >= 0 and <= 100, found nan");
}

TEST(ForceMapFile, AnEmptyOrEndlessFileIsRefused) {
  EXPECT_NE(reason(""), "");
  EXPECT_NE(reason("# nothing\n"), "");
  EXPECT_NE(reason(kHeader), "");
  std::string endless = kHeader;
  for (int i = 0; i < 20'001; ++i) endless += "0," + std::to_string(i) + ",0.2,0\n";
  EXPECT_NE(reason(endless).find("at most 20000 rows"), std::string::npos);
}

TEST(ForceMapFile, AFileThatIsNotThereIsSaidToBeNone) {
  try {
    static_cast<void>(read_force_map("no_such_map.csv"));
    FAIL();
  } catch (const core::Error& error) {
    EXPECT_EQ(std::string(error.what()),
              "no_such_map.csv: expected a force map that can be read, found none; check its "
              "name");
  }
  EXPECT_THROW(static_cast<void>(read_force_map(test_support::source_folder())), core::Error);
}

}  // namespace force_map_file_test
}  // namespace jnd::experiments
