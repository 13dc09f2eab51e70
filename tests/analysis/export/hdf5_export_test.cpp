#include "analysis/export/hdf5_export.h"

#include <gtest/gtest.h>
#include <hdf5.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>

#include "analysis/hand_made_study.h"
#include "core/error.h"
#include "core/sample_table.h"
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

  static constexpr std::int64_t kNumTicks = 40000;  // More than two chunks.
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
  const std::vector<double> x = numbers("/session_0001/palm_inner_position_x_m");
  const std::vector<double> z = numbers("/session_0001/middle_force_z_n");
  for (std::size_t i = 0; i < ticks.size(); ++i) {
    EXPECT_EQ(x[i], ticks[i] / 1e7) << i;
    EXPECT_EQ(z[i], -ticks[i] / 1e3) << i;
  }
  for (const std::string& name : core::sample_column_names({})) {
    EXPECT_EQ(numbers("/session_0001/" + name).size(), ticks.size()) << name;
  }
}

TEST_F(Hdf5ExportTest, UnitsAreAttributesAndSimulatedIsSaid) {
  export_hdf5(study_.store(), temporary_.path() / "out", {});
  EXPECT_EQ(text("/session_0001/palm_inner_position_x_m", "unit"), "m");
  EXPECT_EQ(text("/session_0001/palm_inner_velocity_y_m_per_s", "unit"), "m/s");
  EXPECT_EQ(text("/session_0001/middle_force_z_n", "unit"), "N");
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
  EXPECT_EQ(numbers("/session_0001/middle_proximal_position_rad"), std::vector<double>{1.5708});
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
