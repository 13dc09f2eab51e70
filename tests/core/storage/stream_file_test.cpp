#include "core/storage/stream_file.h"

#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/storage/backup.h"
#include "core/storage/database.h"
#include "core/storage/files.h"
#include "core/storage/integrity.h"
#include "core/storage/kept_study.h"
#include "core/storage/withdrawal.h"
#include "support/temporary_folder.h"

namespace jnd::core {
namespace stream_file_test {

namespace fs = std::filesystem;

StreamFileInfo amplifier() {
  return {.name = "Amplifier",
          .type = "EEG",
          .format = ChannelFormat::kFloat32,
          .channel_count = 2,
          .nominal_rate_hz = 500.0,
          .xml = "<info>all of it</info>"};
}

StreamSample numbered(int number) {
  StreamSample sample{.time_s = 100.0 + 0.002 * number, .values = std::string(8, '\0')};
  sample.values[0] = static_cast<char>(number);
  sample.values[1] = static_cast<char>(number >> 8);
  return sample;
}

/// Writes `num_samples` samples, and an offset for every hundred of them.
StreamFileSeal write(const fs::path& file, int num_samples) {
  StreamFileWriter writer(file, amplifier());
  for (int i = 0; i < num_samples; ++i) {
    writer.append(numbered(i));
    if (i % 100 == 0) writer.append(ClockOffset{100.0 + 0.002 * i, -3.25, 1e-3});
    if (i % 777 == 0) writer.flush();
  }
  return writer.seal();
}

class StreamFileTest : public ::testing::Test {
 protected:
  test_support::TemporaryFolder temporary_{test_support::memory_folder()};
  fs::path file_ = temporary_.path() / "0001.stream-01.sqlite";
};

TEST_F(StreamFileTest, ComesBackAsItWasWritten) {
  const StreamFileSeal told = write(file_, 10'000);
  EXPECT_EQ(told.num_samples, 10'000);
  EXPECT_EQ(told.num_offsets, 100);
  const StreamFileReader reader(file_);
  EXPECT_EQ(reader.info().name, "Amplifier");
  EXPECT_EQ(reader.info().xml, "<info>all of it</info>");
  EXPECT_EQ(reader.info().nominal_rate_hz, 500.0);
  EXPECT_EQ(reader.seal(), told);
  EXPECT_TRUE(reader.problems().empty());
  int next = 0;
  reader.read([&next](const StreamSample& sample) { ASSERT_EQ(sample, numbered(next++)); });
  EXPECT_EQ(next, 10'000);
  ASSERT_EQ(reader.offsets().size(), 100U);
  EXPECT_EQ(reader.offsets()[1].time_s, 100.2);
  EXPECT_EQ(reader.offsets()[1].offset_s, -3.25);
}

TEST_F(StreamFileTest, HoldsTextsOfAnyLength) {
  StreamFileInfo info = amplifier();
  info.format = ChannelFormat::kString;
  const std::vector<StreamSample> sent = {
      {.time_s = 1.0, .values = {}, .texts = {"a", ""}},
      {.time_s = 2.0, .values = {}, .texts = {std::string(100'000, '\0'), "\xFF"}}};
  {
    StreamFileWriter writer(file_, info);
    for (const StreamSample& sample : sent) writer.append(sample);
  }  // The file has no seal, as if the program had ended. It holds what had come until then.
  const StreamFileReader reader(file_);
  EXPECT_FALSE(reader.seal());
  std::vector<StreamSample> came;
  reader.read([&came](const StreamSample& sample) { came.push_back(sample); });
  EXPECT_EQ(came, sent);
}

TEST_F(StreamFileTest, IsWrittenOnce) {
  (void)write(file_, 10);
  try {
    StreamFileWriter(file_, amplifier());
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("stays as it is"), std::string::npos);
  }
  EXPECT_EQ(StreamFileReader(file_).seal()->num_samples, 10);
  StreamFileWriter sealed(temporary_.path() / "0002.stream-01.sqlite", amplifier());
  (void)sealed.seal();
  sealed.append(numbered(1));
  EXPECT_THROW(sealed.flush(), Error) << "behind its end";
}

TEST_F(StreamFileTest, NumbersGoOnAndBelongToTheirSession) {
  const fs::path recording = temporary_.path() / "0001.sqlite";
  EXPECT_EQ(next_stream_file(recording), file_);
  (void)write(file_, 1);
  (void)write(temporary_.path() / "0011.stream-01.sqlite", 1);
  EXPECT_EQ(next_stream_file(recording).filename(), "0001.stream-02.sqlite");
  EXPECT_EQ(stream_files(recording), std::vector<fs::path>{file_});
  EXPECT_EQ(recording_beside(file_), recording);
  EXPECT_EQ(recording_beside(recording), fs::path());
}

TEST_F(StreamFileTest, WhatIsChangedIsFound) {
  (void)write(file_, 5000);
  const auto tamper = [this](const std::string& sql) {
    Database database(file_, Database::Mode::kReadWrite, Durability::kEveryCommit);
    database.execute(sql);
  };
  tamper("UPDATE clock_offset SET offset_s = offset_s + 1e-6 WHERE number = 2");
  EXPECT_EQ(StreamFileReader(file_).problems().size(), 1U);
  tamper("UPDATE clock_offset SET offset_s = -3.25 WHERE number = 2");
  EXPECT_TRUE(StreamFileReader(file_).problems().empty());
  tamper("UPDATE stream_format SET nominal_rate_hz = 250");
  EXPECT_EQ(StreamFileReader(file_).problems().size(), 1U);
  tamper("UPDATE stream_format SET nominal_rate_hz = 500");
  tamper("UPDATE block SET data = zeroblob(20) WHERE number = 1");
  EXPECT_EQ(StreamFileReader(file_).problems().size(), 1U) << "a damaged block";
  EXPECT_THROW(StreamFileReader(file_).read([](const StreamSample&) {}), Error);
  tamper("DELETE FROM block WHERE number = 1");
  EXPECT_EQ(StreamFileReader(file_).problems().size(), 1U) << "a block that is gone";
}

TEST_F(StreamFileTest, WhatIsNoStreamIsRefused) {
  std::ofstream(file_) << "text";
  EXPECT_THROW(StreamFileReader reader(file_), Error);
  EXPECT_THROW(StreamFileReader reader(temporary_.path() / "none.sqlite"), Error);
}

class StreamOfAStudyTest : public ::testing::Test {
 protected:
  StreamOfAStudyTest() {
    kept_.add_session("P01");
    file_ = next_stream_file(kept_.recording(1));
    (void)write(file_, 1000);
  }
  [[nodiscard]] Integrity verified(const fs::path& folder) const {
    return verify(StudyStore(folder, StudyStore::Mode::kReadOnly));
  }

  KeptStudy kept_;
  fs::path file_;
};

TEST_F(StreamOfAStudyTest, IsVerifiedWithIt) {
  EXPECT_TRUE(verified(kept_.folder()).complete);
  {
    Database database(file_, Database::Mode::kReadWrite, Durability::kEveryCommit);
    database.execute("UPDATE block SET num_samples = 999");
  }
  const Integrity found = verified(kept_.folder());
  EXPECT_FALSE(found.complete);
  ASSERT_FALSE(found.problems.empty());
  EXPECT_EQ(found.problems[0].session, 1);
}

TEST_F(StreamOfAStudyTest, OfNoSessionIsAProblem) {
  (void)write(kept_.folder() / "recordings" / "0099.stream-01.sqlite", 1);
  EXPECT_FALSE(verified(kept_.folder()).complete);
}

TEST_F(StreamOfAStudyTest, IsBackedUpAndGoesWithAWithdrawal) {
  const fs::path copy = kept_.beside("copy");
  EXPECT_TRUE(back_up(kept_.folder(), copy, 1).integrity.complete);
  const fs::path copied = copy / "recordings" / file_.filename();
  EXPECT_EQ(StreamFileReader(copied).seal(), StreamFileReader(file_).seal());
  EXPECT_TRUE(back_up(kept_.folder(), copy, 2).integrity.complete) << "again";
  (void)withdraw(kept_.folder(), "P01", 3);
  for (const fs::path& folder : {kept_.folder(), copy}) {
    for (const auto& entry : fs::directory_iterator(folder / "recordings")) {
      ADD_FAILURE() << entry.path();
    }
    EXPECT_TRUE(verified(folder).complete);
  }
}

}  // namespace stream_file_test
}  // namespace jnd::core
