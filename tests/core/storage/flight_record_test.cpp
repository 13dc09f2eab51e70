#include "core/storage/flight_record.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <sstream>

#include "core/error.h"
#include "core/sample_table.h"
#include "core/storage/backup.h"
#include "core/storage/kept_study.h"
#include "core/storage/withdrawal.h"

namespace jnd::core {
namespace flight_record_test {

namespace fs = std::filesystem;

std::vector<Sample> last_ticks(int num_samples, std::int64_t first_tick) {
  std::vector<Sample> samples(static_cast<std::size_t>(num_samples));
  for (std::size_t i = 0; i < samples.size(); ++i) {
    samples[i].tick = first_tick + static_cast<std::int64_t>(i);
    samples[i].tip_force_n[4] = {0.1 * static_cast<double>(i), -1.0 / 3.0, 0.0};
  }
  samples.back().fault = 8;
  return samples;
}

std::vector<std::string> lines_of(const fs::path& file) {
  std::ifstream stream(file);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::vector<std::string> cells_of(const std::string& line) {
  std::istringstream stream(line);
  std::vector<std::string> cells;
  for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
  return cells;
}

class FlightRecordTest : public ::testing::Test {
 protected:
  FlightRecordTest() { kept_.add_session("P01"); }
  [[nodiscard]] fs::path recording() const { return kept_.recording(1); }

  KeptStudy kept_;
};

TEST_F(FlightRecordTest, IsATableOfTheTicksUpToTheFaultBesideTheRecording) {
  const fs::path file = write_flight_record(recording(), last_ticks(3, 5000));
  EXPECT_EQ(file, recording().parent_path() / "0001.fault-000005002.csv");
  const std::vector<std::string> lines = lines_of(file);
  ASSERT_EQ(lines.size(), 4U);
  EXPECT_EQ(cells_of(lines[0]), sample_column_names({}));
  EXPECT_EQ(cells_of(lines[3]).front(), "5002");
  EXPECT_EQ(cells_of(lines[3]).back(), "8");
  const std::vector<std::string> names = sample_column_names({});
  const auto column = std::find(names.begin(), names.end(), "middle_force_y_n");
  ASSERT_NE(column, names.end());
  EXPECT_EQ(std::stod(cells_of(lines[1])[static_cast<std::size_t>(column - names.begin())]),
            -1.0 / 3.0);
}

TEST_F(FlightRecordTest, HoldsJointsWhereTheDeviceHasThem) {
  std::vector<Sample> samples = last_ticks(2, 0);
  samples[1].joint_torque_n_m[21] = 0.5F;
  const std::vector<std::string> lines = lines_of(write_flight_record(recording(), samples));
  EXPECT_EQ(cells_of(lines[0]), sample_column_names({.joints = true}));
  EXPECT_EQ(cells_of(lines[2]).size(), sample_column_names({.joints = true}).size());
}

TEST_F(FlightRecordTest, OneThatIsThereIsNotOverwritten) {
  const fs::path file = write_flight_record(recording(), last_ticks(3, 5000));
  std::ofstream(file, std::ios::app) << "a remark\n";
  EXPECT_EQ(write_flight_record(recording(), last_ticks(3, 5000)), file);
  EXPECT_EQ(lines_of(file).back(), "a remark");
}

TEST_F(FlightRecordTest, AFolderThatTakesNothingIsToldAndLeavesNoHalfFile) {
  const fs::path nowhere = kept_.folder() / "gone" / "0001.sqlite";
  EXPECT_THROW((void)write_flight_record(nowhere, last_ticks(3, 0)), Error);
  EXPECT_TRUE(flight_records(nowhere).empty());
}

TEST_F(FlightRecordTest, EachFaultOfASessionHasItsOwnInOrder) {
  kept_.add_session("P02");
  (void)write_flight_record(recording(), last_ticks(3, 5000));
  (void)write_flight_record(recording(), last_ticks(3, 200));
  (void)write_flight_record(kept_.recording(2), last_ticks(3, 100));
  const std::vector<fs::path> files = flight_records(recording());
  ASSERT_EQ(files.size(), 2U);
  EXPECT_EQ(files[0].filename(), "0001.fault-000000202.csv");
  EXPECT_EQ(files[1].filename(), "0001.fault-000005002.csv");
}

TEST_F(FlightRecordTest, ABackupHasItToo) {
  const fs::path file = write_flight_record(recording(), last_ticks(3, 5000));
  const fs::path copy = kept_.beside("copy");
  EXPECT_TRUE(back_up(kept_.folder(), copy, 1).integrity.complete);
  EXPECT_EQ(lines_of(copy / "recordings" / file.filename()), lines_of(file));
}

TEST_F(FlightRecordTest, GoesWithItsPerson) {
  kept_.add_session("P02");
  (void)write_flight_record(recording(), last_ticks(3, 5000));
  (void)write_flight_record(kept_.recording(2), last_ticks(3, 5000));
  (void)withdraw(kept_.folder(), "P01", 1);
  EXPECT_TRUE(flight_records(recording()).empty());
  EXPECT_EQ(flight_records(kept_.recording(2)).size(), 1U);
}

TEST_F(FlightRecordTest, OneThatAWithdrawalLeftBehindIsFound) {
  (void)withdraw(kept_.folder(), "P01", 1);
  (void)write_flight_record(recording(), last_ticks(3, 5000));
  EXPECT_FALSE(verify(StudyStore(kept_.folder(), StudyStore::Mode::kReadOnly)).complete);
}

}  // namespace flight_record_test
}  // namespace jnd::core
