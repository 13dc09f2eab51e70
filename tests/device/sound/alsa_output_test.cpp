#include "device/sound/alsa_output.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "core/error.h"
#include "support/files.h"
#include "support/temporary_folder.h"

namespace jnd::device {
namespace alsa_output_test {

using namespace std::chrono_literals;

/// Plays a repeated staircase of 997 steps, in which each sample determines the next one.
class Staircase final : public core::SoundSource {
 public:
  void render(std::span<float> samples, std::int64_t heard_ns) noexcept override {
    for (float& sample : samples) {
      sample = step_at(num_frames++);
    }
    last_heard_ns = heard_ns;
  }
  static float step_at(std::int64_t frame) {
    return static_cast<float>(frame % 997 - 498) / 1024.0f;
  }

  std::atomic<std::int64_t> num_frames{0}, last_heard_ns{0};
};

/// ALSA's own plug-in that writes what it plays to a file, over its plug-in that plays nothing,
/// stands in for a sound card.
class AlsaOutputTest : public ::testing::Test {
 protected:
  AlsaOutputTest() {
    test_support::write_file(temporary_.path() / "alsa.conf",
                             "pcm.to_a_file {\n"
                             "  type file\n  slave.pcm { type null }\n  file \"" +
                                 played().string() +
                                 "\"\n  format raw\n"
                                 "  hint { show on description \"what a test reads\" }\n}\n"
                                 "pcm.nothing { type null }\n");
    ::setenv("ALSA_CONFIG_PATH", (temporary_.path() / "alsa.conf").c_str(), 1);
  }
  ~AlsaOutputTest() override { ::unsetenv("ALSA_CONFIG_PATH"); }

  [[nodiscard]] std::filesystem::path played() const { return temporary_.path() / "played"; }

  static void wait_for(const std::function<bool()>& is_so) {
    for (int i = 0; i < 1000 && !is_so(); ++i) std::this_thread::sleep_for(10ms);
    EXPECT_TRUE(is_so());
  }

  test_support::TemporaryFolder temporary_;
};

TEST_F(AlsaOutputTest, PlaysEverySampleOnceInOrderToEveryChannel) {
  Staircase source;
  {
    const std::unique_ptr<SoundOutput> output = open_alsa_output("to_a_file");
    EXPECT_EQ(output->rate_hz(), 48000.0);
    EXPECT_NE(output->words().find("to_a_file, 48000 Hz, 2 channels, S32_LE"),
              std::string::npos)
        << output->words();
    output->start(source);
    wait_for([&] { return source.num_frames > 48000; });
    EXPECT_EQ(output->state().problem, "");
    EXPECT_EQ(output->state().num_underruns, 0);
    EXPECT_NE(output->state().scheduler, "");
    output->stop();
    const std::int64_t num_frames = source.num_frames;
    std::this_thread::sleep_for(30ms);
    EXPECT_EQ(source.num_frames, num_frames) << "nobody asks for more after stop";
  }
  const std::string bytes = test_support::read_file(played());
  std::vector<std::int32_t> samples(bytes.size() / sizeof(std::int32_t));
  std::memcpy(samples.data(), bytes.data(), samples.size() * sizeof(std::int32_t));
  ASSERT_GT(samples.size(), 2U * 40000U);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double expected =
        2147483647.0 *
        static_cast<double>(Staircase::step_at(static_cast<std::int64_t>(i / 2)));
    ASSERT_NEAR(samples[i], expected, 1.0) << "sample " << i;
  }
}

TEST_F(AlsaOutputTest, PlaysToWhatKeepsNothingByTheClock) {
  Staircase source;
  const std::unique_ptr<SoundOutput> output = open_alsa_output("nothing");
  output->start(source);
  std::this_thread::sleep_for(500ms);
  output->stop();
  // The frames are those of half a second, and of the quarter of a second within which the
  // output finds that the device keeps nothing. A busy machine may be late, and none is early.
  EXPECT_LE(source.num_frames, 48000);
  EXPECT_GT(source.num_frames, 4800);
  EXPECT_GT(output->longest_latency_s(), 0.0);
}

TEST_F(AlsaOutputTest, AnOutputThatIsNotThereIsNamedWithWhatToDo) {
  try {
    (void)open_alsa_output("nowhere");
    FAIL() << "it is there";
  } catch (const core::Error& error) {
    const std::string words = error.what();
    EXPECT_TRUE(
        words.starts_with("sound output nowhere: expected an output that can be opened"))
        << words;
    EXPECT_NE(words.find("`jnd sound` lists the outputs"), std::string::npos) << words;
  }
}

TEST_F(AlsaOutputTest, ListsWhatTheConfigurationOffers) {
  bool is_listed = false;
  for (const SoundOutputEntry& one : alsa_outputs()) {
    is_listed |= one.name == "to_a_file" && one.description == "what a test reads";
  }
  EXPECT_TRUE(is_listed);
}

TEST_F(AlsaOutputTest, IsStartedOnce) {
  Staircase source;
  const std::unique_ptr<SoundOutput> output = open_alsa_output("nothing");
  output->start(source);
  EXPECT_THROW(output->start(source), core::Error);
}

}  // namespace alsa_output_test
}  // namespace jnd::device
