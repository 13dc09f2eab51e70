#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "app/operator/operated_session_fixture.h"
#include "app/sound/fake_sound_output.h"
#include "core/sound/noise.h"
#include "core/sound/sound_level.h"
#include "core/sound/tone.h"
#include "core/storage/integrity.h"

namespace jnd::app {
namespace sounding_session_test {

using nlohmann::json;

constexpr char kNoise[] =
    R"("masking_noise": {"kind": "white", "level_dbfs": -30, "ramp_s": 0.1, "required": true})";
constexpr char kCues[] =
    R"("cues": [{"moment": "ready", "frequency_hz": 500, "level_dbfs": -30},
             {"moment": "begin", "frequency_hz": 1000, "level_dbfs": -30},
             {"moment": "end", "frequency_hz": 800, "duration_s": 0.05, "level_dbfs": -30}])";

std::string with_sound(const std::string& sound) {
  return replaced(kTinyStudy, "\"stages\": [", sound + ", \"stages\": [");
}

/// Runs a session whose sound goes to a fake output, which the test plays.
class SoundingSessionTest : public OperatedSessionTest {
 protected:
  SoundingSessionTest() {
    sound_ = {.output = "headphones",
              .settings = SoundSettings(temporary_.path() / "sound.json"),
              .open = fake_output(fake_)};
  }

  /// Alternates a tick of the session and 10 ms of sound.
  void listen(double duration_s) {
    for (double passed_s = 0.0; passed_s < duration_s; passed_s += 0.010) {
      session_->advance(0.010);
      fake_.play(80);
    }
  }
  SessionView heard(OperatorRequest request) {
    session_->request(std::move(request));
    listen(0.3);
    return view();
  }
  std::vector<json> events_of(const std::string& kind) const {
    std::vector<json> found;
    for (const core::EventRow& event : store_->events(session_number_)) {
      if (event.kind == kind) found.push_back(json::parse(event.data));
    }
    return found;
  }
  /// Returns the stored cues so far: "ready 1", "begin 1" ...
  std::vector<std::string> cues() const {
    std::vector<std::string> found;
    for (const json& event : events_of("cues_played")) {
      for (const json& cue : event["cues"]) {
        found.push_back(cue["moment"].get<std::string>() + " " +
                        std::to_string(cue["trial"].get<int>()));
      }
    }
    return found;
  }

  FakeSound fake_;
};

TEST_F(SoundingSessionTest, EverySampleIsNoiseAtItsLevelWithTheCuesWhereTheyAreSaidToBe) {
  open(with_sound(std::string(kNoise) + ", " + kCues));
  heard(operate::Begin{});
  const SessionView now = run_to_block("comparison");
  for (int i = 0; i < 2; ++i) {
    const std::int64_t trial = view().trial->trial;
    heard(operate::Present{trial, "reference"});
    heard(operate::Present{trial, "test"});
    heard(operate::Answer{trial, 1.0});
  }
  listen(0.5);
  ASSERT_TRUE(now.trial);
  // First comes the noise alone, from the first sample that is not silent.
  const std::uint64_t seed = store_->session(session_number_).seed;
  core::Noise noise({}, fake_.rate_hz, core::derived_seed(seed, "noise", {0}));
  const auto begin = std::find_if(fake_.heard.begin(), fake_.heard.end(),
                                  [](float sample) { return sample != 0.0f; });
  const auto first = static_cast<std::size_t>(begin - fake_.heard.begin());
  ASSERT_LT(first, 4000U);
  std::vector<double> expected(fake_.heard.size(), 0.0);
  for (std::size_t i = first; i < expected.size(); ++i) {
    const double place =
        std::min(1.0, static_cast<double>(i - first + 1) / (0.1 * fake_.rate_hz));
    expected[i] =
        core::rms_of_level(-30.0) * std::sin(0.5 * std::numbers::pi * place) * noise.next();
  }
  // Each cue begins where its event says.
  int num_cues = 0;
  for (const json& event : events_of("cues_played")) {
    for (const json& cue : event["cues"]) {
      const std::string moment = cue["moment"];
      const std::vector<float> tone =
          core::samples_of({.frequency_hz = moment == "ready"   ? 500.0
                                            : moment == "begin" ? 1000.0
                                                                : 800.0,
                            .duration_s = moment == "end" ? 0.05 : 0.1,
                            .level_dbfs = -30.0},
                           fake_.rate_hz);
      const double since_s =
          cue["heard_monotonic_s"].get<double>() - 1e-9 * static_cast<double>(fake_.first_ns);
      const auto at = static_cast<std::size_t>(std::llround(since_s * fake_.rate_hz));
      for (std::size_t i = 0; i < tone.size() && at + i < expected.size(); ++i) {
        expected[at + i] += static_cast<double>(tone[i]);
      }
      ++num_cues;
    }
  }
  EXPECT_GE(num_cues, 8);
  std::int64_t num_wrong = 0;
  // The last requested sounds may be heard and not stored yet.
  for (std::size_t i = 0; i + 1600 < expected.size(); ++i) {
    num_wrong += std::abs(expected[i] - static_cast<double>(fake_.heard[i])) > 1e-6 ? 1 : 0;
  }
  EXPECT_EQ(num_wrong, 0) << "of " << expected.size();
}

