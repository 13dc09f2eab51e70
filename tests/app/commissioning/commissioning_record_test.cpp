#include "app/commissioning/commissioning_record.h"

#include <gtest/gtest.h>

#include <algorithm>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "app/commissioning/guided_run.h"
#include "core/error.h"
#include "device/twin/twin_device.h"
#include "support/temporary_folder.h"

namespace jnd::app {
namespace commissioning_record_test {

namespace fs = std::filesystem;
using Step = CommissioningStep;
using test_support::TemporaryFolder;

const StepProgress kQuiet = [](double, const std::string&) {};

class CommissioningRecordTest : public ::testing::Test {
 protected:
  Commissioning begun() {
    return Commissioning(
        file_,
        {.name = "twin:seed=7", .identity = twin_.identity(), .can = twin_.capabilities()},
        {.loads_kg = {0.1, 0.3}, .operator_name = "A. Person"});
  }
  void measure(Commissioning& commissioning, Step step) {
    commissioning.measure(step, twin_, *twin_.bench(), kQuiet);
  }
  void add(const std::string& line) { std::ofstream(file_, std::ios::app) << line << "\n"; }
  [[nodiscard]] std::vector<std::string> lines() const {
    std::vector<std::string> all;
    std::ifstream in(file_);
    for (std::string line; std::getline(in, line);) all.push_back(line);
    return all;
  }

