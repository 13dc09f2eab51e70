#include "core/storage/recording.h"

#include <gtest/gtest.h>
#include <sqlite3.h>

#include <filesystem>

#include "core/error.h"
#include "support/temporary_folder.h"

namespace jnd::core {
namespace recording_test {

namespace fs = std::filesystem;

Sample at(std::int64_t tick) {
  Sample sample;
  sample.tick = tick;
  sample.tip_position_m[0][0] = 1e-4 * static_cast<double>(tick);
  return sample;
}

std::vector<std::int64_t> ticks_in(const fs::path& file, std::int64_t first,
                                   std::int64_t last) {
  std::vector<std::int64_t> ticks;
  RecordingReader(file).read(first, last, [&](const Sample& s) { ticks.push_back(s.tick); });
  return ticks;
}

TEST(Recording, ReadsBackExactlyTheTicksAskedFor) {
  const test_support::TemporaryFolder folder;
  const fs::path file = folder.path() / "0001.sqlite";
  {
    RecordingWriter writer(file, 1000.0);
    for (std::int64_t tick = 0; tick < 10000; ++tick) writer.append(at(tick));
    writer.flush();
  }
  const std::vector<std::int64_t> ticks = ticks_in(file, 4000, 4200);
  ASSERT_EQ(ticks.size(), 201U);
  EXPECT_EQ(ticks.front(), 4000);
  EXPECT_EQ(ticks.back(), 4200);
  EXPECT_EQ(ticks_in(file, 0, 1 << 20).size(), 10000U);
}

TEST(Recording, CountsTheTicksThatAreMissingInBetween) {
  const test_support::TemporaryFolder folder;
  const fs::path file = folder.path() / "0001.sqlite";
  {
    RecordingWriter writer(file, 1000.0);
    writer.flush();
    EXPECT_EQ(RecordingReader(file).missing_ticks(), 0);
    for (std::int64_t tick = 5; tick < 5000; ++tick) writer.append(at(tick));
    writer.flush();
    EXPECT_EQ(RecordingReader(file).missing_ticks(), 0);
    writer.append(at(5003));
    writer.append(at(5004));
    writer.append(at(5010));
  }
  EXPECT_EQ(RecordingReader(file).missing_ticks(), 3 + 5);
}

/// Returns tick 5010 in real time, after five ticks that never ran.
Sample after_five_missed() {
  Sample sample = at(5010);
  sample.num_missed_before = 5;
  sample.monotonic_ns = 5'010'000'000;
  return sample;
}

TEST(Recording, TicksThatNeverRanAreNotLost) {
  const test_support::TemporaryFolder folder;
  const fs::path file = folder.path() / "0001.sqlite";
  {
    RecordingWriter writer(file, 1000.0);
    for (std::int64_t tick = 0; tick < 5003; ++tick) writer.append(at(tick));
    writer.append(after_five_missed());
  }
  const RecordingReader reader(file);
  EXPECT_TRUE(reader.has_times());
  EXPECT_EQ(reader.missed(), (std::vector<TickRange>{{5005, 5009}}));
  EXPECT_EQ(reader.missing_ticks(), 2) << "5003 and 5004 ran and are nowhere";
  EXPECT_EQ(reader.ticks(), (std::vector<TickRange>{{0, 5002}, {5010, 5010}}));
  EXPECT_EQ(reader.accounted(), (std::vector<TickRange>{{0, 5002}, {5005, 5010}}));
}

TEST(Recording, OfSimulatedTimeIsAsItWas) {
  const test_support::TemporaryFolder folder;
  const fs::path file = folder.path() / "0001.sqlite";
  { RecordingWriter(file, 1000.0).append(at(0)); }
  EXPECT_FALSE(RecordingReader(file).has_times());
  EXPECT_TRUE(RecordingReader(file).missed().empty());
  { RecordingWriter(file, 1000.0).append(after_five_missed()); }
  EXPECT_TRUE(RecordingReader(file).has_times()) << "from the first of real time on";
  EXPECT_EQ(ticks_in(file, 0, 10000).size(), 2U);
}

TEST(Recording, KnowsWhatElseTheDeviceMeasured) {
  const test_support::TemporaryFolder folder;
  const fs::path file = folder.path() / "0001.sqlite";
  { RecordingWriter(file, 1000.0).append(at(0)); }
  EXPECT_EQ(RecordingReader(file).channels(), 0);
  Sample pressed = at(1);
  pressed.channels.bits = kButtons;
  pressed.channels.buttons = 4;
  { RecordingWriter(file, 1000.0).append(pressed); }
  Sample turned = at(2);
  turned.channels.bits = kOrientation;
  { RecordingWriter(file, 1000.0).append(turned); }
  EXPECT_EQ(RecordingReader(file).channels(), kButtons | kOrientation) << "of all segments";
  EXPECT_FALSE(RecordingReader(file).has_times()) << "they were in simulated time";
  RecordingReader(file).read(1, 1, [](const Sample& sample) {
    EXPECT_EQ(sample.channels.bits, kButtons);
    EXPECT_EQ(sample.channels.buttons, 4U);
  });
}

TEST(Recording, IsForItsOwnerOnly) {
  const test_support::TemporaryFolder folder;
  const fs::path file = folder.path() / "0001.sqlite";
  const RecordingWriter writer(file, 1000.0);
  EXPECT_EQ(fs::status(file).permissions() & fs::perms::all,
            fs::perms::owner_read | fs::perms::owner_write);
}

TEST(Recording, GoesOnInANewSegmentWhenReopened) {
  const test_support::TemporaryFolder folder;
  const fs::path file = folder.path() / "0001.sqlite";
  for (const std::int64_t start : {0, 50}) {
    RecordingWriter writer(file, 1000.0);
    for (std::int64_t tick = start; tick < start + 10; ++tick) writer.append(at(tick));
  }
  const std::vector<RecordingChunk> chunks = RecordingReader(file).chunks();
  ASSERT_EQ(chunks.size(), 2U);
  EXPECT_EQ(chunks[0].segment, 1);
  EXPECT_EQ(chunks[1].segment, 2);
  EXPECT_EQ(chunks[1].first_tick, 50);
  EXPECT_EQ(ticks_in(file, 0, 100).size(), 20U);
}

TEST(Recording, TellsADamagedChunkFromAnIntactOne) {
  const test_support::TemporaryFolder folder;
  const fs::path file = folder.path() / "0001.sqlite";
  {
    RecordingWriter writer(file, 1000.0);
    for (std::int64_t tick = 0; tick < 9000; ++tick) writer.append(at(tick));
  }
  sqlite3* database = nullptr;
  ASSERT_EQ(sqlite3_open(file.c_str(), &database), SQLITE_OK);
  ASSERT_EQ(
      sqlite3_exec(database,
                   "UPDATE chunk SET data = zeroblob(length(data)) WHERE first_tick = 4096",
                   nullptr, nullptr, nullptr),
      SQLITE_OK);
  sqlite3_close(database);
  const RecordingReader reader(file);
  const std::vector<RecordingChunk> chunks = reader.chunks();
  ASSERT_EQ(chunks.size(), 3U);
  EXPECT_TRUE(chunks[0].intact);
  EXPECT_FALSE(chunks[1].intact);
  EXPECT_TRUE(chunks[2].intact);
  EXPECT_THROW(reader.read(0, 9000, [](const Sample&) {}), Error);
}

/// The changed bytes can be decoded. Only the hash shows that they are not those that were
/// written.
TEST(Recording, ReadsNoSampleOfAChunkThatDoesNotFitItsHash) {
  const test_support::TemporaryFolder folder;
  const fs::path file = folder.path() / "0001.sqlite";
  {
    RecordingWriter writer(file, 1000.0);
    for (std::int64_t tick = 0; tick < 9000; ++tick) writer.append(at(tick));
  }
  sqlite3* database = nullptr;
  ASSERT_EQ(sqlite3_open(file.c_str(), &database), SQLITE_OK);
  ASSERT_EQ(
      sqlite3_exec(database,
                   "UPDATE chunk SET data = (SELECT data FROM chunk WHERE first_tick = 0) "
                   "WHERE first_tick = 4096",
                   nullptr, nullptr, nullptr),
      SQLITE_OK);
  sqlite3_close(database);
  const RecordingReader reader(file);
  std::int64_t last = -1;
  EXPECT_THROW(reader.read(0, 9000, [&last](const Sample& sample) { last = sample.tick; }),
               Error);
  EXPECT_EQ(last, 4095);
  EXPECT_THROW(reader.require_intact(), Error);
  EXPECT_NO_THROW(reader.read(8192, 9000, [](const Sample&) {})) << "others are intact";
}

TEST(Recording, RefusesAMissingFile) {
  EXPECT_THROW(RecordingReader("/nonexistent/0001.sqlite"), Error);
}

}  // namespace recording_test
}  // namespace jnd::core