TEST_F(SoundingSessionTest, TellsOfTheMomentsOfATrialAndOfNothingElse) {
  open(with_sound(std::string(kNoise) + ", " + kCues));
  heard(operate::Begin{});
  const std::int64_t trial = run_to_block("comparison").trial->trial;
  listen(1.5);
  const std::string number = std::to_string(trial);
  std::vector<std::string> all = cues();
  ASSERT_FALSE(all.empty());
  EXPECT_EQ(all.back(), "ready " + number);
  const std::size_t before = all.size();
  heard(operate::Present{trial, "reference"});
  EXPECT_EQ(cues().size(), before) << "nothing waits for the disk while something is felt";
  heard(operate::Present{trial, "test"});
  heard(operate::Present{trial, "free_space"});
  heard(operate::Present{trial, "test"});
  heard(operate::Answer{trial, 1.0});
  all = cues();
  all.erase(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(before));
  EXPECT_EQ(all, (std::vector<std::string>{"begin " + number, "begin " + number,
                                           "end " + number, "begin " + number, "end " + number,
                                           "ready " + std::to_string(trial + 1)}));
  for (const json& event : events_of("cues_played")) {
    for (const json& cue : event["cues"]) {
      EXPECT_GE(cue["heard_monotonic_s"].get<double>(), 1e-9 * 1.0);
      EXPECT_GE(cue["attempt"].get<int>(), 1);
      EXPECT_EQ(cue["presentation"] == 0, cue["moment"] == "ready");
    }
  }
}

TEST_F(SoundingSessionTest, AStepOfAnAdjustmentIsNoNewStimulus) {
  open(with_sound(kCues));
  heard(operate::Begin{});
  const std::int64_t trial = run_to_block("production").trial->trial;
  heard(operate::Present{trial, "test"});
  heard(operate::Adjust{trial, experiments::Direction::kRaise});
  heard(operate::Adjust{trial, experiments::Direction::kLower});
  heard(operate::Answer{trial});
  const std::string number = std::to_string(trial);
  const std::vector<std::string> all = cues();
  EXPECT_EQ(std::ranges::count(all, "begin " + number), 1);
  EXPECT_EQ(std::ranges::count(all, "end " + number), 1);
}

