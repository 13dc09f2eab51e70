#pragma once

#include <gtest/gtest.h>
#include <algorithm>

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "app/operator/live_trace.h"
#include "app/operator/operated_session.h"
#include "app/operator/scope_trace.h"
#include "app/session/session_setup.h"
#include "app/session/stored_session.h"
#include "app/tiny_study.h"
#include "experiments/participants/thesis_laboratory.h"
#include "experiments/protocol/study_reader.h"
#include "support/temporary_folder.h"

namespace jnd::app {

/// Plays an operator at the simulated hand in simulated time. A key press is a request, and
/// what the operator sees is a view.
class OperatedSessionTest : public ::testing::Test {
 protected:
  /// Makes a new folder with one session and opens the session.
  void open(const std::string& study_text = kTinyStudy) {
    study_ = std::make_unique<experiments::Study>(experiments::read_study_text(
        may_miss_ticks_
            ? replaced(study_text, "\"device\": {", "\"device\": {\"max_missed_ratio\": 1, ")
            : study_text,
        "study.json"));
    store_ = std::make_unique<core::StudyStore>(folder_, core::StudyStore::Mode::kCreate,
                                                core::Durability::kAtClose);
    session_number_ = add_sessions(*store_,
                                   {.study = *study_,
                                    .laboratory = &laboratory_,
                                    .study_file = "study.json",
                                    .device = device_,
                                    .profile = profile_.text.empty() ? nullptr : &profile_,
                                    .seed = 7},
                                   {"P01"})
                          .front();
    reopen();
  }

  /// Reopens the session from its log, as a restarted program does, on a device that has these
  /// faults.
  void reopen(const std::vector<device::ScheduledFault>& faults = {}) {
    session_.reset();
    session_ = std::make_unique<OperatedSession>(
        OperatedSession::Parameters{.store = *store_,
                                    .session = session_number_,
                                    .study = *study_,
                                    .laboratory = &laboratory_,
                                    .exchange = exchange_,
                                    .trace = &trace_,
                                    .scopes = &scopes_,
                                    .fitting = fitting_,
                                    .realtime = realtime_,
                                    .allow_no_realtime = true,
                                    .stops = stops_,
                                    .injected_faults = faults,
                                    .sound = sound_,
                                    .on_sample = on_sample_,
                                    .asks_about_answers = asks_about_answers_});
    pass(0.1);
  }

  /// Lets time pass while the session advances in small steps, as it does beside a window.
  void pass(double duration_s) {
    constexpr double kGlanceS = 0.010;
    for (double passed_s = 0.0; passed_s < duration_s; passed_s += kGlanceS) {
      session_->advance(kGlanceS);
    }
  }

  /// Carries out the request. Returns the view after it.
  SessionView act(OperatorRequest request) {
    session_->request(std::move(request));
    pass(0.01);
    return session_->view();
  }

  SessionView view() const { return session_->view(); }

  /// Begins the session and answers everything before the first trial of this block.
  SessionView run_to_block(const std::string& block) {
    if (view().step == Step::kBegin) act(operate::Begin{});
    for (int guard = 0; guard < 1000; ++guard) {
      const SessionView now = view();
      if (now.step == Step::kFinished) break;
      if (now.trial && study_stage_name(now.stage) == block) return now;
      step_on(now);
    }
    ADD_FAILURE() << "never came to " << block;
    return view();
  }

  /// Gives some answer to whatever is asked.
  void step_on(const SessionView& now) {
    switch (now.step) {
      case Step::kItem:
        act(operate::AnswerItem{now.stage, now.item->name, "1.8"});
        break;
      case Step::kMedium:
        act(operate::FeelMedium{});
        pass(0.5);
        break;
      case Step::kFeeling:
        if (now.item) {
          act(operate::AnswerItem{now.stage, now.item->name, "yes"});
        } else {
          act(operate::FinishMedium{});
        }
        break;
      case Step::kBreak:
        pass(now.break_left_s + 0.1);
        act(operate::FinishStage{now.stage, ""});
        break;
      case Step::kStageDone:
        act(operate::FinishStage{now.stage, ""});
        break;
      case Step::kRest:
        pass(now.trial->rest_left_s + 0.01);
        break;
      case Step::kReady:
      case Step::kPresenting:
        answer_trial(now, 1.0);
        break;
      default:
        FAIL() << "nothing to do in step " << static_cast<int>(now.step);
    }
  }

  void answer_trial(const SessionView& now, double value) {
    const std::int64_t trial = now.trial->trial;
    if (now.trial->has_reference) {
      act(operate::Present{trial, "reference"});
      pass(1.0);
    }
    act(operate::Present{trial, "test"});
    pass(1.0);
    act(operate::Answer{trial, value});
  }

  /// Expects that a postponed trial is not the next one. When the rest of its block is
  /// answered, it is stored once, as its second attempt.
  void expect_it_comes_later(std::int64_t put_off) {
    EXPECT_NE(view().trial->trial, put_off) << "not right after half of it was felt";
    while (view().step == Step::kReady) answer_trial(view(), 1.0);
    const std::vector<core::TrialRow> rows = store_->trials(session_number_);
    const auto found = std::ranges::find(rows, put_off, &core::TrialRow::trial);
    ASSERT_NE(found, rows.end());
    EXPECT_EQ(found->attempt, 2);
    EXPECT_EQ(std::ranges::count(rows, put_off, &core::TrialRow::trial), 1);
  }

  std::string study_stage_name(std::int64_t stage) const {
    const auto stages = stages_of_session(*study_, store_->session(session_number_).cells);
    return stages.at(static_cast<std::size_t>(stage))->name;
  }

  std::vector<std::string> kinds() const {
    std::vector<std::string> all;
    for (const core::EventRow& event : store_->events(session_number_)) {
      all.push_back(event.kind);
    }
    return all;
  }

  test_support::TemporaryFolder temporary_{test_support::memory_folder()};
  std::filesystem::path folder_ = temporary_.path() / "a.study";
  experiments::Laboratory laboratory_ = experiments::thesis_laboratory();
  OperatorExchange exchange_;
  LiveTrace trace_{LiveTrace::Parameters{}};
  ScopeTrace scopes_{ScopeTrace::Parameters{}};
  std::unique_ptr<experiments::Study> study_;
  std::unique_ptr<core::StudyStore> store_;
  std::int64_t session_number_ = 0;
  /// The device of sessions that are opened from now on. The following fields hold for them,
  /// too.
  std::string device_ = "lumped";
  KnownProfile profile_;  ///< A profile without a text means that there is none.
  std::map<std::string, std::string> fitting_;
  bool realtime_ = false;
  /// Off by default, because tests answer sooner than any person.
  bool asks_about_answers_ = false;
  /// On by default, because the speed of the machine must not decide a test in real time.
  bool may_miss_ticks_ = true;
  SoundChoice sound_;  ///< The sound of a study that has sound.
  /// The folder in which stops are remembered, or "" for nowhere.
  std::filesystem::path stops_;
  std::function<void(const core::Sample&)> on_sample_;
  std::unique_ptr<OperatedSession> session_;
};

}  // namespace jnd::app
