#include "analysis/export/xdf_export.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "analysis/export/xdf_file.h"
#include "analysis/hand_made_study.h"
#include "core/error.h"
#include "core/storage/recording.h"
#include "core/storage/stream_file.h"
#include "core/streams/stream_info.h"
#include "core/streams/stream_wire.h"
#include "support/files.h"
#include "support/places.h"

#ifdef JND_HAS_LIBXDF
#include <xdf.h>
#endif

namespace jnd::analysis {
namespace xdf_export_test {

namespace fs = std::filesystem;
using nlohmann::json;

/// Reads the file by a separate reader, which knows the specification and nothing of this
/// program.
json read_back(const fs::path& file) {
  const fs::path script = test_support::source_folder() / "tests/analysis/export/read_xdf.py";
  const fs::path out = file.string() + ".json";
  const std::string command = "python3 '" + script.string() + "' '" + file.string() + "' > '" +
                              out.string() + "' 2> '" + out.string() + ".err'";
  EXPECT_EQ(std::system(command.c_str()), 0) << test_support::read_file(out.string() + ".err");
  return json::parse(test_support::read_file(out), nullptr, false);
}

bool has_python() { return std::system("python3 -c 'import struct' 2> /dev/null") == 0; }

class XdfExportTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!has_python()) GTEST_SKIP() << "no python3 here, which reads the files back";
    study_.add("P01", /*pilot=*/false, "", "", /*recorded=*/true);
    study_.happen("session_started");
    study_.happen("trial_started", 1);
    study_.happen("note_added", {}, R"({"text":"level 7"})");
    study_.happen("paused", {}, R"({"reason":"level 7"})");
    core::RecordingWriter writer(recording(), 1000.0, core::Durability::kAtClose);
    for (std::int64_t tick = 0; tick < kNumTicks; ++tick) {
      core::Sample sample{.tick = tick,
                          .monotonic_ns = 5'000'000'000 + 1'000'000 * tick,
                          .command_sequence = tick < 100 ? 1U : 2U,
                          .attached_bits = 1};
      sample.tip_position_m[0] = {1e-3 * static_cast<double>(tick % 100), 0.25, -0.125};
      sample.tip_force_n[0][2] = -0.5;
      writer.append(sample);
    }
    writer.flush();
  }

  [[nodiscard]] fs::path recording() const { return study_.store().recording_file(1); }

  /// Records the stream of another machine's amplifier, whose clock is two seconds behind ours.
  core::StreamFileSeal record_amplifier() {
    core::StreamFileWriter file(
        core::next_stream_file(recording()),
        {.name = "Amplifier",
         .type = "EEG",
         .format = core::ChannelFormat::kInt16,
         .channel_count = 2,
         .nominal_rate_hz = 100.0,
         .xml = "<?xml version=\"1.0\"?><info><name>Amplifier</name><type>EEG</type>"
                "<channel_count>2</channel_count><channel_format>int16</channel_format>"
                "<nominal_srate>100</nominal_srate></info>"});
    for (int i = 0; i < 50; ++i) {
      core::StreamSample sample = core::test_sample(core::ChannelFormat::kInt16, 2, i);
      sample.time_s = 3.0 + 0.01 * i;
      file.append(sample);
    }
    file.append(core::ClockOffset{3.0, 2.0, 1e-3});
    file.append(core::ClockOffset{3.5, 2.0001, 1e-3});
    return file.seal();
  }

  json exported(const ExportOptions& options = {}) {
    outcome_ = export_xdf(study_.store(), temporary_.path() / "out", options);
    return read_back(temporary_.path() / "out" / "session_0001.xdf");
  }

  static constexpr std::int64_t kNumTicks = 2500;
  HandMadeStudy study_;
  test_support::TemporaryFolder temporary_;
  ExportOutcome outcome_;
};

