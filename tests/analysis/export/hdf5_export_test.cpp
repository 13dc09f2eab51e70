#include "analysis/export/hdf5_export.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hdf5.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>

#include "analysis/hand_made_study.h"
#include "core/error.h"
#include "core/storage/recording.h"
#include "support/files.h"

namespace jnd::analysis {
namespace hdf5_export_test {

namespace fs = std::filesystem;

class Hdf5ExportTest : public ::testing::Test {
 protected:
  Hdf5ExportTest() {
    study_.add("P01", /*pilot=*/false, R"({"name": "made"})");
    (void)study_.answer({.block = "estimation", .intensity = 0.1 + 0.2, .first_tick = 2});
    study_.add("PILOT", /*pilot=*/true);
    core::RecordingWriter writer(study_.store().recording_file(1), 1000.0,
                                 core::Durability::kAtClose);
    for (std::int64_t tick = 0; tick < kNumTicks; ++tick) {
      if (tick == 7 || tick == 8) continue;
      core::Sample sample{.tick = tick, .attached_bits = 31};
      sample.tip_position_m[0][0] = 1e-7 * static_cast<double>(tick);
      sample.tip_force_n[4][2] = -1e-3 * static_cast<double>(tick);
      writer.append(sample);
    }
  }

  [[nodiscard]] fs::path file(const char* name = "out") const {
    return temporary_.path() / name / "study.h5";
  }
  [[nodiscard]] std::vector<double> numbers(const std::string& name) const {
    const hid_t opened = H5Fopen(file().c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
    const hid_t dataset = H5Dopen2(opened, name.c_str(), H5P_DEFAULT);
    EXPECT_GE(dataset, 0) << name;
    const hid_t space = H5Dget_space(dataset);
    std::vector<double> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
    H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    H5Sclose(space);
    H5Dclose(dataset);
    H5Fclose(opened);
    return values;
  }
  [[nodiscard]] std::string text(const std::string& object, const char* attribute) const {
    const hid_t opened = H5Fopen(file().c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
    const hid_t found =
        H5Aopen_by_name(opened, object.c_str(), attribute, H5P_DEFAULT, H5P_DEFAULT);
    EXPECT_GE(found, 0) << object << ' ' << attribute;
    const hid_t type = H5Aget_type(found);
    std::string value(H5Tget_size(type), '\0');
    H5Aread(found, type, value.data());
    H5Tclose(type);
    H5Aclose(found);
    H5Fclose(opened);
    return value;
  }

  [[nodiscard]] double number(const std::string& object, const char* attribute) const {
    const hid_t opened = H5Fopen(file().c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
    const hid_t found =
        H5Aopen_by_name(opened, object.c_str(), attribute, H5P_DEFAULT, H5P_DEFAULT);
    EXPECT_GE(found, 0) << object << ' ' << attribute;
    double value = NAN;
    H5Aread(found, H5T_NATIVE_DOUBLE, &value);
    H5Aclose(found);
    H5Fclose(opened);
    return value;
  }
  [[nodiscard]] bool has(const std::string& name) const {
    const hid_t opened = H5Fopen(file().c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
    const bool found = H5Lexists(opened, name.c_str(), H5P_DEFAULT) > 0;
    H5Fclose(opened);
    return found;
  }
  [[nodiscard]] std::vector<std::int64_t> counts(const std::string& name) const {
    const hid_t opened = H5Fopen(file().c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
    const hid_t dataset = H5Dopen2(opened, name.c_str(), H5P_DEFAULT);
    const hid_t space = H5Dget_space(dataset);
    std::vector<std::int64_t> values(
        static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
    H5Dread(dataset, H5T_NATIVE_INT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    H5Sclose(space);
    H5Dclose(dataset);
    H5Fclose(opened);
    return values;
  }
  [[nodiscard]] std::vector<std::string> texts(const std::string& name) const {
    const hid_t opened = H5Fopen(file().c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
    const hid_t dataset = H5Dopen2(opened, name.c_str(), H5P_DEFAULT);
    EXPECT_GE(dataset, 0) << name;
    const hid_t space = H5Dget_space(dataset);
    const hid_t type = H5Dget_type(dataset);
    const std::size_t length = H5Tget_size(type);
    const auto count = static_cast<std::size_t>(H5Sget_simple_extent_npoints(space));
    std::string bytes(count * length, '\0');
    if (count > 0) H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data());
    H5Tclose(type);
    H5Sclose(space);
    H5Dclose(dataset);
    H5Fclose(opened);
    std::vector<std::string> all;
    for (std::size_t i = 0; i < count; ++i) {
      all.emplace_back(bytes.substr(i * length, length).c_str());
    }
    return all;
  }
  [[nodiscard]] H5T_cset_t letters_of(const std::string& name) const {
    const hid_t opened = H5Fopen(file().c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
    const hid_t dataset = H5Dopen2(opened, name.c_str(), H5P_DEFAULT);
    const hid_t type = H5Dget_type(dataset);
    const H5T_cset_t letters = H5Tget_cset(type);
    H5Tclose(type);
    H5Dclose(dataset);
    H5Fclose(opened);
    return letters;
  }

  static constexpr std::int64_t kNumTicks = 40000;  // So many ticks fill more than two chunks.
  HandMadeStudy study_;
  test_support::TemporaryFolder temporary_{test_support::memory_folder()};
};

TEST_F(Hdf5ExportTest, HoldsEverySampleAsTheCsvDoes) {
  export_hdf5(study_.store(), temporary_.path() / "out", {});
  const std::vector<double> ticks = numbers("/session_0001/tick");
  ASSERT_EQ(ticks.size(), kNumTicks - 2);
  EXPECT_EQ(ticks[6], 6.0);
  EXPECT_EQ(ticks[7], 9.0) << "nothing is filled in";
  EXPECT_EQ(ticks.back(), kNumTicks - 1);
  // The values are ordered by point and then by axis, and rounded to the stored steps.
  const std::size_t num = ticks.size();
  const std::vector<double> position = numbers("/session_0001/position_m");
  const std::vector<double> force = numbers("/session_0001/force_n");
  ASSERT_EQ(position.size(), 15 * num);
  ASSERT_EQ(force.size(), 15 * num);
  for (std::size_t i = 0; i < num; ++i) {
    EXPECT_EQ(position[i], ticks[i]) << i;
    EXPECT_EQ(position[num + i], 0.0) << "along y";
    EXPECT_EQ(force[(3 * 4 + 2) * num + i], -ticks[i]) << i;
  }
  EXPECT_EQ(number("/session_0001/position_m", "scale_factor"), 1e-7);
  EXPECT_EQ(number("/session_0001/force_n", "scale_factor"), 1e-3);
  EXPECT_EQ(number("/session_0001/velocity_m_per_s", "scale_factor"), 1e-4);
  for (const char* name : {"attached_bits", "immersed_bits", "limited", "fault"}) {
    EXPECT_EQ(numbers("/session_0001/" + std::string(name)).size(), num) << name;
  }
}

TEST_F(Hdf5ExportTest, WhatIsNoNumberIsMissingAndWhatIsTooLargeIsTheLargest) {
  fs::remove(study_.store().recording_file(1));
  core::RecordingWriter writer(study_.store().recording_file(1), 1000.0,
                               core::Durability::kAtClose);
  core::Sample sample{.tick = 0};
  sample.tip_position_m[0] = {std::nan(""), 1e9, -1e9};
  writer.append(sample);
  writer.flush();
  export_hdf5(study_.store(), temporary_.path() / "out", {});
  const std::vector<double> position = numbers("/session_0001/position_m");
  EXPECT_EQ(position[0], number("/session_0001/position_m", "_FillValue"));
  EXPECT_EQ(position[1], 2147483647.0);
  EXPECT_EQ(position[2], -2147483647.0);
}

TEST_F(Hdf5ExportTest, IsAtMostFifteenTimesAsLargeAsTheRecording) {
  // The hand moves like a person's, with some noise, which is the same at all points.
  fs::remove(study_.store().recording_file(1));
  {
    core::RecordingWriter writer(study_.store().recording_file(1), 1000.0,
                                 core::Durability::kAtClose);
    for (std::int64_t tick = 0; tick < kNumTicks; ++tick) {
      core::Sample sample{.tick = tick, .attached_bits = 31};
      const double angle = 6.0 * 1e-3 * static_cast<double>(tick);
      for (std::size_t point = 0; point < core::kNumContactPoints; ++point) {
        sample.tip_position_m[point] = {0.1 * std::sin(angle), 0.01 * std::sin(0.3 * angle),
                                        0.02 * std::cos(angle)};
        sample.tip_velocity_m_per_s[point] = {0.6 * std::cos(angle), 0.0, 0.0};
        sample.tip_force_n[point] = {-2.0 * std::cos(angle), 0.0, 0.0};
      }
      writer.append(sample);
    }
  }
  export_hdf5(study_.store(), temporary_.path() / "out", {});
  EXPECT_LE(fs::file_size(file()), 15 * fs::file_size(study_.store().recording_file(1)));
}

TEST_F(Hdf5ExportTest, OfOneChannelAtATenthOfTheRateEachRowIsTheMeanOfItsTicks) {
  export_hdf5(study_.store(), temporary_.path() / "out",
              {.selection = {.channels = {"position_m"}, .rate_hz = 100.0}});
  const std::vector<double> ticks = numbers("/session_0001/tick");
  ASSERT_EQ(ticks.size(), kNumTicks / 10);
  EXPECT_EQ(ticks[1], 10.0);
  const std::vector<double> x = numbers("/session_0001/position_m");
  // The mean of 0 to 9 without 7 and 8 is 30 / 8, rounded to the stored step.
  EXPECT_EQ(x[0], 4.0);
  EXPECT_EQ(x[1], 15.0) << "10 to 19 have the mean 14.5";
  EXPECT_EQ(numbers("/session_0001/attached_bits").at(3), 31.0);
  EXPECT_FALSE(has("/session_0001/force_n"));
  EXPECT_EQ(number("/session_0001", "samples_rate_hz"), 100.0);
}

TEST_F(Hdf5ExportTest, AChannelOrARateThatThereIsNotIsRefused) {
  const auto message = [this](const ExportSelection& selection) {
    try {
      export_hdf5(study_.store(), temporary_.path() / "out", {.selection = selection});
    } catch (const core::Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_THAT(message({.channels = {"posture"}}),
              testing::AllOf(testing::StartsWith("--channel: expected one of monotonic_s, "),
                             testing::HasSubstr("found `posture`; nothing was written")));
  EXPECT_EQ(message({.rate_hz = 300.0}),
            "--rate-hz: expected the rate of session 1, which is 1000 Hz, or a whole fraction "
            "of it, as 100, found 300; nothing was written");
  EXPECT_THAT(message({.participants = {"P09"}}), testing::HasSubstr("found `P09`"));
  EXPECT_EQ(message({.blocks = {"matching"}}),
            "--block: expected a block with an answered trial, which are estimation, found "
            "`matching`; nothing was written");
  EXPECT_TRUE(fs::is_empty(temporary_.path())) << "nothing is left behind";
}

TEST_F(Hdf5ExportTest, OfABlockItHasThatBlocksTrialsAndTicks) {
  (void)study_.answer(
      {.block = "matching", .intensity = 2.0, .first_tick = 30, .last_tick = 39});
  export_hdf5(study_.store(), temporary_.path() / "out",
              {.selection = {.blocks = {"matching"}}, .pilot = true});
  EXPECT_EQ(texts("/session_0002/trials/block"), std::vector<std::string>{"matching"});
  EXPECT_EQ(texts("/session_0001/trials/block"), std::vector<std::string>{});
  EXPECT_TRUE(numbers("/session_0001/tick").empty()) << "no tick of it in that session";
}

TEST_F(Hdf5ExportTest, UnitsAreAttributesAndSimulatedIsSaid) {
  export_hdf5(study_.store(), temporary_.path() / "out", {});
  EXPECT_EQ(text("/session_0001/position_m", "unit"), "m");
  EXPECT_EQ(text("/session_0001/velocity_m_per_s", "unit"), "m/s");
  EXPECT_EQ(text("/session_0001/force_n", "unit"), "N");
  EXPECT_EQ(text("/session_0001/force_n", "dimensions"), "point axis tick");
  EXPECT_EQ(text("/session_0001/force_n", "point_names"),
            "palm_inner palm_outer thumb index middle");
  EXPECT_EQ(text("/session_0001/force_n", "axis_names"), "x y z");
  EXPECT_EQ(text("/session_0001", "participant"), "P01");
  EXPECT_NE(text("/", "content").find("SIMULATED"), std::string::npos);
}

TEST_F(Hdf5ExportTest, TellsGapsTrialsAndWhatThereIsNot) {
  export_hdf5(study_.store(), temporary_.path() / "out", {});
  EXPECT_EQ(numbers("/session_0001/gaps/first_tick"), std::vector<double>{7.0});
  EXPECT_EQ(numbers("/session_0001/gaps/last_tick"), std::vector<double>{8.0});
  EXPECT_EQ(numbers("/session_0001/trials/intensity"), std::vector<double>{0.1 + 0.2});
  EXPECT_EQ(numbers("/session_0001/trials/first_tick"), std::vector<double>{2.0});
  EXPECT_TRUE(std::isnan(numbers("/session_0001/trials/starting_intensity").at(0)));
}

TEST_F(Hdf5ExportTest, HasTheTablesOfTheCsvWithWholeNumbersExact) {
  study_.say("about_you", "handedness", "left");
  study_.explore(4, "viscous", 2.5, 10, 19);
  export_hdf5(study_.store(), temporary_.path() / "out", {.pilot = true});
  const std::string events = "/session_0002/events/";
  EXPECT_EQ(numbers(events + "stage").back(), 4.0);
  EXPECT_EQ(numbers(events + "last_tick").back(), 19.0);
  EXPECT_TRUE(std::isnan(numbers(events + "trial").back()));
  EXPECT_EQ(texts(events + "kind").back(), "medium_explored");
  EXPECT_EQ(texts(events + "data").back(), R"({"medium":"viscous"})");
  EXPECT_EQ(texts("/session_0002/answers/answer"), std::vector<std::string>{"left"});
  EXPECT_EQ(texts("/session_0001/trials/participant"), std::vector<std::string>{"P01"});
  EXPECT_EQ(texts("/sessions/participant"), (std::vector<std::string>{"P01", "PILOT"}));
  EXPECT_EQ(numbers("/sessions/simulated"), (std::vector<double>{1.0, 0.0}));
  EXPECT_EQ(texts("/codebook/column").front(), "session");
  EXPECT_EQ(numbers("/session_0001/trials/is_catch"), std::vector<double>{0.0});
  EXPECT_EQ(texts("/session_0001/questionnaires/item"), std::vector<std::string>{});
}

TEST_F(Hdf5ExportTest, WhatWasMeasuredOfADeviceIsInItOnce) {
  const std::string hash = study_.add_measured("P08", "{\"name\": \"left\"}");
  (void)study_.add_measured("P09", "{\"name\": \"left\"}");
  export_hdf5(study_.store(), temporary_.path() / "out", {});
  EXPECT_EQ(texts("/device_profiles/sha256"), std::vector<std::string>{hash});
  EXPECT_EQ(texts("/device_profiles/text"), std::vector<std::string>{"{\"name\": \"left\"}"});
  EXPECT_EQ(texts("/sessions/device_profile_sha256").back(), hash);
}

TEST_F(Hdf5ExportTest, TimesInNanosecondsKeepEveryDigit) {
  core::StudyStore other(temporary_.path() / "t.study", core::StudyStore::Mode::kCreate,
                         core::Durability::kAtClose);
  const std::string hash = other.add_protocol("t.json", "{}");
  constexpr std::int64_t kTimeNs = 1'709'210'096'123'456'789;
  other.add_session({.participant = "P01",
                     .protocol_sha256 = hash,
                     .rate_hz = 1000.0,
                     .recorded = false,
                     .started_time_ns = kTimeNs});
  export_hdf5(other, temporary_.path() / "out", {});
  EXPECT_EQ(counts("/sessions/started_time_ns"), std::vector<std::int64_t>{kTimeNs});
}

TEST_F(Hdf5ExportTest, TextIsAsciiUnlessALetterIsNot) {
  study_.add("P02");
  study_.say("about_you", "remarks", "none");
  study_.add("P03");
  study_.say("about_you", "remarks", "zäh");
  export_hdf5(study_.store(), temporary_.path() / "out", {});
  EXPECT_EQ(letters_of("/session_0001/trials/block"), H5T_CSET_ASCII);
  EXPECT_EQ(letters_of("/session_0003/answers/answer"), H5T_CSET_ASCII);
  EXPECT_EQ(letters_of("/session_0004/answers/answer"), H5T_CSET_UTF8);
  EXPECT_EQ(texts("/session_0004/answers/answer"), std::vector<std::string>{"zäh"});
}

TEST_F(Hdf5ExportTest, JointsAreTheStepsThatWereStored) {
  fs::remove(study_.store().recording_file(1));
  core::RecordingWriter writer(study_.store().recording_file(1), 1000.0,
                               core::Durability::kAtClose);
  core::Sample sample{.tick = 0};
  sample.joint_position_rad[21] = 1.5708F;
  writer.append(sample);
  writer.flush();
  export_hdf5(study_.store(), temporary_.path() / "out", {});
  EXPECT_EQ(numbers("/session_0001/joint_position_rad").at(21), 1570800.0);
  EXPECT_EQ(number("/session_0001/joint_position_rad", "scale_factor"), 1e-6);
}

TEST_F(Hdf5ExportTest, OctaveLoadsIt) {
  if (std::system("octave --version >/dev/null 2>&1") != 0) {
    GTEST_SKIP() << "octave is not there";
  }
  study_.move({.presentation = 1, .interval = "test", .intensity = 1.0});
  export_hdf5(study_.store(), temporary_.path() / "out", {});
  const fs::path said = temporary_.path() / "said";
  const std::string script = "s = load('" + file().string() +
                             "'); one = s.session_0001; disp(one.tick(8)); "
                             "disp(one.trials.participant(:)'); disp(s.sessions.simulated); "
                             "disp(one.trials.block(:)');";
  (void)std::system(("octave --no-gui --quiet --norc --eval \"" + script + "\" >'" +
                     said.string() + "' 2>/dev/null")
                        .c_str());
  EXPECT_EQ(test_support::read_file(said), "9\nP01\n1\nestimation\n");
}

TEST_F(Hdf5ExportTest, PilotsAreThereOnlyWhenAskedForAndTheSameStudyGivesTheSameBytes) {
  const auto bytes = [this](const char* name) { return test_support::read_file(file(name)); };
  export_hdf5(study_.store(), temporary_.path() / "a", {});
  export_hdf5(study_.store(), temporary_.path() / "b", {});
  export_hdf5(study_.store(), temporary_.path() / "with", {.pilot = true});
  EXPECT_EQ(bytes("a"), bytes("b"));
  EXPECT_EQ(bytes("a").find("PILOT"), std::string::npos);
  EXPECT_NE(bytes("with").find("PILOT"), std::string::npos);
}

TEST_F(Hdf5ExportTest, WhatFailsHalfWayLeavesNothing) {
  std::ofstream(study_.store().recording_file(1)) << "no recording any more";
  EXPECT_THROW(export_hdf5(study_.store(), temporary_.path() / "out", {}), core::Error);
  EXPECT_TRUE(fs::is_empty(temporary_.path()));
}

}  // namespace hdf5_export_test
}  // namespace jnd::analysis
