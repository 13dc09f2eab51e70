#include "app/commissioning/commissioning.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "app/commissioning/measured_twin.h"
#include "core/error.h"
#include "device/twin/twin_device.h"
#include "support/temporary_folder.h"

namespace jnd::app {
namespace commissioning_test {

namespace fs = std::filesystem;
using Step = CommissioningStep;
using test_support::TemporaryFolder;

const StepProgress kQuiet = [](double, const std::string&) {};

class CommissioningTest : public ::testing::Test {
 protected:
  Commissioning begun(int seed = 7) {
    twin_.emplace(device::drawn_twin(static_cast<std::uint64_t>(seed)));
    return Commissioning(
        record_,
        {.name = "twin:seed=7", .identity = twin_->identity(), .can = twin_->capabilities()},
        {});
  }
  void measure(Commissioning& commissioning, Step step) {
    commissioning.measure(step, *twin_, *twin_->bench(), kQuiet);
  }
  [[nodiscard]] std::string text() const {
    std::ifstream in(record_);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  TemporaryFolder folder_;
  fs::path record_ = folder_.path() / "twin.commissioning.jsonl";
  std::optional<device::TwinDevice> twin_;
};

TEST_F(CommissioningTest, GoesOnWhereItWasInterrupted) {
  double gain = 0.0;
  {
    Commissioning first = begun();
    EXPECT_EQ(first.next_step(), Step::kHoming);
    for (const Step step : {Step::kHoming, Step::kNoise, Step::kFrame, Step::kForce}) {
      measure(first, step);
    }
    gain = first.results().force->gain.value;
  }
  Commissioning second = begun();
  EXPECT_EQ(second.next_step(), Step::kDelay);
  EXPECT_EQ(second.results().force->gain.value, gain) << "to the last digit";
  measure(second, Step::kDelay);
  EXPECT_EQ(second.next_step(), Step::kStability);
  EXPECT_FALSE(second.results().has(Step::kStability));
}

TEST_F(CommissioningTest, ALineThatTheProgramDiedInIsNoMeasurementAndDoesNoHarm) {
  {
    Commissioning first = begun();
    for (const Step step : {Step::kHoming, Step::kNoise, Step::kFrame}) measure(first, step);
  }
  const std::string whole = text();
  std::ofstream(record_, std::ios::trunc) << whole.substr(0, whole.size() - 40);
  {
    Commissioning second = begun();
    EXPECT_EQ(second.next_step(), Step::kFrame);
    measure(second, Step::kFrame);
  }
  EXPECT_EQ(begun().next_step(), Step::kForce);
  EXPECT_EQ(text().substr(0, whole.size() - 40), whole.substr(0, whole.size() - 40))
      << "nothing is overwritten";
}

TEST_F(CommissioningTest, WhatRestsOnAStepThatIsTakenBackIsMeasuredAnew) {
  test_support::write_file(record_, record_of_all_steps());
  Commissioning commissioning = begun();
  commissioning.undo(Step::kFrame);
  EXPECT_TRUE(commissioning.results().has(Step::kNoise));
  EXPECT_FALSE(commissioning.results().has(Step::kFrame));
  EXPECT_FALSE(commissioning.results().has(Step::kForce));
  EXPECT_FALSE(commissioning.results().has(Step::kDelay));
  EXPECT_EQ(begun().next_step(), Step::kFrame) << "also after a restart";
  EXPECT_NE(text().find("\"gain\""), std::string::npos) << "the old measurement is still there";
}

TEST_F(CommissioningTest, StepsThatUseOthersWaitForThem) {
  Commissioning commissioning = begun();
  EXPECT_THROW(measure(commissioning, Step::kForce), core::Error);
  EXPECT_THROW(measure(commissioning, Step::kDelay), core::Error);
}

TEST_F(CommissioningTest, TheRecordOfAnotherDeviceIsRefused) {
  { (void)begun(7); }
  try {
    (void)begun(8);
    FAIL();
  } catch (const core::Error& error) {
    EXPECT_NE(std::string(error.what()).find("seed-8"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("seed-7"), std::string::npos) << error.what();
  }
}

TEST_F(CommissioningTest, ADamagedRecordIsToldByItsLine) {
  { (void)begun(); }
  std::ofstream(record_, std::ios::app) << "{\"step\": \"noise\", \"found\": {}}\n";
  try {
    (void)begun();
    FAIL();
  } catch (const core::Error& error) {
    EXPECT_NE(std::string(error.what()).find(":2:"), std::string::npos) << error.what();
  }
}

TEST_F(CommissioningTest, EveryStepTellsWhatItFound) {
  Commissioning commissioning = begun();
  for (const Step step : kCommissioningSteps) {
    EXPECT_TRUE(found_in(step, commissioning.results()).empty());
    measure(commissioning, step);
    EXPECT_GE(found_in(step, commissioning.results()).size(), 2U);
    EXPECT_EQ(step_named(words_of(step).name), step);
  }
  EXPECT_FALSE(step_named("weather").has_value());
}

}  // namespace commissioning_test
}  // namespace jnd::app