TEST_F(XdfExportTest, HoldsMarkersSamplesAndWhatOthersSent) {
  (void)record_amplifier();
  const json file = exported();
  EXPECT_TRUE(outcome_.samples);
  EXPECT_TRUE(outcome_.problems.empty());
  EXPECT_EQ(file["version"], "1.0");
  ASSERT_EQ(file["streams"].size(), 3U);
  EXPECT_GE(file["num_boundaries"], 3);

  const json& markers = file["streams"][0];
  EXPECT_EQ(markers["info"]["type"], "Markers");
  EXPECT_EQ(markers["info"]["channel_format"], "string");
  EXPECT_EQ(markers["info"]["desc"]["participant"], "P01");
  ASSERT_EQ(markers["values"].size(), 3U) << "notes are nobody else's business";
  EXPECT_EQ(json::parse(markers["values"][1][0].get<std::string>()),
            (json{{"what", "trial_started"}, {"session", 1}, {"event", 2}, {"trial", 1}}));
  EXPECT_EQ(markers["footer"]["sample_count"], "3");

  const json& samples = file["streams"][1];
  EXPECT_EQ(samples["info"]["nominal_srate"], "1000");
  EXPECT_EQ(samples["labels"].size(), 10U);
  EXPECT_EQ(samples["labels"][0], "hand_position_x_m");
  EXPECT_EQ(samples["labels"][9], "command");
  ASSERT_EQ(samples["times"].size(), static_cast<std::size_t>(kNumTicks));
  EXPECT_NEAR(samples["times"][0].get<double>(), 5.0, 1e-9);
  EXPECT_NEAR(samples["times"][kNumTicks - 1].get<double>(), 7.499, 1e-6);
  EXPECT_NEAR(samples["values"][1234][0].get<double>(), 0.034, 1e-6);
  EXPECT_NEAR(samples["values"][1234][1].get<double>(), 0.25, 1e-6);
  EXPECT_NEAR(samples["values"][1234][8].get<double>(), -0.5, 1e-6);
  EXPECT_EQ(samples["values"][99][9], 1.0);
  EXPECT_EQ(samples["values"][100][9], 2.0);
  EXPECT_EQ(samples["offsets"].size(), 2U);
  EXPECT_EQ(samples["offsets"][0][1], 0.0);
  EXPECT_EQ(samples["footer"]["sample_count"], std::to_string(kNumTicks));

  const json& amplifier = file["streams"][2];
  EXPECT_EQ(amplifier["info"]["name"], "Amplifier");
  ASSERT_EQ(amplifier["times"].size(), 50U);
  EXPECT_EQ(amplifier["times"][10], 3.1) << "as it was sent: readers correct it";
  EXPECT_EQ(amplifier["values"][3], (json{260, -261}));
  EXPECT_EQ(amplifier["offsets"], (json{{3.0, 2.0}, {3.5, 2.0001}}));
  EXPECT_EQ(amplifier["footer"]["num_offsets"], 2);
  EXPECT_EQ(amplifier["footer"]["first_timestamp"], "3");
}

TEST_F(XdfExportTest, OnlyTheChosenChannelsAreInIt) {
  const json file =
      exported({.selection = {.channels = {"hand_force_z_n", "palm_inner_position_y_m"}}});
  EXPECT_EQ(file["streams"][1]["labels"], (json{"hand_force_z_n", "palm_inner_position_y_m"}));
  EXPECT_NEAR(file["streams"][1]["values"][0][1].get<double>(), 0.25, 1e-6);
  EXPECT_THROW((void)export_xdf(study_.store(), temporary_.path() / "other",
                                {.selection = {.channels = {"no_such"}}}),
               core::Error);
  EXPECT_FALSE(fs::exists(temporary_.path() / "other"));
}

TEST_F(XdfExportTest, ADamagedStreamIsToldAndTheRestIsThere) {
  (void)record_amplifier();
  {
    std::fstream damaged(core::stream_files(recording()).front(),
                         std::ios::in | std::ios::out | std::ios::binary);
    std::string bytes{std::istreambuf_iterator<char>(damaged), {}};
    // A block of zstd begins with these bytes.
    const std::size_t at = bytes.find("\x28\xB5\x2F\xFD");
    ASSERT_NE(at, std::string::npos);
    damaged.clear();
    damaged.seekp(static_cast<std::streamoff>(at + 12));
    damaged << "XX";
  }
  const json file = exported();
  ASSERT_EQ(outcome_.problems.size(), 1U);
  ASSERT_EQ(file["streams"].size(), 3U);
  EXPECT_EQ(file["streams"][1]["times"].size(), static_cast<std::size_t>(kNumTicks));
}

TEST_F(XdfExportTest, LongLengthsAreReadBack) {
  const fs::path path = temporary_.path() / "long.xdf";
  XdfFile file(path);
  core::StreamInfo info{.name = "long", .format = core::ChannelFormat::kString, .uid = "1"};
  XdfStream stream(file, 7, info.format, core::xml_text(core::stream_xml(info, true)));
  stream.add(
      core::StreamSample{.time_s = 1.0, .values = {}, .texts = {std::string(70'000, 'x')}});
  stream.add(core::StreamSample{.time_s = 2.0, .values = {}, .texts = {""}});
  for (int i = 0; i < 300; ++i) {
    stream.add(core::StreamSample{.time_s = 3.0 + i, .values = {}, .texts = {"µ"}});
  }
  stream.finish();
  file.finish();
  const json read = read_back(path);
  ASSERT_EQ(read["streams"][0]["values"].size(), 302U);
  EXPECT_EQ(read["streams"][0]["values"][0][0].get<std::string>().size(), 70'000U);
  EXPECT_EQ(read["streams"][0]["values"][1][0], "");
  EXPECT_EQ(read["streams"][0]["values"][301][0], "µ");
}

#ifdef JND_HAS_LIBXDF
TEST_F(XdfExportTest, LibxdfReadsItToo) {
  (void)record_amplifier();
  (void)export_xdf(study_.store(), temporary_.path() / "out", {});
  Xdf read;
  ASSERT_EQ(read.load_xdf((temporary_.path() / "out" / "session_0001.xdf").string()), 0);
  ASSERT_EQ(read.streams.size(), 3U);
  EXPECT_EQ(read.streams[1].info.name, "jnd-samples");
  EXPECT_EQ(read.streams[1].info.channel_count, 10);
  EXPECT_EQ(read.streams[2].info.name, "Amplifier");
  EXPECT_EQ(read.streams[2].clock_times.size(), 2U);
}
#endif

}  // namespace xdf_export_test
}  // namespace jnd::analysis
