#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>

#include "app/acknowledged.h"
#include "app/commands/command_fixture.h"
#include "app/json_document.h"
#include "app/session_content.h"
#include "app/tiny_study.h"
#include "support/places.h"
#include "support/program.h"

namespace jnd::app {
namespace run_test {

namespace fs = std::filesystem;
using test_support::ProgramOutcome;
using test_support::RunningProgram;

class RunCommandTest : public CommandTest {
 protected:
  RunCommandTest() { write_file(temporary_.path() / "tiny.json", kTinyStudy); }

  static std::vector<std::string> run_words(const std::string& study,
                                            const std::string& file = "tiny.json") {
    return {"run", file,         "--study", study, "--participant",
            "P01", "--headless", "--seed",  "7",   "--acknowledge"};
  }
};

TEST_F(RunCommandTest, AcknowledgesEveryEventOnceInOrderAndNothingElse) {
  for (const std::string file : {"tiny.json", "protocols/short_tour.json"}) {
    const std::string study = fs::path(file).stem().string() + ".study";
    const ProgramOutcome outcome = jnd(run_words(study, file));
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const core::StudyStore store = opened(study);
    std::string expected;
    for (const core::EventRow& event : store.events(1)) {
      expected += "EVENT " + std::to_string(event.sequence) + " " + event.kind + "\n";
    }
    EXPECT_EQ(outcome.out, expected);
    EXPECT_TRUE(store.completed(1));
    EXPECT_EQ(jnd({"verify", study}).exit_code, 0);
  }
}

TEST_F(RunCommandTest, APosteriorAtTheEndOfItsGridIsTold) {
  const auto study_with = [](const std::string& pse) {
    return R"json({"format": 1, "name": "edge", "languages": ["en"], "title": {"en": "E"},
      "authors": ["A. Author"], "device": {"min_contact_points": 1}, "stages": [
      {"kind": "block", "name": "one", "procedure": "quest_plus", "medium": "viscous",
       "viscosity_pa_s": [5, 7, 9, 11, 14, 20], "reference_viscosity_pa_s": 10,
       "weber_fraction": [0.02, 8], "max_trials": 30, "pse_viscosity_pa_s": )json" +
           pse + R"json(, "instruction": {"en": "Compare."}, "question": {"en": "Thicker?"},
       "expected_trial_s": 5}]})json";
  };
  write_file(temporary_.path() / "narrow.json", study_with("[9.99, 10.01]"));
  const ProgramOutcome narrow = jnd(run_words("narrow.study", "narrow.json"));
  EXPECT_EQ(narrow.exit_code, 0) << narrow.err;
  EXPECT_NE(narrow.err.find("jnd: CAUTION, one: the posterior of QUEST+ reaches "),
            std::string::npos)
      << narrow.err;
  write_file(temporary_.path() / "wide.json", study_with("[2, 50]"));
  EXPECT_EQ(jnd(run_words("wide.study", "wide.json")).err.find("CAUTION"), std::string::npos);
  write_file(temporary_.path() / "beside.json", study_with("[12, 16]"));
  const ProgramOutcome beside = jnd(run_words("beside.study", "beside.json"));
  EXPECT_EQ(beside.exit_code, 1);
  EXPECT_NE(beside.err.find("from below the reference to above it (10)"), std::string::npos)
      << beside.err;
}

TEST_F(RunCommandTest, TheLanguageIsOneOfTheStudyAndIsKept) {
  std::vector<std::string> words = run_words("a.study", "protocols/short_tour.json");
  words.insert(words.end(), {"--language", "fr"});
  ProgramOutcome outcome = jnd(words);
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(
      outcome.err.find("--language: expected one that short_tour has (en, de), found `fr`"),
      std::string::npos)
      << outcome.err;
  EXPECT_FALSE(fs::exists(temporary_.path() / "a.study"));
  words.back() = "de";
  outcome = jnd(words);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(opened("a.study").events(1).front().data.find("\"language\":\"de\""),
            std::string::npos);
}

