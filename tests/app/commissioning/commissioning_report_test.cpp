#include "app/commissioning/commissioning_report.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "analysis/report/html_text.h"
#include "app/commissioning/commissioned_profile.h"
#include "app/commissioning/measured_quantities.h"
#include "app/commissioning/measured_twin.h"
#include "core/error.h"
#include "core/storage/sha256.h"
#include "device/twin/twin_device.h"
#include "experiments/device_profile/profile_writer.h"
#include "support/files.h"
#include "support/temporary_folder.h"

namespace jnd::app {
namespace commissioning_report_test {

namespace fs = std::filesystem;
using Step = CommissioningStep;
using test_support::read_file;
using test_support::TemporaryFolder;

const StepProgress kQuiet = [](double, const std::string&) {};

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

std::string without_breaks(std::string html) {
  const std::string mark = "<wbr>";
  for (std::size_t at = html.find(mark); at != std::string::npos; at = html.find(mark, at)) {
    html.erase(at, mark.size());
  }
  return html;
}

class CommissioningReportTest : public ::testing::Test {
 protected:
  /// Goes on with a record of all steps and makes a profile.
  void commission() {
    test_support::write_file(record_, record_of_all_steps());
    const Commissioning commissioning = begun();
    profile_file_ = experiments::write_device_profile(
        profile_of(commissioning, twin_.identity(), "0.1.0"), folder_.path());
  }
  Commissioning begun() { return begun_with_twin(record_, twin_); }
  void measure(Commissioning& commissioning, Step step) {
    commissioning.measure(step, twin_, *twin_.bench(), kQuiet);
  }
  std::string report(std::optional<KnownProfile> profile = std::nullopt) {
    const fs::path out = folder_.path() / ("out" + std::to_string(++num_reports_));
    const analysis::ReportOutcome outcome =
        write_commissioning_report({.record = record_,
                                    .profile = std::move(profile),
                                    .program_version = "1.2.3",
                                    .written_on = "2026-12-01",
                                    .out = out});
    num_figures_ = outcome.figures.size();
    return without_breaks(read_file(outcome.html));
  }
  [[nodiscard]] CommissioningVerdict verdict(const std::string& on_day,
                                             const std::optional<KnownProfile>& profile) const {
    return verdict_of(read_commissioning_record(record_), profile, on_day);
  }