  TemporaryFolder folder_;
  fs::path file_ = folder_.path() / "twin.commissioning.jsonl";
  device::TwinDevice twin_{device::drawn_twin(7)};
};

TEST_F(CommissioningRecordTest, KeepsThePointsThatEachStepRestsOn) {
  Commissioning commissioning = begun();
  for (const Step step : kCommissioningSteps) measure(commissioning, step);
  const CommissioningResults& found = commissioning.results();
  const CommissioningRecord record = read_commissioning_record(file_);
  EXPECT_EQ(record.device, "twin:seed=7");
  EXPECT_EQ(record.identity.serial, "seed-7");
  EXPECT_TRUE(record.simulated);

  ASSERT_EQ(record.results.noise->first_readings_m.size(), 250U);
  EXPECT_EQ(record.results.noise->first_readings_m[17], found.noise->first_readings_m[17]);

  const analysis::FrameFit& frame = *record.results.frame;
  ASSERT_EQ(frame.marks.size(), 8U);
  double squares_m2 = 0.0;
  for (const analysis::TouchedMark& mark : frame.marks) {
    squares_m2 += analysis::missed_by_m(frame, mark).squaredNorm();
  }
  EXPECT_NEAR(std::sqrt(squares_m2 / (3.0 * 8.0 - 6.0)), frame.residual_m, 1e-12)
      << "the residual is that of the marks that are kept";

  const analysis::ForceFit& force = *record.results.force;
  ASSERT_EQ(static_cast<int>(force.ways.size()), force.num_ways);
  // Ways without loads determine damping, friction and the constant force, and loads determine
  // the gain. Both determine the constant force upwards. The fit takes that of the loads, which
  // differs by less than a thousandth of a newton.
  double squares_n2 = 0.0, num_unloaded = 0.0, furthest_n = 0.0;
  for (const analysis::GuidedWay& way : force.ways) {
    const double off_n =
        analysis::commanded_without_mass_n(force, way) - analysis::fitted_n(force, way);
    furthest_n = std::max(furthest_n, std::abs(off_n));
    if (way.load_n != 0.0) continue;
    squares_n2 += off_n * off_n;
    num_unloaded += 1.0;
  }
  EXPECT_NEAR(std::sqrt(squares_n2 / (num_unloaded - 5.0)), force.residual_n, 3e-4)
      << "what is left of the ways is what the fit left of them";
  EXPECT_LT(furthest_n, 5.0 * force.residual_n) << "loaded ones are no worse";

  ASSERT_EQ(static_cast<int>(record.results.delay->ways.size()),
            record.results.delay->num_ways);
  double mean_s = 0.0;
  for (const analysis::PushedWay& way : record.results.delay->ways) {
    mean_s += way.delay_s / record.results.delay->num_ways;
  }
  EXPECT_NEAR(mean_s, record.results.delay->delay_s.value, 1e-4);
}

TEST_F(CommissioningRecordTest, SaysUnderWhatEachStepWasMeasured) {
  Commissioning commissioning = begun();
  measure(commissioning, Step::kNoise);
  const CommissioningRecord record = read_commissioning_record(file_);
  const auto& conditions = record.results.conditions[static_cast<std::size_t>(Step::kNoise)];
  ASSERT_TRUE(conditions.has_value());
  EXPECT_EQ(conditions->operator_name, "A. Person");
  EXPECT_EQ(conditions->loads_kg, (std::vector<double>{0.1, 0.3}));
  EXPECT_EQ(conditions->max_total_force_n, kCommissioningLimits.total_n);
  EXPECT_EQ(record.entries.front().operator_name, "A. Person");
  EXPECT_FALSE(record.results.conditions[static_cast<std::size_t>(Step::kFrame)].has_value());
}

TEST_F(CommissioningRecordTest, TellsWhatBecameOfEveryMeasurement) {
  {
    Commissioning commissioning = begun();
    measure(commissioning, Step::kNoise);
    measure(commissioning, Step::kFrame);
    measure(commissioning, Step::kForce);
    measure(commissioning, Step::kFrame);
    commissioning.undo(Step::kNoise);
  }
  add(R"({"failed": "force", "at": "2026-11-25T10:00:00Z", "why": "it stopped"})");
  const CommissioningRecord record = read_commissioning_record(file_);
  std::vector<RecordedFate> fates;
  for (const RecordedEntry& entry : record.entries) fates.push_back(entry.fate);
  EXPECT_EQ(fates,
            (std::vector<RecordedFate>{RecordedFate::kUndone, RecordedFate::kSuperseded,
                                       RecordedFate::kRestsOnOld, RecordedFate::kCounts,
                                       RecordedFate::kTakesBack, RecordedFate::kFailed}));
  EXPECT_EQ(record.entries.back().why, "it stopped");
  EXPECT_FALSE(record.entries.front().found.empty()) << "what was taken back is still told";
  EXPECT_TRUE(record.results.has(Step::kFrame));
  EXPECT_FALSE(record.results.has(Step::kForce));
}

TEST_F(CommissioningRecordTest, AnOldRecordWithoutPointsIsRead) {
  {
    Commissioning commissioning = begun();
    measure(commissioning, Step::kHoming);
    measure(commissioning, Step::kNoise);
    measure(commissioning, Step::kFrame);
  }
  const std::vector<std::string> all = lines();
  fs::remove(file_);
  for (const std::string& line : all) {
    const std::size_t points = line.find(",\"points\"");
    const std::size_t conditions = line.find(",\"conditions\"");
    const std::size_t found = line.find(",\"found\"");
    add(points == std::string::npos
            ? line
            : line.substr(0, conditions) + line.substr(found, points - found) + "}");
  }
  const CommissioningRecord record = read_commissioning_record(file_);
  EXPECT_TRUE(record.results.has(Step::kFrame));
  EXPECT_TRUE(record.results.frame->marks.empty());
  EXPECT_FALSE(record.results.conditions[0].has_value());
  EXPECT_EQ(begun().next_step(), Step::kForce) << "and gone on with";
}

TEST_F(CommissioningRecordTest, AStepOfANewerProgramIsAnEntryAndNoResult) {
  {
    Commissioning commissioning = begun();
    measure(commissioning, Step::kNoise);
  }
  add(R"({"step": "weather", "at": "2026-11-25T10:00:00Z", "found": {"rain_m": 0.01}})");
  const CommissioningRecord record = read_commissioning_record(file_);
  ASSERT_EQ(record.entries.size(), 2U);
  EXPECT_EQ(record.entries[1].step, "weather");
  try {
    (void)begun();
    FAIL() << "whoever measures must know all of it";
  } catch (const core::Error& error) {
    EXPECT_NE(std::string(error.what()).find(":3: expected a step"), std::string::npos)
        << error.what();
  }
}

TEST_F(CommissioningRecordTest, NoRecordIsSaidToBeNone) {
  EXPECT_THROW((void)read_commissioning_record(folder_.path() / "none.jsonl"), core::Error);
  std::ofstream(file_).flush();
  EXPECT_THROW((void)read_commissioning_record(file_), core::Error);
}

}  // namespace commissioning_record_test
}  // namespace jnd::app