TEST_F(RunCommandTest, APseudonymThatLooksLikeAnotherIsTold) {
  ASSERT_EQ(jnd(run_words("a.study")).err.find("looks like"), std::string::npos);
  std::vector<std::string> words = run_words("a.study");
  words[5] = "p1";
  const ProgramOutcome outcome = jnd(words);
  EXPECT_EQ(outcome.exit_code, 0) << "another person may well be called so";
  EXPECT_NE(outcome.err.find("--participant: p1 looks like P01"), std::string::npos)
      << outcome.err;
}

TEST_F(RunCommandTest, TheSameSeedGivesTheSameSession) {
  ASSERT_EQ(jnd(run_words("a.study")).exit_code, 0);
  ASSERT_EQ(jnd(run_words("b.study")).exit_code, 0);
  EXPECT_EQ(difference(tables_text(opened("a.study"), 1), tables_text(opened("b.study"), 1)),
            "");
  EXPECT_EQ(difference(samples_text(opened("a.study"), 1), samples_text(opened("b.study"), 1)),
            "");
}

TEST_F(RunCommandTest, WithoutASeedOneIsDrawnAndStored) {
  for (const char* study : {"a.study", "b.study"}) {
    ASSERT_EQ(jnd({"run", "tiny.json", "--study", study, "--participant", "P01", "--headless"})
                  .exit_code,
              0);
  }
  EXPECT_NE(opened("a.study").sessions()[0].seed, opened("b.study").sessions()[0].seed);
}

TEST_F(RunCommandTest, ASecondSessionOfAParticipantIsRefusedInOneSentence) {
  ASSERT_EQ(jnd(run_words("a.study")).exit_code, 0);
  const ProgramOutcome outcome = jnd(run_words("a.study"));
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(outcome.out, "");
  EXPECT_NE(outcome.err.find("P01 has a session already"), std::string::npos) << outcome.err;
  EXPECT_EQ(lines_of(outcome.err).size(), 1U);
  EXPECT_EQ(opened("a.study").sessions().size(), 1U);
}

TEST_F(RunCommandTest, AChangedStudyOrLaboratoryIsNotMixedIntoTheSameFolder) {
  ASSERT_EQ(jnd(run_words("a.study")).exit_code, 0);
  const auto folder = temporary_.path();
  write_file(folder / "changed.json", replaced(kTinyStudy, "[4, 16]", "[5, 15]"));
  const ProgramOutcome study =
      jnd({"run", "changed.json", "--study", "a.study", "--participant", "P02", "--headless"});
  EXPECT_EQ(study.exit_code, 1);
  EXPECT_NE(study.err.find("expected the study file that it was begun with"), std::string::npos)
      << study.err;
  const ProgramOutcome laboratory =
      jnd({"run", "tiny.json", "--study", "a.study", "--participant", "P02", "--headless",
           "--laboratory", "misspecified"});
  EXPECT_EQ(laboratory.exit_code, 1);
  EXPECT_NE(laboratory.err.find("expected the laboratory"), std::string::npos)
      << laboratory.err;
  EXPECT_EQ(opened("a.study").sessions().size(), 1U);
}

TEST_F(RunCommandTest, AnotherWriterIsRefusedAndDisturbsNothing) {
  RunningProgram first(run_words("a.study", "magnitude_of_virtual_water"), options_);
  ASSERT_TRUE(first.read_line());
  const ProgramOutcome second =
      jnd({"run", "tiny.json", "--study", "a.study", "--participant", "P02", "--headless"});
  EXPECT_EQ(second.exit_code, 1);
  EXPECT_NE(second.err.find("another"), std::string::npos) << second.err;
  EXPECT_EQ(first.wait().exit_code, 0);
  EXPECT_EQ(opened("a.study").sessions().size(), 1U);
}

TEST_F(RunCommandTest, PilotsAreLeftOutOfResultsAndExports) {
  ASSERT_EQ(jnd({"run", "tiny.json", "--study", "a.study", "--participant", "pilot",
                 "--headless", "--pilot"})
                .exit_code,
            0);
  const ProgramOutcome none = jnd({"results", "a.study"});
  EXPECT_EQ(none.exit_code, 1);
  EXPECT_NE(none.err.find("none to analyse"), std::string::npos) << none.err;
  ASSERT_EQ(jnd(run_words("a.study")).exit_code, 0);
  EXPECT_EQ(document(jnd({"results", "a.study", "--json"}).out)["num_participants"], 1);
  ASSERT_EQ(jnd({"export", "csv", "a.study", "--out", "without"}).exit_code, 0);
  ASSERT_EQ(jnd({"export", "csv", "a.study", "--out", "with", "--pilot"}).exit_code, 0);
  EXPECT_EQ(read_file(temporary_.path() / "without/trials.csv").find("pilot,"),
            std::string::npos);
  EXPECT_NE(read_file(temporary_.path() / "with/trials.csv").find("pilot,"), std::string::npos);
}