// A listener learns nothing about a level: the same acts on stimuli of other levels give the
// same sound, to the last sample.
TEST_F(SoundingSessionTest, WhatIsHeardIsTheSameWhateverTheLevels) {
  std::vector<std::vector<float>> heard_in;
  for (const char* levels : {"[4, 16]", "[7.9, 8.1]"}) {
    fake_ = {};
    fake_.latency_s = 0.0;  // The machine's clock has no influence.
    folder_ = temporary_.path() / (std::string("levels_") + std::to_string(heard_in.size()));
    open(replaced(with_sound(std::string(kNoise) + ", " + kCues), "\"viscosity_pa_s\": [4, 16]",
                  std::string("\"viscosity_pa_s\": ") + levels));
    heard(operate::Begin{});
    (void)run_to_block("comparison");
    for (int i = 0; i < 4; ++i) {
      const std::int64_t trial = view().trial->trial;
      heard(operate::Present{trial, "reference"});
      heard(operate::Present{trial, "test"});
      heard(operate::Answer{trial, 1.0});
    }
    heard_in.push_back(fake_.heard);
    session_.reset();
  }
  ASSERT_EQ(heard_in[0].size(), heard_in[1].size());
  EXPECT_TRUE(heard_in[0] == heard_in[1]);
}

TEST_F(SoundingSessionTest, KeepsWhatPlaysAndHowItHasBeen) {
  sound_.settings.add(
      {.output = "headphones", .full_scale_db_spl = 101.5, .measured_on = "2026-11-26"});
  open(with_sound(R"("masking_noise": {"kind": "pink", "level_db_spl": 65})"));
  heard(operate::Begin{});
  ASSERT_EQ(events_of("sound_started").size(), 1U);
  const json started = events_of("sound_started")[0];
  EXPECT_EQ(started["output"], "a fake");
  EXPECT_EQ(started["full_scale_db_spl"], 101.5);
  EXPECT_EQ(started["calibrated_on"], "2026-11-26");
  EXPECT_EQ(started["noise_level_dbfs"], -36.5);
  EXPECT_EQ(started["cue_delay_s"], 0.02);
  EXPECT_EQ(view().sound_warning, "");
  fake_.state.num_underruns = 2;
  fake_.state.max_latency_s = 0.021;
  listen(0.05);
  EXPECT_EQ(view().sound_warning, "2 gaps of headphones so far");
  heard(operate::Leave{"later"});
  ASSERT_FALSE(events_of("sound_measured").empty());
  const json measured = events_of("sound_measured").back();
  EXPECT_EQ(measured["num_underruns"], 2);
  EXPECT_EQ(measured["max_latency_s"], 0.021);
  EXPECT_EQ(measured["num_limited"], 0);
  EXPECT_EQ(measured["num_lost_cues"], 0);
  EXPECT_GT(measured["num_frames"].get<std::int64_t>(), 1000);
  EXPECT_EQ(fake_.source, nullptr) << "the output is let go";
}

TEST_F(SoundingSessionTest, ASessionThatRequiresItsSoundDoesNotBeginWithoutIt) {
  fake_.refuses = "sound output headphones: expected an output, found none";
  open(with_sound(kNoise));
  const SessionView refused = act(operate::Begin{});
  EXPECT_EQ(refused.step, Step::kBegin);
  EXPECT_EQ(refused.refusal, "the study requires its sound: " + fake_.refuses);
  EXPECT_EQ(refused.sound_warning, fake_.refuses);
  EXPECT_TRUE(kinds().empty()) << "nothing is stored of a session that has not begun";
  fake_.refuses = "";
  EXPECT_NE(act(operate::Begin{}).step, Step::kBegin) << "somebody plugged it in";
  listen(0.1);
  EXPECT_EQ(events_of("sound_started").size(), 1U);
}

TEST_F(SoundingSessionTest, OneThatDoesNotRequireItBeginsWithoutAndKeepsWhy) {
  fake_.refuses = "sound output headphones: expected an output, found none";
  open(with_sound(R"("masking_noise": {"kind": "white", "level_dbfs": -30})"));
  EXPECT_NE(act(operate::Begin{}).step, Step::kBegin);
  pass(0.1);
  ASSERT_EQ(events_of("sound_missing").size(), 1U);
  EXPECT_EQ(events_of("sound_missing")[0]["problem"], fake_.refuses);
  EXPECT_EQ(view().sound_warning, fake_.refuses);
}

