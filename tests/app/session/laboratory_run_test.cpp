#include "app/session/laboratory_run.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <thread>

#include "app/session/session_setup.h"
#include "app/session_content.h"
#include "app/tiny_study.h"
#include "core/error.h"
#include "core/storage/integrity.h"
#include "core/storage/recording.h"
#include "experiments/participants/thesis_laboratory.h"
#include "experiments/protocol/study_reader.h"
#include "experiments/session/event.h"
#include "support/sanitizer.h"
#include "support/temporary_folder.h"

namespace jnd::app {
namespace laboratory_run_test {

namespace fs = std::filesystem;

class LaboratoryRunTest : public ::testing::Test {
 protected:
  [[nodiscard]] fs::path folder(const std::string& name) const {
    return temporary_.path() / (name + ".study");
  }

  /// Returns a store with one session that has not begun.
  [[nodiscard]] std::unique_ptr<core::StudyStore> store_with_session(const std::string& name,
                                                                     bool record = true) {
    auto store = std::make_unique<core::StudyStore>(
        folder(name), core::StudyStore::Mode::kCreate, core::Durability::kAtClose);
    EXPECT_EQ(add_sessions(*store,
                           {.study = study_,
                            .laboratory = &laboratory_,
                            .study_file = "tiny.json",
                            .seed = 5,
                            .record = record},
                           {"P01"}),
              std::vector<std::int64_t>{1});
    return store;
  }

  LaboratoryRunResult run(core::StudyStore& store, LaboratoryRun run) {
    (void)store;
    run.session = 1;
    run.durability = core::Durability::kAtClose;
    return run_laboratory(run);
  }
  LaboratoryRun run_of(core::StudyStore& store) {
    return {.study = study_, .laboratory = laboratory_, .store = store};
  }

  /// Runs the session in a process of its own. The process dies after `num_events` more events,
  /// at once, with all threads and without a destructor. Returns false if the session ended
  /// before.
  bool run_and_die(const std::string& name, std::int64_t num_events,
                   const std::string& choice = "repeat") {
    const pid_t child = ::fork();
    if (child == 0) {
      try {
        core::StudyStore store(folder(name), core::StudyStore::Mode::kReadWrite,
                               core::Durability::kAtClose);
        LaboratoryRun plan = run_of(store);
        plan.choice = choice;
        plan.on_event = [&](const core::EventRow&) {
          if (--num_events == 0) ::_exit(9);
        };
        (void)run(store, plan);
      } catch (...) {
        ::_exit(1);
      }
      ::_exit(0);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) != 1) << num_events;
    return WEXITSTATUS(status) == 9;
  }

  /// Returns a laboratory of hurried persons, so that hundreds of sessions take seconds.
  static experiments::Laboratory hurried_laboratory() {
    experiments::Laboratory laboratory = experiments::thesis_laboratory();
    laboratory.arm.home_s = 0.1;
    for (auto& [procedure, strokes] : laboratory.strokes) {
      strokes.amplitude_m = 0.05;
      strokes.strokes_per_presentation = 1;
    }
    return laboratory;
  }