TEST_F(RunCommandTest, AcknowledgesAtOnceAndNotWhenABufferIsFull) {
  // In real time the first stage lasts 20 s. Its beginning has to be printed long before that.
  std::vector<std::string> words = run_words("a.study", "short_tour");
  words.emplace_back("--realtime");
  const auto start = std::chrono::steady_clock::now();
  RunningProgram child(words, options_);
  EXPECT_EQ(child.read_line(), "EVENT 1 session_started");
  EXPECT_TRUE(child.read_line().value_or("").starts_with("EVENT 2 "));
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(8));
  child.send_signal(SIGKILL);
  EXPECT_EQ(child.wait().signal, SIGKILL);
  EXPECT_EQ(jnd({"verify", "a.study"}).exit_code, 0);
  EXPECT_EQ(jnd({"resume", "a.study", "--headless"}).exit_code, 0);
  EXPECT_TRUE(opened("a.study").completed(1));
  EXPECT_EQ(jnd({"verify", "a.study"}).exit_code, 0);
}

TEST_F(RunCommandTest, InterruptedFromTheKeyboardItStopsCleanlyAndCanBeResumed) {
  RunningProgram child(run_words("a.study", "magnitude_of_virtual_water"), options_);
  std::vector<std::string> acknowledged;
  while (acknowledged.size() < 40) {
    const auto line = child.read_line();
    ASSERT_TRUE(line);
    acknowledged.push_back(*line);
  }
  child.send_signal(SIGINT);
  const ProgramOutcome outcome = child.wait();
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_NE(outcome.err.find("jnd resume"), std::string::npos) << outcome.err;
  for (const std::string& line : lines_of(outcome.out)) acknowledged.push_back(line);
  {
    const core::StudyStore store = opened("a.study");
    EXPECT_EQ(check_acknowledged(store, acknowledged), acknowledged.size());
    EXPECT_EQ(store.events(1).back().kind, "paused");
    EXPECT_FALSE(store.finished(1));
  }
  EXPECT_EQ(jnd({"verify", "a.study"}).exit_code, 0);
  EXPECT_EQ(jnd({"resume", "a.study", "--headless"}).exit_code, 0);
  EXPECT_TRUE(opened("a.study").completed(1));
  EXPECT_EQ(jnd({"verify", "a.study"}).exit_code, 0);
}

