#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>

#include "analysis/export/bids_export.h"
#include "analysis/export/csv_export.h"
#include "analysis/export/hdf5_export.h"
#include "analysis/hand_made_study.h"
#include "core/error.h"
#include "core/storage/database.h"
#include "core/storage/recording.h"
#include "support/files.h"

namespace jnd::analysis {
namespace lossy_recording_test {

namespace fs = std::filesystem;
using test_support::read_file;

/// Exports a recorded session in every format. Its events refer to the ticks 0 to 8999.
class LossyRecordingTest : public ::testing::TestWithParam<const char*> {
 protected:
  LossyRecordingTest() {
    study_.add("P01", /*pilot=*/false, "", "", /*recorded=*/true);
    study_.explore(0, "viscous", 2.0, 0, 4999);
    study_.explore(0, "viscous", 4.0, 5000, 8999);
    (void)study_.answer({.block = "b", .response = 1.0, .first_tick = 0, .last_tick = 10});
  }

  void record(std::int64_t first_tick, std::int64_t last_tick) const {
    core::RecordingWriter writer(recording(), 1000.0, core::Durability::kAtClose);
    for (std::int64_t tick = first_tick; tick <= last_tick; ++tick) {
      core::Sample sample{.tick = tick};
      sample.tip_position_m[0][0] = 1e-4 * static_cast<double>(tick);
      writer.append(sample);
    }
  }
  [[nodiscard]] fs::path recording() const { return study_.store().recording_file(1); }
  [[nodiscard]] fs::path out() const { return temporary_.path() / "out"; }
  ExportOutcome write(std::function<void()> keep_going = {}) const {
    const ExportOptions options{.recordings = true, .keep_going = std::move(keep_going)};
    if (GetParam() == std::string("csv")) return export_csv(study_.store(), out(), options);
    if (GetParam() == std::string("hdf5")) return export_hdf5(study_.store(), out(), options);
    return export_bids(study_.store(), out(), options, "");
  }
  /// Returns the message with which the export is refused, and expects that nothing is left of
  /// it.
  [[nodiscard]] std::string refusal() const {
    std::string sentence;
    try {
      (void)write();
    } catch (const core::Error& error) {
      sentence = error.what();
    }
    EXPECT_TRUE(fs::is_empty(temporary_.path()));
    return sentence;
  }
  /// Returns the part of the data set that tells of the loss.
  [[nodiscard]] std::string told() const {
    if (GetParam() == std::string("csv")) return read_file(out() / "recordings/gaps.csv");
    return read_file(out() / (GetParam() == std::string("bids") ? "README.md" : "study.h5"));
  }

  HandMadeStudy study_;
  test_support::TemporaryFolder temporary_{test_support::memory_folder()};
};
INSTANTIATE_TEST_SUITE_P(EveryFormat, LossyRecordingTest,
                         ::testing::Values("csv", "bids", "hdf5"));

TEST_P(LossyRecordingTest, OneThatHoldsEverythingIsNoProblem) {
  record(0, 8999);
  const ExportOutcome outcome = write();
  EXPECT_TRUE(outcome.problems.empty());
  EXPECT_TRUE(outcome.samples);
}

/// The damaged bytes can be decoded. Only their hash shows that they were changed.
TEST_P(LossyRecordingTest, ADamagedChunkIsRefusedAndNothingIsLeft) {
  record(0, 8999);
  {
    core::Database database(recording(), core::Database::Mode::kReadWrite,
                            core::Durability::kAtClose);
    database.execute(
        "UPDATE chunk SET data = (SELECT data FROM chunk WHERE first_tick = 0) "
        "WHERE first_tick = 4096");
  }
  const std::string sentence = refusal();
  EXPECT_NE(sentence.find("chunk at tick 4096"), std::string::npos) << sentence;
  EXPECT_TRUE(sentence.ends_with("; nothing was written")) << sentence;
}

TEST_P(LossyRecordingTest, DamageBetweenTasksIsRefusedToo) {
  record(0, 20000);
  {
    core::Database database(recording(), core::Database::Mode::kReadWrite,
                            core::Durability::kAtClose);
    database.execute(
        "UPDATE chunk SET data = (SELECT data FROM chunk WHERE first_tick = 0) "
        "WHERE first_tick = 12288");
  }
  EXPECT_NE(refusal().find("chunk at tick 12288"), std::string::npos);
}

TEST_P(LossyRecordingTest, AMissingFileIsAProblemAndTold) {
  const ExportOutcome outcome = write();
  ASSERT_EQ(outcome.problems.size(), 1U);
  EXPECT_NE(outcome.problems[0].find("0001.sqlite"), std::string::npos);
  EXPECT_NE(outcome.problems[0].find("9000 ticks"), std::string::npos) << outcome.problems[0];
  EXPECT_NE(outcome.problems[0].find("no such file"), std::string::npos);
  EXPECT_FALSE(outcome.samples);
  const bool csv = GetParam() == std::string("csv");
  EXPECT_NE(told().find(csv ? "\n1,P01,0,0,8999,0\n" : "no such file"), std::string::npos);
}

TEST_P(LossyRecordingTest, AnEmptyFileIsAProblem) {
  std::ofstream(recording()).close();
  const ExportOutcome outcome = write();
  ASSERT_EQ(outcome.problems.size(), 1U);
  EXPECT_NE(outcome.problems[0].find("all of them missing"), std::string::npos);
}

TEST_P(LossyRecordingTest, TicksThatLackAtStartAndEndAreTold) {
  record(100, 5999);
  const ExportOutcome outcome = write();
  ASSERT_EQ(outcome.problems.size(), 1U);
  EXPECT_NE(outcome.problems[0].find("3100 of them missing"), std::string::npos)
      << outcome.problems[0];
  EXPECT_TRUE(outcome.samples);
  const bool csv = GetParam() == std::string("csv");
  EXPECT_NE(told().find(csv ? "\n1,P01,0,0,99,0\n1,P01,0,6000,8999,0\n" : "3100 of them"),
            std::string::npos);
}

/// The export stops as by a signal.
TEST_P(LossyRecordingTest, WhoeverStopsItLeavesNothing) {
  record(0, 8999);
  int num_calls = 0;
  const auto stop_late = [&num_calls] {
    if (++num_calls == 3) throw core::Error("out: stopped");
  };
  EXPECT_THROW((void)write(stop_late), core::Error);
  EXPECT_EQ(num_calls, 3);
  EXPECT_TRUE(fs::is_empty(temporary_.path()));
}

}  // namespace lossy_recording_test
}  // namespace jnd::analysis