TEST_F(SoundingSessionTest, AnOutputThatFailsIsToldStoredAndTriedAgainAfterAPause) {
  open(with_sound(kNoise));
  heard(operate::Begin{});
  fake_.state.problem = "sound output headphones: expected to go on playing, found: unplugged";
  pass(0.1);
  ASSERT_EQ(events_of("sound_missing").size(), 1U) << "once";
  EXPECT_EQ(view().sound_warning, fake_.state.problem);
  act(operate::Pause{"unplugged"});
  ASSERT_EQ(fake_.opened.size(), 1U);
  session_->request(operate::GoOn{});
  fake_.on_open = [this] { fake_.state.problem = ""; };
  listen(0.3);
  EXPECT_EQ(fake_.opened.size(), 2U);
  EXPECT_EQ(view().sound_warning, "");
  EXPECT_EQ(events_of("sound_started").size(), 2U);
}

TEST_F(SoundingSessionTest, SoundThatIsSwitchedOffOpensNothing) {
  sound_.output = kSoundOff;
  open(with_sound(R"("masking_noise": {"kind": "white", "level_dbfs": -30})"));
  act(operate::Begin{});
  pass(0.1);
  EXPECT_TRUE(fake_.opened.empty());
  ASSERT_EQ(events_of("sound_missing").size(), 1U);
}

TEST_F(SoundingSessionTest, AStudyWithoutSoundOpensAndStoresNothing) {
  open();
  act(operate::Begin{});
  pass(0.1);
  EXPECT_TRUE(fake_.opened.empty());
  for (const std::string& kind : kinds()) {
    EXPECT_FALSE(kind.starts_with("sound") || kind.starts_with("cues")) << kind;
  }
}

TEST_F(SoundingSessionTest, ABlockOfItsOwnNoiseTakesTheOtherOnesPlace) {
  open(replaced(with_sound(R"("masking_noise": {"kind": "white", "level_dbfs": -30})"),
                "\"name\": \"estimation\",",
                "\"name\": \"estimation\", \"masking_noise\": {\"kind\": \"none\"},"));
  heard(operate::Begin{});
  listen(1.0);
  const auto loudness = [&](std::size_t last) {
    double sum = 0.0;
    for (std::size_t i = fake_.heard.size() - last; i < fake_.heard.size(); ++i) {
      sum += static_cast<double>(fake_.heard[i]) * static_cast<double>(fake_.heard[i]);
    }
    return core::level_of_rms(std::sqrt(sum / static_cast<double>(last)));
  };
  EXPECT_NEAR(loudness(4000), -30.0, 0.5);
  (void)run_to_block("estimation");
  listen(1.2);
  EXPECT_LT(loudness(800), -200.0) << "silence";
  (void)run_to_block("production");
  listen(1.2);
  EXPECT_NEAR(loudness(4000), -30.0, 0.5);
}

TEST_F(SoundingSessionTest, AWholeSessionIsSoundToTheCheckOfItsFolder) {
  open(with_sound(std::string(kNoise) + ", " + kCues));
  act(operate::Begin{});
  for (int guard = 0; guard < 1000 && view().step != Step::kFinished; ++guard) {
    step_on(view());
    fake_.play(160);
  }
  ASSERT_EQ(view().step, Step::kFinished);
  EXPECT_GT(cues().size(), 20U);
  const std::vector<std::string> all = kinds();
  EXPECT_EQ(all.back(), "session_completed") << "nothing comes after the end";
  EXPECT_TRUE(core::verify(*store_).problems.empty());
}

}  // namespace sounding_session_test
}  // namespace jnd::app