  TemporaryFolder folder_;
  fs::path record_ = folder_.path() / "twin.commissioning.jsonl";
  fs::path profile_file_;
  device::TwinDevice twin_{device::drawn_twin(7)};
  int num_reports_ = 0;
  std::size_t num_figures_ = 0;
};

TEST_F(CommissioningReportTest, HasEveryQuantityAndWhatItRestsOn) {
  commission();
  const std::string html = report(read_known_profile(profile_file_));
  const CommissioningRecord record = read_commissioning_record(record_);
  for (const Step step : kCommissioningSteps) {
    const std::vector<MeasuredQuantity> quantities = quantities_in(step, record.results);
    EXPECT_FALSE(quantities.empty()) << words_of(step).name;
    for (const MeasuredQuantity& one : quantities) {
      EXPECT_TRUE(has(html, "<td>" + analysis::html_escaped(one.what) + "</td>")) << one.what;
      EXPECT_TRUE(has(html, one.estimate)) << one.what;
      EXPECT_TRUE(has(html, one.interval)) << one.what;
    }
  }
  EXPECT_EQ(num_figures_, 5U);
  EXPECT_TRUE(has(html, core::sha256(read_file(record_)))) << "the record as it is";
  EXPECT_TRUE(has(html, core::sha256(read_file(profile_file_))));
  EXPECT_TRUE(has(html, "SIMULATED device: nothing here was measured on hardware"));
  EXPECT_TRUE(has(html, "A. Person"));
  EXPECT_TRUE(has(html, "seed-7"));
  EXPECT_TRUE(has(html, "Report of 2026-12-01, by jnd 1.2.3."));
  EXPECT_TRUE(has(html, "100, 200, 400 g"));
  EXPECT_TRUE(has(html, "at most 10 N at a point and 15 N in all"));
  EXPECT_TRUE(has(html, "g u = L (n · e + a / 9.80665 m/s²) + m a + b v + F p − c · e"));
  EXPECT_TRUE(has(html, "Kabsch, W. (1976)"));
  EXPECT_TRUE(has(html, "class=\"signatures\""));
  EXPECT_TRUE(has(html, "Table 2.")) << "tables are numbered through";
  EXPECT_FALSE(has(html, "NOT FIT"));
}

TEST_F(CommissioningReportTest, TheVerdictSaysWhatIsMissing) {
  commission();
  KnownProfile profile = read_known_profile(profile_file_);
  const std::string on_day = profile.profile.measured_on;
  EXPECT_TRUE(verdict(on_day, profile).is_fit);
  EXPECT_TRUE(has(verdict(on_day, profile).words, profile.profile.valid_until));
  EXPECT_TRUE(verdict(profile.profile.valid_until, profile).is_fit) << "its last day";
  EXPECT_FALSE(verdict("2100-01-01", profile).is_fit);
  EXPECT_TRUE(has(verdict("2100-01-01", profile).words, "ended"));
  EXPECT_FALSE(verdict(on_day, std::nullopt).is_fit);

  KnownProfile failed = profile;
  failed.profile.checks = {{.checked_on = on_day, .passed = false}};
  EXPECT_FALSE(verdict(on_day, failed).is_fit);
  EXPECT_TRUE(has(verdict(on_day, failed).words, "daily check failed"));

  KnownProfile older = profile;
  older.profile.measured_on = "2020-01-01";
  EXPECT_FALSE(verdict(on_day, older).is_fit) << "of other measurements";
  // Measured again on the same day.
  for (const Step step : kCommissioningSteps) {
    KnownProfile other = profile;
    if (step == Step::kNoise) *other.profile.noise.position_sd_m *= 1.01;
    if (step == Step::kFrame) other.profile.frame.offset_m[1] += 1e-6;
    if (step == Step::kForce) other.profile.force.gain->value += 1e-6;
    if (step == Step::kDelay) other.profile.delay_s->value += 1e-9;
    if (other.profile == profile.profile) continue;
    EXPECT_FALSE(verdict(on_day, other).is_fit) << words_of(step).name;
    EXPECT_TRUE(has(verdict(on_day, other).words, "not of these measurements"));
  }

  {
    Commissioning commissioning = begun();
    commissioning.undo(Step::kForce);
  }
  const CommissioningVerdict undone = verdict(on_day, profile);
  EXPECT_FALSE(undone.is_fit);
  EXPECT_EQ(undone.lacks.front(), "Not measured: force, delay, stability.");
  EXPECT_TRUE(has(report(profile), "NOT FIT FOR SESSIONS: not every step is measured."));
}

TEST_F(CommissioningReportTest, TellsOfAttemptsThatFailedAfterWhatCounts) {
  commission();
  std::ofstream(record_, std::ios::app)
      << R"({"failed": "force", "at": "2026-12-01T10:00:00Z", "why": "the cable came off"})"
      << "\n";
  const KnownProfile profile = read_known_profile(profile_file_);
  const std::string html = report(profile);
  EXPECT_TRUE(
      has(html, "The last attempt at the step force, on 2026-12-01, failed: the cable"));
  EXPECT_TRUE(has(html, "<td>failed</td>"));
}

TEST_F(CommissioningReportTest, OfARecordThatIsNotCompleteItIsWrittenAsWell) {
  {
    Commissioning commissioning = begun();
    measure(commissioning, Step::kFrame);
    measure(commissioning, Step::kFrame);
  }
  const std::string html = report();
  EXPECT_TRUE(has(html, "Not measured: homing, noise, force, delay, stability."));
  EXPECT_TRUE(has(html, "measured anew later"));
  EXPECT_FALSE(has(html, "Own damping"));
  EXPECT_FALSE(has(html, "Jury"));
  EXPECT_EQ(num_figures_, 1U);
}

TEST_F(CommissioningReportTest, FindsTheProfileOfItsDeviceAlone) {
  commission();
  const std::string on_day = "2026-12-01";
  const auto found = profile_of_record(record_, "", on_day);
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->profile.device.serial, "seed-7");

  device::TwinDevice other(device::drawn_twin(8));
  const fs::path elsewhere = folder_.path() / "elsewhere";
  fs::create_directory(elsewhere);
  const fs::path record = elsewhere / "other.jsonl";
  (void)Commissioning(
      record,
      {.name = "twin:seed=8", .identity = other.identity(), .can = other.capabilities()}, {});
  EXPECT_FALSE(profile_of_record(record, "", on_day).has_value());
  EXPECT_THROW((void)profile_of_record(record, profile_file_.string(), on_day), core::Error);
}

TEST_F(CommissioningReportTest, NothingIsOverwritten) {
  commission();
  EXPECT_EQ(report_folder_beside(profile_file_).filename(), "twin_seed_7.report");
  fs::create_directory(report_folder_beside(profile_file_));
  EXPECT_EQ(report_folder_beside(profile_file_).filename(), "twin_seed_7-2.report");
  EXPECT_THROW((void)write_commissioning_report({.record = record_, .out = folder_.path()}),
               core::Error);
}

TEST(MeasuredQuantities, SayInPlainWordsWhatArrivesOfAForce) {
  CommissioningResults results;
  results.measured_at[static_cast<std::size_t>(Step::kForce)] = "2026-11-25T10:00:00Z";
  results.force = analysis::ForceFit{.gain = {0.9, 0.895, 0.905},
                                     .weight_n = {-0.5, -0.6, -0.4},
                                     .damping_n_s_per_m = {2.0, 1.9, 2.1},
                                     .friction_n = {0.5, 0.4, 0.6}};
  std::vector<std::string> found = main_findings(results);
  EXPECT_TRUE(has(found.at(0), "0.9000 (0.8950 to 0.9050) N act: its force is 10.0 % too weak"))
      << found.at(0);
  EXPECT_TRUE(has(found.at(1), "2.00 (1.90 to 2.10) N s/m of damping")) << found.at(1);
  EXPECT_TRUE(has(found.at(2), "lift the hand by 0.50 (0.40 to 0.60) N")) << found.at(2);
  results.force->gain = {0.99, 0.97, 1.01};
  EXPECT_TRUE(has(main_findings(results).at(0), "which holds a true force"));
}

}  // namespace commissioning_report_test
}  // namespace jnd::app
