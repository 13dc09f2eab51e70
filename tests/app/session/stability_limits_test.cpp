#include "app/session/stability_limits.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "app/operator/preflight.h"
#include "app/tiny_study.h"
#include "core/error.h"
#include "experiments/protocol/study_reader.h"
#include "support/temporary_folder.h"

namespace jnd::app {
namespace stability_limits_test {

using device::Contact;
using device::StabilityLimit;

StabilityRow row(double rate_hz, double delay_s, Contact contact, double viscosity_pa_s,
                 double stiffness_n_per_m, bool is_at_least = false) {
  return {.measured_case = {rate_hz, delay_s, contact},
          .limits = {.viscosity_pa_s = {viscosity_pa_s, is_at_least},
                     .stiffness_n_per_m = {stiffness_n_per_m, false}}};
}

/// Returns a map that also has delayed rows, which must not be used.
StabilityMap small_map() {
  return {.device = "exoskeleton",
          .rows = {row(833, 0.001, Contact::kAttached, 1, 1),
                   row(833, 0.001, Contact::kDetached, 1, 1),
                   row(1000, 0.001, Contact::kAttached, 1, 1),
                   row(1000, 0.001, Contact::kDetached, 1, 1),
                   row(833, 0.0, Contact::kAttached, 30, 900),
                   row(833, 0.0, Contact::kDetached, 10, 500),
                   row(1000, 0.0, Contact::kAttached, 40, 2000),
                   row(1000, 0.0, Contact::kSlipping, 35, 2000),
                   row(1000, 0.0, Contact::kDetached, 12, 600)}};
}

experiments::Study study_at(double rate_hz) {
  experiments::Study study = experiments::read_study_text(kTinyStudy, "tiny.json");
  study.device.rate_hz = rate_hz;
  return study;
}

experiments::RangeEntry viscous(double viscosity_pa_s) {
  return {.stage = "a",
          .setting = {.medium = "viscous",
                      .quantity = "viscosity_pa_s",
                      .intensity = viscosity_pa_s},
          .total_force_n = 1.0,
          .fits = true};
}

StabilityCheck checked(const experiments::Study& study,
                       const std::vector<experiments::RangeEntry>& range,
                       double speed_m_per_s = 0.5) {
  return check_stability(small_map(), study, range, speed_m_per_s).value();
}

TEST(StabilityLimits, AMapThatWasWrittenIsReadAsItWas) {
  const test_support::TemporaryFolder temporary;
  StabilityMap map = small_map();
  map.rows.push_back(row(2000, 0.003, Contact::kSlipping, 512, 0, true));
  const auto file = write_file(temporary.path() / "map.json", to_json(map).dump());
  const StabilityMap again = read_stability_map(file);
  EXPECT_EQ(again.device, map.device);
  EXPECT_EQ(to_json(again), to_json(map));
  EXPECT_TRUE(again.rows.back().limits.viscosity_pa_s.is_beyond_ladder);
  EXPECT_EQ(again.rows.back().measured_case.contact, Contact::kSlipping);
}

TEST(StabilityLimits, LimitsAreWrittenWithThreeDigitsAndNeverMoreThanWasFound) {
  const StabilityMap map = {.rows = {row(1000, 0.0, Contact::kAttached, 31.3999, 46950.6),
                                     row(1000, 0.0, Contact::kDetached, 117.0, 0.0)}};
  const auto limits = to_json(map)["limits"];
  EXPECT_EQ(limits[0]["viscosity_pa_s"], 31.3);
  EXPECT_EQ(limits[0]["stiffness_n_per_m"], 46900.0);
  EXPECT_EQ(limits[1]["viscosity_pa_s"], 117.0);
  EXPECT_EQ(limits[1]["stiffness_n_per_m"], 0.0);
}

TEST(StabilityLimits, ABrokenMapIsToldWithItsPlace) {
  const test_support::TemporaryFolder temporary;
  const std::string good = to_json(small_map()).dump();
  for (const std::string& text :
       {std::string("{"), std::string("{}"), std::string("[1]"),
        replaced(good, "\"attached\"", "\"glued\""),
        replaced(good, "\"rate_hz\":833.0", "\"rate_hz\":-1"),
        replaced(good, "\"viscosity_pa_s\":30.0", "\"viscosity_pa_s\":\"30\"")}) {
    const auto file = write_file(temporary.path() / "map.json", text);
    try {
      (void)read_stability_map(file);
      ADD_FAILURE() << text;
    } catch (const core::Error& error) {
      EXPECT_TRUE(std::string(error.what()).starts_with(file.string())) << error.what();
    }
  }
  EXPECT_THROW((void)read_stability_map(temporary.path() / "none.json"), core::Error);
}

TEST(StabilityLimits, TheShippedMapHoldsEveryCaseAndALooseFingerIsTheWorst) {
  const std::optional<StabilityMap> map = shipped_stability_map("exoskeleton");
  ASSERT_TRUE(map);
  std::set<std::tuple<double, double, Contact>> cases;
  for (const StabilityRow& its : map->rows) {
    cases.insert({its.measured_case.rate_hz, its.measured_case.extra_delay_s,
                  its.measured_case.contact});
    EXPECT_GT(its.limits.viscosity_pa_s.value, 0.0);
    EXPECT_GT(its.limits.stiffness_n_per_m.value, 0.0);
  }
  EXPECT_EQ(cases.size(), 36U) << "three rates, four delays, three contacts";
  for (const double rate_hz : {833.0, 1000.0, 2000.0}) {
    experiments::Study study = study_at(rate_hz);
    const auto check = check_stability(*map, study, {}, 0.5);
    ASSERT_TRUE(check);
    EXPECT_EQ(check->rate_hz, rate_hz);
    EXPECT_LT(2.0 * check->detached.viscosity_pa_s.value, check->attached.viscosity_pa_s.value);
  }
}

TEST(StabilityLimits, TheShippedMapIsStillThatOfThisProgram) {
  // If this test fails, `jnd stability --out data/stability/exoskeleton.json` makes the map
  // anew.
  const std::optional<StabilityMap> map = shipped_stability_map("exoskeleton");
  ASSERT_TRUE(map);
  int num_rows = 0;
  for (const StabilityRow& its : map->rows) {
    if (its.measured_case.contact != Contact::kDetached) continue;
    if (its.measured_case.rate_hz != 1000.0) continue;
    ++num_rows;
    const double limit_pa_s = its.limits.viscosity_pa_s.value;
    const auto is_stable = [&](double viscosity_pa_s) {
      return device::is_stable_in(its.measured_case,
                                  core::viscous({.viscosity_pa_s = viscosity_pa_s}));
    };
    EXPECT_TRUE(is_stable(0.8 * limit_pa_s)) << its.measured_case.extra_delay_s;
    EXPECT_FALSE(is_stable(1.25 * limit_pa_s)) << its.measured_case.extra_delay_s;
  }
  EXPECT_EQ(num_rows, 4);
}

TEST(StabilityLimits, ADeviceWithoutAMapHasNone) {
  EXPECT_FALSE(shipped_stability_map("lumped"));
  EXPECT_FALSE(shipped_stability_map("network:127.0.0.1:4700"));
  EXPECT_FALSE(shipped_stability_map("../stability/exoskeleton"));
}

TEST(StabilityLimits, AStudyIsComparedAtTheHighestRateThatItReaches) {
  EXPECT_EQ(checked(study_at(1000.0), {}).rate_hz, 1000.0);
  EXPECT_EQ(checked(study_at(1500.0), {}).rate_hz, 1000.0);
  EXPECT_EQ(checked(study_at(999.0), {}).rate_hz, 833.0);
  EXPECT_EQ(checked(study_at(833.0), {}).rate_hz, 833.0);
  EXPECT_EQ(checked(study_at(500.0), {}).rate_hz, 833.0) << "the lowest there is";
  EXPECT_FALSE(check_stability({.device = "x"}, study_at(1000.0), {}, 0.5));
}

TEST(StabilityLimits, ViscositiesAreWithinReachOfTheHandOrOfAFingerOrOfNeither) {
  const StabilityCheck check =
      checked(study_at(1000.0), {viscous(12.0), viscous(12.1), viscous(40.0), viscous(40.1)});
  EXPECT_EQ(check.is_stable, (std::vector<bool>{true, true, true, false}));
  EXPECT_EQ(check.needs_the_hand, (std::vector<bool>{false, true, true, false}));
  EXPECT_EQ(check.num_unstable(), 1);
  EXPECT_EQ(check.num_needing_the_hand(), 2);
}

TEST(StabilityLimits, WaterCountsWithTheSlopeOfItsDrag) {
  // F = 7.4 C_D scale v^2, and head on C_D = 0.8899. The slope 2 F / v over 1.776 m is the
  // viscosity: 2 * 7.4 * 0.8899 * 4 * 0.5 / 1.776 = 14.83 Pa s at 0.5 m/s, and twice that at 1
  // m/s.
  const experiments::RangeEntry water = {
      .setting = {.medium = "water", .quantity = "scale", .intensity = 4.0}};
  EXPECT_EQ(checked(study_at(1000.0), {water}, 0.5).num_needing_the_hand(), 1);
  EXPECT_EQ(checked(study_at(1000.0), {water}, 0.4).num_needing_the_hand(), 0) << "11.9 Pa s";
  EXPECT_EQ(checked(study_at(1000.0), {water}, 1.3).num_needing_the_hand(), 1) << "38.6 Pa s";
  EXPECT_EQ(checked(study_at(1000.0), {water}, 1.4).num_unstable(), 1) << "41.5 Pa s";
}

TEST(StabilityLimits, ASolidCountsWithItsStiffness) {
  const experiments::RangeEntry solid = {
      .setting = {.medium = "solid", .quantity = "stiffness_n_per_m", .intensity = 1000.0}};
  EXPECT_EQ(checked(study_at(1000.0), {solid}).num_needing_the_hand(), 1);
  EXPECT_EQ(checked(study_at(833.0), {solid}).num_unstable(), 1);
}

TEST(StabilityLimits, SaysInWordsWhatIsWrongAndWhatToRemember) {
  const StabilityCheck check = checked(study_at(1000.0), {viscous(20.0), viscous(50.0)});
  EXPECT_EQ(
      unstable_words(check, "exoskeleton"),
      "expected stimuli that `exoskeleton` renders stably at 1000 Hz (on the hand up to 40 "
      "Pa s and 2000 N/m), found 1 of 2 beyond");
  EXPECT_NE(detached_remark(check).find("1 of 2 stimuli"), std::string::npos);
  EXPECT_NE(detached_remark(check).find("12 Pa s"), std::string::npos);
  EXPECT_EQ(detached_remark(checked(study_at(1000.0), {viscous(5.0)})), "");
  EXPECT_EQ(words_of(StabilityLimit{512.0, true}, "Pa s"), "512 Pa s or more");
  EXPECT_EQ(words_of(StabilityLimit{46950.6}, "N/m"), "46900 N/m");
  EXPECT_EQ(words_of(StabilityLimit{}, "Pa s"), "none");
}

TEST(StabilityLimits, ThePreflightFailsForAnUnstableStimulusAndRemarksOnALooseFinger) {
  const experiments::RangeLimits limits{.max_force_per_point_n = 10, .max_total_force_n = 30};
  const std::vector<experiments::RangeEntry> range = {viscous(20.0), viscous(50.0)};
  const PreflightLine wrong =
      stimuli_line(range, limits, true, checked(study_at(1000.0), range));
  EXPECT_EQ(wrong.status, PreflightLine::Status::kFailed);
  EXPECT_EQ(wrong.found, "2 of 2 within limits, 1 unstable");
  EXPECT_NE(wrong.remedy, "");
  const std::vector<experiments::RangeEntry> fine = {viscous(20.0)};
  const PreflightLine remark =
      stimuli_line(fine, limits, true, checked(study_at(1000.0), fine));
  EXPECT_EQ(remark.status, PreflightLine::Status::kOk);
  EXPECT_EQ(remark.found, "1 of 1 within limits, 1 stable on the hand alone");
}

}  // namespace stability_limits_test
}  // namespace jnd::app