TEST_F(RunCommandTest, InRealTimeWhatTheLoopWasGivenAndHowPunctualItWasIsKept) {
  write_file(temporary_.path() / "move.json", R"json({
    "format": 1, "name": "move", "languages": ["en"], "title": {"en": "Move"},
    "authors": ["A. Author"],
    "device": {"min_contact_points": 1, "rate_hz": 1000, "ramp_s": 0.05},
    "stages": [{"kind": "explore", "name": "free", "instruction": {"en": "Move."},
                "media": [{"medium": "free_space", "duration_s": 0.3}]}]
  })json");
  const ProgramOutcome outcome = jnd({"run", "move.json", "--study", "a.study", "--participant",
                                      "P01", "--headless", "--realtime"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  std::vector<nlohmann::json> started;
  std::vector<nlohmann::json> measured;
  for (const core::EventRow& event : opened("a.study").events(1)) {
    if (event.kind == "loop_started") started.push_back(nlohmann::json::parse(event.data));
    if (event.kind == "loop_measured") measured.push_back(nlohmann::json::parse(event.data));
  }
  ASSERT_EQ(started.size(), 1U);
  EXPECT_TRUE(started[0]["scheduler"].get<std::string>().starts_with("SCHED_"));
  EXPECT_FALSE(started[0]["cpus"].empty());
  ASSERT_EQ(measured.size(), 1U);
  EXPECT_GE(measured[0]["num_ticks"], 250);
  std::int64_t num_ticks = 0;
  for (const auto& bucket : measured[0]["lateness_ns"]) {
    num_ticks += bucket[1].get<std::int64_t>();
  }
  EXPECT_EQ(num_ticks, measured[0]["num_ticks"]);
}

TEST_F(RunCommandTest, ASessionThatAnOlderProgramBeganGoesOnAsItWouldHave) {
  fs::copy(test_support::source_folder() / "tests/core/storage/layout_1",
           temporary_.path() / "old.study", fs::copy_options::recursive);
  std::string before;
  for (const core::TrialRow& trial : opened("old.study").trials(1)) {
    before += std::to_string(trial.trial) + ":" + std::to_string(trial.response.value()) + " ";
  }
  const ProgramOutcome outcome = jnd({"resume", "old.study", "--headless"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  ASSERT_EQ(jnd(run_words("new.study")).exit_code, 0);
  const core::StudyStore old = opened("old.study");
  EXPECT_TRUE(old.completed(1));
  EXPECT_EQ(difference(design_text(old, 1), design_text(opened("new.study"), 1)), "");
  EXPECT_EQ(difference(stimuli_text(old, 1), stimuli_text(opened("new.study"), 1)), "");
  std::string after;
  for (const core::TrialRow& trial : old.trials(1)) {
    after += std::to_string(trial.trial) + ":" + std::to_string(trial.response.value()) + " ";
  }
  EXPECT_TRUE(after.starts_with(before)) << after;
  EXPECT_EQ(jnd({"verify", "old.study"}).exit_code, 0);
}

TEST_F(RunCommandTest, GuardsAreShadowedOnlyWithoutAWindow) {
  const ProgramOutcome outcome = jnd(
      {"run", "tiny.json", "--study", "s.study", "--participant", "P01", "--shadow-guards"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
  EXPECT_NE(outcome.err.find("--headless"), std::string::npos) << outcome.err;
  EXPECT_FALSE(fs::exists(temporary_.path() / "s.study"));
}

TEST_F(RunCommandTest, NothingToResumeIsOneSentenceAndNoError) {
  ASSERT_EQ(jnd(run_words("a.study")).exit_code, 0);
  const std::string before = tables_text(opened("a.study"), 1);
  for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
           {"resume", "a.study"},
           {"resume", "a.study", "--headless"},
           {"resume", "a.study", "--session", "1", "--headless"}}) {
    const ProgramOutcome outcome = jnd(words);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(lines_of(outcome.out).size(), 1U);
    EXPECT_NE(outcome.out.find("nothing to resume"), std::string::npos);
  }
  EXPECT_EQ(jnd({"resume", "a.study", "--session", "9", "--headless"}).exit_code, 1);
  EXPECT_EQ(difference(tables_text(opened("a.study"), 1), before), "");
}

TEST_F(RunCommandTest, AnOpenSessionNeedsHeadlessToBeResumedAndCanBeEnded) {
  {
    RunningProgram child(run_words("a.study", "magnitude_of_virtual_water"), options_);
    for (int line = 0; line < 60; ++line) ASSERT_TRUE(child.read_line());
    child.send_signal(SIGKILL);
    EXPECT_EQ(child.wait().signal, SIGKILL);
  }
  EXPECT_EQ(jnd({"resume", "a.study"}).exit_code, 3);
  const ProgramOutcome ended = jnd({"resume", "a.study", "--choose", "end", "--headless"});
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_NE(ended.out.find("session 1: ended early, "), std::string::npos) << ended.out;
  const core::StudyStore store = opened("a.study");
  EXPECT_TRUE(store.finished(1));
  EXPECT_FALSE(store.completed(1));
}

TEST_F(RunCommandTest, ItsFilesAreForTheirOwnerAlone) {
  ASSERT_EQ(jnd(run_words("a.study")).exit_code, 0);
  for (const auto& entry : fs::recursive_directory_iterator(temporary_.path() / "a.study")) {
    if (!entry.is_regular_file()) continue;
    EXPECT_EQ(entry.status().permissions() & (fs::perms::group_all | fs::perms::others_all),
              fs::perms::none)
        << entry.path();
  }
}

}  // namespace run_test
}  // namespace jnd::app
