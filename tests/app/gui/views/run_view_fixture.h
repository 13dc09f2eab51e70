#pragma once

#include <gtest/gtest.h>

#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "app/gui/headless_ui.h"
#include "app/gui/views/run_view.h"

// Draws the view of a running session without a session, from views that the test makes, and
// presses keys as a person would.

namespace jnd::app::gui {

using experiments::AnswerKind;

/// Returns a view in which the test fluid of a comparison is being felt, after the reference.
inline SessionView comparison() {
  SessionView view{.study = "Viscosity discrimination",
                   .participant = "P07",
                   .device = "lumped",
                   .language = "en"};
  view.step = Step::kPresenting;
  view.heading = "Test fluid";
  view.sentence = "Show one finger. At the ready sign, ask:";
  view.say = "Does this feel thicker than the reference?";
  view.sign = HandSign::kOneFinger;
  view.participant_text = view.say;
  for (const char* title : {"Checklist", "Consent", "Group D", "Break", "Group E"}) {
    view.stages.push_back({.title = title});
  }
  view.stages[2].status = StageLine::Status::kNow;
  view.stage = 2;
  view.trial = TrialView{.trial = 23,
                         .in_block = 23,
                         .num_in_block = 40,
                         .repetition = 3,
                         .num_repetitions = 5,
                         .answer = AnswerKind::kYesNo,
                         .has_reference = true,
                         .interval = "test",
                         .felt_s = 6.4,
                         .num_strokes = 3,
                         .first_felt_s = 8.1,
                         .can_answer = true,
                         .question = view.say,
                         .yes_label = "Thicker",
                         .no_label = "Not thicker",
                         .level = "1.65 Pa s, reference 1.85 Pa s"};
  for (int i = 22; i > 12; --i) {
    view.answers.push_back({.trial = i,
                            .in_block = i,
                            .block = "Group D",
                            .answer = "Thicker",
                            .response_time_s = 4.2,
                            .can_undo = i == 22});
  }
  view.trials_on_disk = 22;
  view.last_sequence = 180;
  view.loop = {.rate_hz = 1000, .lateness_p99_us = 0.03, .scheduler = "SCHED_FIFO 80"};
  view.max_total_force_n = 30;
  view.telemetry.sample.attached_bits = 31;
  view.telemetry.total_force_n = {3.0, 4.0, 0.0};
  return view;
}

inline SessionView estimation() {
  SessionView view = comparison();
  view.trial->answer = AnswerKind::kPercent;
  view.trial->has_reference = false;
  return view;
}

inline SessionView production() {
  SessionView view = comparison();
  view.trial->answer = AnswerKind::kMatch;
  view.trial->has_reference = false;
  view.trial->adjustable = true;
  view.trial->target_percent = 100;
  return view;
}

inline SessionView item_of(ItemView item) {
  SessionView view = comparison();
  view.trial.reset();
  view.step = Step::kItem;
  view.heading = "Questions";
  view.sentence = item.text;
  view.item = std::move(item);
  return view;
}

class RunViewTest : public ::testing::Test {
 protected:
  std::vector<OperatorRequest> draw(const SessionView& view) {
    std::vector<OperatorRequest> requests;
    ui_.frame([&](Ui& ui) {
      last_ = draw_run_view(ui, view, trace_, after_, state_);
      requests.insert(requests.end(), last_.requests.begin(), last_.requests.end());
      stopped_ |= last_.stop;
    });
    return requests;
  }
  /// Returns the one request to which a key leads.
  template <typename Request>
  Request after_key(const SessionView& view, const Chord& key) {
    draw(view);
    ui_.press(key);
    return only<Request>(draw(view));
  }
  template <typename Request>
  Request after_click(const SessionView& view, std::string_view widget) {
    draw(view);
    ui_.click(widget);
    return only<Request>(draw(view));
  }
  template <typename Request>
  static Request only(const std::vector<OperatorRequest>& requests) {
    EXPECT_EQ(requests.size(), 1U);
    if (requests.size() != 1 || !std::holds_alternative<Request>(requests[0])) {
      ADD_FAILURE() << "another request";
      return {};
    }
    return std::get<Request>(requests[0]);
  }

  HeadlessUi ui_;
  RunViewState state_;
  AfterSession after_;
  std::vector<TracePoint> trace_;
  RunViewResult last_;
  bool stopped_ = false;
};

}  // namespace jnd::app::gui