  test_support::TemporaryFolder temporary_{test_support::memory_folder()};
  experiments::Study study_ = experiments::read_study_text(kTinyStudy, "tiny.json");
  experiments::Laboratory laboratory_ = hurried_laboratory();
};

TEST_F(LaboratoryRunTest, StoresEveryStageEveryTrialAndEverySample) {
  const auto store = store_with_session("whole");
  const LaboratoryRunResult result = run(*store, run_of(*store));
  EXPECT_TRUE(result.ended);
  EXPECT_EQ(result.realtime, "simulated");
  EXPECT_TRUE(store->completed(1));
  EXPECT_EQ(store->trials(1).size(), std::size_t{kTinyTrials});
  EXPECT_EQ(store->answers(1).size(), 3U);
  const core::Integrity integrity = core::verify(*store);
  EXPECT_TRUE(integrity.complete);
  EXPECT_TRUE(integrity.remarks.empty());
  EXPECT_EQ(integrity.num_samples, result.num_ticks);
}

TEST_F(LaboratoryRunTest, TheSameSeedGivesTheSameSessionToTheLastSample) {
  const auto first = store_with_session("first");
  const auto second = store_with_session("second");
  (void)run(*first, run_of(*first));
  (void)run(*second, run_of(*second));
  EXPECT_EQ(difference(tables_text(*first, 1), tables_text(*second, 1)), "");
  EXPECT_EQ(difference(samples_text(*first, 1), samples_text(*second, 1)), "");
}

TEST_F(LaboratoryRunTest, AnswersAreTheSameWhetherSamplesAreKeptOrNot) {
  const auto full = store_with_session("full");
  const auto fast = store_with_session("fast", /*record=*/false);
  (void)run(*full, run_of(*full));
  (void)run(*fast, run_of(*fast));
  EXPECT_EQ(difference(tables_text(*full, 1), tables_text(*fast, 1)), "");
  EXPECT_FALSE(fs::exists(fast->recording_file(1)));
}

TEST_F(LaboratoryRunTest, AskedToStopItDoesSoInTheMiddleOfAPresentationAndIsResumed) {
  const auto store = store_with_session("stopped");
  LaboratoryRun stopping = run_of(*store);
  bool felt = false;
  stopping.on_event = [&](const core::EventRow& event) {
    felt = event.kind == "presentation_started" && event.trial == 2;
  };
  stopping.is_cancelled = [&] { return felt; };
  EXPECT_FALSE(run(*store, stopping).ended);
  const std::vector<core::EventRow> events = store->events(1);
  EXPECT_EQ(events[events.size() - 2].kind, "presentation_started");
  EXPECT_EQ(events.back().kind, "paused");
  EXPECT_TRUE(run(*store, run_of(*store)).ended);
  EXPECT_TRUE(store->completed(1));
  EXPECT_TRUE(core::verify(*store).complete);
}

TEST_F(LaboratoryRunTest, AskedToStopInRealTimeItTakesTheMediumAwayBeforeItWaitsForTheDisk) {
  const auto store = store_with_session("slow");
  LaboratoryRun to_viscous = run_of(*store);
  int num_answers = 0;
  to_viscous.on_event = [&](const core::EventRow& event) {
    num_answers += event.kind == "trial_answered" ? 1 : 0;
  };
  to_viscous.is_cancelled = [&] { return num_answers == 6; };
  EXPECT_FALSE(run(*store, to_viscous).ended);

  LaboratoryRun stopping = run_of(*store);
  stopping.realtime = true;
  bool presenting = false;
  bool cancelled = false;
  int num_glances = 0;
  stopping.on_event = [&](const core::EventRow& event) {
    presenting |= event.kind == "presentation_started";
    // The pause is somewhat longer than a ramp, and shorter than the heartbeat may be silent.
    if (cancelled && event.kind == "loop_measured") {
      std::this_thread::sleep_for(std::chrono::milliseconds(120));
    }
  };
  stopping.is_cancelled = [&] {
    num_glances += presenting ? 1 : 0;
    cancelled |= num_glances > 20;
    return cancelled;
  };
  EXPECT_FALSE(run(*store, stopping).ended);
  EXPECT_EQ(store->events(1).back().kind, "paused");
  const core::RecordingReader recording(store->recording_file(1));
  const std::int64_t last_tick = recording.last_tick();
  bool felt = false;
  recording.read(last_tick - 400, last_tick, [&](const core::Sample& sample) {
    const bool has_force = sample.tip_force_n != decltype(sample.tip_force_n){};
    felt |= has_force;
    EXPECT_EQ(sample.fault, 0);
    if (sample.tick == last_tick) {
      EXPECT_FALSE(has_force);
    }
  });
  EXPECT_TRUE(felt);
}

TEST_F(LaboratoryRunTest, AStageThatWasInterruptedGoesOnWithItsNextMedium) {
  study_ = experiments::read_study_text(
      replaced(kTinyStudy, R"({"medium": "free_space", "duration_s": 0.5})",
               R"({"medium": "free_space", "duration_s": 0.5},
                  {"medium": "water", "scale": 2, "duration_s": 0.5})"),
      "tiny.json");
  const auto store = store_with_session("interrupted");
  LaboratoryRun stopping = run_of(*store);
  bool explored = false;
  stopping.on_event = [&](const core::EventRow& event) {
    explored |= event.kind == "medium_explored";
  };
  stopping.is_cancelled = [&] { return explored; };
  EXPECT_FALSE(run(*store, stopping).ended);
  EXPECT_TRUE(run(*store, run_of(*store)).ended);
  int num_explored = 0;
  for (const core::EventRow& event : store->events(1)) {
    num_explored += event.kind == "medium_explored" ? 1 : 0;
  }
  EXPECT_EQ(num_explored, 2);
}

TEST_F(LaboratoryRunTest, KilledAfterAnyEventItResumesToTheSameOrderAndStimuli) {
  const auto whole = store_with_session("whole");
  (void)run(*whole, run_of(*whole));
  const std::string design = design_text(*whole, 1);
  const std::string stimuli = stimuli_text(*whole, 1);
  const auto num_events = static_cast<std::int64_t>(whole->events(1).size());
  constexpr std::int64_t kStride = test_support::kIsSanitized ? 20 : 1;
  for (std::int64_t killed_after = 1; killed_after <= num_events; killed_after += kStride) {
    const std::string name = "killed" + std::to_string(killed_after);
    store_with_session(name).reset();
    ASSERT_TRUE(run_and_die(name, killed_after));
    core::StudyStore store(folder(name), core::StudyStore::Mode::kReadWrite,
                           core::Durability::kAtClose);
    ASSERT_EQ(store.events(1).size(), static_cast<std::size_t>(killed_after));
    const std::vector<core::TrialRow> answered = store.trials(1);
    const core::Integrity before = core::verify(store);
    EXPECT_TRUE(before.complete) << killed_after << ": " << before.problems.front().message;
    if (store.finished(1)) continue;
    EXPECT_TRUE(run(store, run_of(store)).ended) << killed_after;
    EXPECT_TRUE(store.completed(1)) << killed_after;
    EXPECT_EQ(difference(design_text(store, 1), design), "") << killed_after;
    EXPECT_EQ(difference(stimuli_text(store, 1), stimuli), "") << killed_after;
    const core::Integrity after = core::verify(store);
    EXPECT_TRUE(after.complete) << killed_after << ": " << after.problems.front().message;
    // The answers that had been given stand as they were.
    const std::vector<core::TrialRow> trials = store.trials(1);
    ASSERT_GE(trials.size(), answered.size());
    for (std::size_t i = 0; i < answered.size(); ++i) {
      EXPECT_EQ(trials[i].sequence, answered[i].sequence) << killed_after;
      EXPECT_EQ(trials[i].response, answered[i].response) << killed_after;
    }
    fs::remove_all(folder(name));
  }
}

TEST_F(LaboratoryRunTest, KilledAgainAndAgainItStillEnds) {
  const auto whole = store_with_session("whole");
  (void)run(*whole, run_of(*whole));
  store_with_session("often").reset();
  int deaths = 0;
  while (run_and_die("often", 45)) {
    ASSERT_LT(++deaths, 60) << "a resumed session has to get ahead";
  }
  EXPECT_GT(deaths, 1);
  const core::StudyStore store(folder("often"), core::StudyStore::Mode::kReadOnly);
  EXPECT_TRUE(store.completed(1));
  EXPECT_EQ(difference(design_text(store, 1), design_text(*whole, 1)), "");
  EXPECT_EQ(difference(stimuli_text(store, 1), stimuli_text(*whole, 1)), "");
  EXPECT_TRUE(core::verify(store).complete);
}

TEST_F(LaboratoryRunTest, ARestartedBlockIsRunAgainInTheSameOrder) {
  const auto whole = store_with_session("whole");
  (void)run(*whole, run_of(*whole));
  // The process dies in the middle of the comparison.
  std::int64_t middle = 0;
  for (const core::TrialRow& trial : whole->trials(1)) {
    if (trial.trial == 8) middle = trial.sequence + 1;
  }
  store_with_session("restarted").reset();
  ASSERT_TRUE(run_and_die("restarted", middle));
  core::StudyStore store(folder("restarted"), core::StudyStore::Mode::kReadWrite,
                         core::Durability::kAtClose);
  LaboratoryRun plan = run_of(store);
  plan.choice = "restart";
  EXPECT_TRUE(run(store, plan).ended);
  EXPECT_EQ(difference(design_text(store, 1), design_text(*whole, 1)), "");
  EXPECT_EQ(difference(stimuli_text(store, 1), stimuli_text(*whole, 1)), "");
  for (const core::TrialRow& trial : store.trials(1)) {
    // Trials 7 and 8 had been answered, and trial 9 was being felt.
    EXPECT_EQ(trial.attempt, trial.trial >= 7 && trial.trial <= 9 ? 2 : 1) << trial.trial;
  }
}

TEST_F(LaboratoryRunTest, AnInterruptedSessionCanBeEndedAndKeepsItsAnswers) {
  store_with_session("ended").reset();
  ASSERT_TRUE(run_and_die("ended", 30));
  core::StudyStore store(folder("ended"), core::StudyStore::Mode::kReadWrite,
                         core::Durability::kAtClose);
  const std::size_t answered = store.trials(1).size();
  ASSERT_GT(answered, 0U);
  LaboratoryRun plan = run_of(store);
  plan.choice = "end";
  EXPECT_TRUE(run(store, plan).ended);
  EXPECT_TRUE(store.finished(1));
  EXPECT_FALSE(store.completed(1));
  EXPECT_EQ(store.trials(1).size(), answered);
  EXPECT_TRUE(core::verify(store).complete);
}

TEST_F(LaboratoryRunTest, ACancelledSessionIsPausedAndCanBeResumed) {
  const auto whole = store_with_session("whole");
  (void)run(*whole, run_of(*whole));
  const auto store = store_with_session("cancelled");
  LaboratoryRun plan = run_of(*store);
  int num_trials = 0;
  plan.on_event = [&](const core::EventRow& event) {
    if (event.kind == "trial_answered") ++num_trials;
  };
  plan.is_cancelled = [&] { return num_trials == 3; };
  EXPECT_FALSE(run(*store, plan).ended);
  EXPECT_EQ(store->events(1).back().kind, "paused");
  EXPECT_EQ(store->trials(1).size(), 3U);
  EXPECT_TRUE(core::verify(*store).complete);
  EXPECT_TRUE(run(*store, run_of(*store)).ended);
  EXPECT_EQ(difference(design_text(*store, 1), design_text(*whole, 1)), "");
  EXPECT_EQ(difference(stimuli_text(*store, 1), stimuli_text(*whole, 1)), "");
}

TEST_F(LaboratoryRunTest, TimesOfEventsNeverRunBackwardsAcrossAResumption) {
  store_with_session("times").reset();
  ASSERT_TRUE(run_and_die("times", 40));
  core::StudyStore store(folder("times"), core::StudyStore::Mode::kReadWrite,
                         core::Durability::kAtClose);
  EXPECT_TRUE(run(store, run_of(store)).ended);
  std::int64_t last_ns = 0;
  for (const core::EventRow& event : store.events(1)) {
    EXPECT_GE(event.time_ns, last_ns) << event.sequence << ' ' << event.kind;
    last_ns = event.time_ns;
  }
}

TEST_F(LaboratoryRunTest, TicksCountOnAcrossAResumptionWhetherSamplesAreKeptOrNot) {
  for (const bool record : {true, false}) {
    const std::string name = record ? "recorded" : "summaries";
    store_with_session(name, record).reset();
    ASSERT_TRUE(run_and_die(name, 40));
    core::StudyStore store(folder(name), core::StudyStore::Mode::kReadWrite,
                           core::Durability::kAtClose);
    EXPECT_TRUE(run(store, run_of(store)).ended);
    std::int64_t last_tick = -1;
    for (const core::PresentationRow& row : store.presentations(1)) {
      EXPECT_GT(row.first_tick, last_tick) << name << ' ' << row.trial;
      EXPECT_GT(row.last_tick, row.first_tick) << name << ' ' << row.trial;
      last_tick = row.last_tick;
    }
  }
}

TEST_F(LaboratoryRunTest, GoesOnAfterADeathWhileTheRecordingWasBeingMade) {
  // The file exists, but the process died before it had written anything into it.
  store_with_session("empty").reset();
  write_file(folder("empty") / "recordings" / "0001.sqlite", "");
  core::StudyStore store(folder("empty"), core::StudyStore::Mode::kReadWrite,
                         core::Durability::kAtClose);
  EXPECT_TRUE(core::verify(store).complete);
  EXPECT_TRUE(run(store, run_of(store)).ended);
  EXPECT_TRUE(core::verify(store).complete);
}

TEST_F(LaboratoryRunTest, AParticipantJudgesWhatWasDeliveredNotWhatWasAskedFor) {
  // At 16 Pa s the limiter cuts the force, so the delivered damping is below the commanded one.
  const auto free = store_with_session("free");
  (void)run(*free, run_of(*free));
  laboratory_.device.max_total_force_n = 0.8;
  const auto limited = store_with_session("limited");
  (void)run(*limited, run_of(*limited));
  EXPECT_EQ(difference(design_text(*free, 1), design_text(*limited, 1)), "");
  const auto a = free->presentations(1);
  const auto b = limited->presentations(1);
  int num_compared = 0;
  for (const core::PresentationRow& row : b) {
    if (row.interval != "test" || row.trial < 7 || row.intensity != 16.0) continue;
    ++num_compared;
    EXPECT_GT(row.measures.limited_ticks, 0);
    EXPECT_LT(row.measures.delivered_damping_n_s_per_m.value(),
              0.8 * row.measures.commanded_damping_n_s_per_m.value());
  }
  EXPECT_GT(num_compared, 0);
  for (const core::PresentationRow& row : a) {
    if (row.trial < 7 || row.intensity != 4.0) continue;
    EXPECT_NEAR(row.measures.delivered_damping_n_s_per_m.value() /
                    row.measures.commanded_damping_n_s_per_m.value(),
                1.0, 0.05);
  }
}

TEST_F(LaboratoryRunTest, RefusesASessionThatIsNotInTheStore) {
  const auto store = store_with_session("known");
  LaboratoryRun plan = run_of(*store);
  plan.session = 7;
  EXPECT_THROW((void)run_laboratory(plan), core::Error);
}

/// Returns faults that delay the loop at these ticks, each time by `s` seconds.
std::vector<device::ScheduledFault> stalls(const std::vector<std::int64_t>& ticks, double s) {
  std::vector<device::ScheduledFault> faults;
  for (const std::int64_t tick : ticks) {
    faults.push_back(
        {.first_tick = tick, .injection = device::Injection::kStall, .magnitude = s});
  }
  return faults;
}

// The limit allows more missed ticks than a busy machine causes by itself. The stalls in the
// first presentation exceed it, and two attempts are left for whatever else may go wrong.
TEST_F(LaboratoryRunTest, ATrialWithTooManyMissedTicksIsRepeated) {
  study_.device.max_missed_ratio = 0.25;
  const auto store = store_with_session("missed");
  LaboratoryRun held_up = run_of(*store);
  held_up.realtime = true;
  bool answered = false;
  held_up.injected_faults = stalls({900, 950, 1000, 1050, 1100, 1150, 1200, 1250}, 0.08);
  held_up.is_cancelled = [&] { return answered; };
  held_up.on_event = [&](const core::EventRow& event) {
    answered |= event.kind == "trial_answered";
  };
  EXPECT_FALSE(run(*store, held_up).ended);
  int num_discarded = 0;
  for (const core::EventRow& event : store->events(1)) {
    if (event.kind != "attempt_discarded") continue;
    ++num_discarded;
    EXPECT_NE(event.data.find("missed ticks: "), std::string::npos) << event.data;
  }
  EXPECT_GE(num_discarded, 1);
  ASSERT_EQ(store->trials(1).size(), 1U);
  for (const core::PresentationRow& row : store->presentations(1)) {
    EXPECT_LE(row.measures.missed_ticks, (row.last_tick - row.first_tick + 1) / 4);
  }
  const core::Integrity integrity = core::verify(*store);
  EXPECT_TRUE(integrity.complete);
  EXPECT_FALSE(integrity.remarks.empty()) << "ticks of a presentation never ran";
}

TEST_F(LaboratoryRunTest, AMachineThatNeverKeepsItsTimeEndsTheRun) {
  const auto store = store_with_session("held_up");
  LaboratoryRun held_up = run_of(*store);
  held_up.realtime = true;
  std::vector<std::int64_t> ticks;
  for (std::int64_t tick = 300; tick < 100'000; tick += 300) ticks.push_back(tick);
  held_up.injected_faults = stalls(ticks, 0.1);
  try {
    (void)run(*store, held_up);
    ADD_FAILURE() << "it went on and on";
  } catch (const core::Error& error) {
    EXPECT_NE(std::string(error.what()).find("three attempts in a row"), std::string::npos)
        << error.what();
  }
  EXPECT_TRUE(store->trials(1).empty());
  EXPECT_FALSE(store->finished(1));
}

TEST_F(LaboratoryRunTest, ASessionEndsItsTrialsWhereItsExposureIsReached) {
  study_.session_limits.max_under_force_s = 8.0;
  const auto store = store_with_session("exposed");
  for (int i = 0; i < 2; ++i) {
    try {
      (void)run(*store, run_of(*store));
      ADD_FAILURE() << "it went on";
    } catch (const core::Error& error) {
      EXPECT_NE(std::string(error.what()).find("min under force, of at most 0.1"),
                std::string::npos)
          << error.what();
    }
  }
  EXPECT_FALSE(store->finished(1)) << "it can be ended, or looked at, by a person";
  double under_force_s = 0.0;
  for (const core::EventRow& row : store->events(1)) {
    const experiments::Event event = experiments::event_from_row(row);
    const auto* ended = std::get_if<experiments::PresentationEnded>(&event.data);
    if (ended != nullptr) under_force_s += ended->summary.exposure.value().under_force_s;
    const auto* told = std::get_if<experiments::ExposureTold>(&event.data);
    if (told != nullptr) under_force_s += told->exposure.under_force_s;
  }
  EXPECT_GE(under_force_s, 8.0);
  EXPECT_LT(under_force_s, 20.0) << "no more than the trial under way";
  EXPECT_GE(store->trials(1).size(), 1u) << "what was answered is kept";
}

}  // namespace laboratory_run_test
}  // namespace jnd::app
