#include "app/window/pictures_fixture.h"

namespace jnd::app {
namespace task_pictures_test {

/// A study with blocks of several tasks, with few trials each, after a question about
/// handedness, over which the arms are balanced.
const std::string kTasks = R"json({
  "format": 1, "name": "tasks", "languages": ["en"], "title": {"en": "Every task"},
  "authors": ["A. Author"], "blinding": "none",
  "device": {"min_contact_points": 1, "rate_hz": 1000, "ramp_s": 0.05, "max_missed_ratio": 1.0},
  "participant_fields": [
    {"name": "handedness", "question": {"en": "Which hand do you use for most things?"},
     "options": [{"value": "right", "label": {"en": "the right"}},
                 {"value": "left", "label": {"en": "the left"}},
                 {"value": "both", "label": {"en": "both alike"}}]}],
  "stages": [
    {"kind": "counterbalance", "name": "priming", "method": "one_of",
     "stratify_by": "handedness",
     "arms": [{"name": "plain", "stages": []},
              {"name": "rested", "stages": [
                {"kind": "break", "name": "rest", "instruction": {"en": "Rest."}, "duration_s": 1}]}]},
    {"kind": "block", "name": "practice", "title": {"en": "Practice"},
     "procedure": "constant_stimuli", "medium": "viscous", "task": "two_interval",
     "feedback": true,
     "practice": {"min_correct_ratio": 0.5, "num_trials_judged": 2, "max_trials": 4},
     "viscosity_pa_s": [4, 16], "reference_viscosity_pa_s": 8, "repetitions": 2,
     "free_space_between_s": 0, "instruction": {"en": "Let us practise with fluids that differ a lot."},
     "question": {"en": "Which of the two was thicker?"},
     "first_label": {"en": "The first"}, "second_label": {"en": "The second"}, "expected_trial_s": 5},
    {"kind": "block", "name": "two_tracks", "title": {"en": "Two staircases"},
     "procedure": "staircase", "medium": "viscous", "task": "two_interval",
     "interval_order": "random", "feedback": true, "reference_viscosity_pa_s": 3,
     "start_viscosity_pa_s": [5.4, 4], "lowest_viscosity_pa_s": 3.06,
     "highest_viscosity_pa_s": 6.6, "level_scale": "logarithmic", "step_ratio": [1.25],
     "num_up": 1, "num_down": 2, "max_reversals": 100, "max_trials": 4,
     "num_reversals_averaged": 2, "free_space_between_s": 0,
     "instruction": {"en": "Two fluids follow each other. You may go back and forth."},
     "question": {"en": "Which of the two was thicker?"},
     "first_label": {"en": "The first"}, "second_label": {"en": "The second"}, "expected_trial_s": 5},
    {"kind": "block", "name": "detection", "title": {"en": "Is there a fluid?"},
     "procedure": "limits", "medium": "viscous", "task": "yes_no",
     "viscosity_pa_s": [0.05, 0.5, 5], "num_series": 2,
     "instruction": {"en": "Move your hand and tell whether you feel a fluid."},
     "question": {"en": "Do you feel a fluid?"}, "yes_label": {"en": "Yes"},
     "no_label": {"en": "No"}, "free_space_between_s": 0, "expected_trial_s": 5},
    {"kind": "block", "name": "pairs", "title": {"en": "Same or different"},
     "procedure": "constant_stimuli", "medium": "solid", "task": "same_different",
     "interval_order": "balanced", "stiffness_n_per_m": [150, 560],
     "reference_stiffness_n_per_m": 290, "repetitions": 2, "free_space_between_s": 0,
     "instruction": {"en": "Press the surface a few times. Then comes the other one."},
     "question": {"en": "Were they the same or different?"},
     "yes_label": {"en": "Different"}, "no_label": {"en": "The same"}, "expected_trial_s": 5},
    {"kind": "block", "name": "odd", "title": {"en": "Which is the odd one"},
     "procedure": "constant_stimuli", "medium": "viscous", "task": "oddity", "feedback": true,
     "viscosity_pa_s": [16], "reference_viscosity_pa_s": 8, "repetitions": 2,
     "free_space_between_s": 0,
     "instruction": {"en": "Three fluids follow each other. One is unlike the other two."},
     "question": {"en": "Which was the odd one?"}, "expected_trial_s": 5},
    {"kind": "block", "name": "matching", "title": {"en": "Match it"},
     "procedure": "matching", "medium": "viscous", "viscosity_pa_s": [0.5, 28],
     "standard_medium": "viscous", "standard_viscosity_pa_s": [8],
     "coarse_step_viscosity_pa_s": 1, "fine_step_viscosity_pa_s": 0.25,
     "max_viscosity_pa_s": 30, "repetitions": 1, "free_space_between_s": 0,
     "instruction": {"en": "Say thicker or thinner until both feel the same."},
     "question": {"en": "Does it feel as thick as the standard?"}, "expected_trial_s": 5},
    {"kind": "interleaved", "name": "mixed", "title": {"en": "Two references mixed"},
     "turns": "rounds", "blocks": [
       {"kind": "block", "name": "thin", "title": {"en": "A thin reference"},
        "procedure": "constant_stimuli", "medium": "viscous", "task": "two_interval",
        "viscosity_pa_s": [1, 4], "reference_viscosity_pa_s": 2, "repetitions": 1,
        "free_space_between_s": 0,
        "instruction": {"en": "Two fluids follow each other. You may go back and forth."},
        "question": {"en": "Which of the two was thicker?"},
        "first_label": {"en": "The first"}, "second_label": {"en": "The second"}, "expected_trial_s": 5},
       {"kind": "block", "name": "thick", "title": {"en": "A thick reference"},
        "procedure": "constant_stimuli", "medium": "viscous", "task": "two_interval",
        "viscosity_pa_s": [4, 16], "reference_viscosity_pa_s": 8, "repetitions": 1,
        "free_space_between_s": 0,
        "instruction": {"en": "Two fluids follow each other. You may go back and forth."},
        "question": {"en": "Which of the two was thicker?"},
        "first_label": {"en": "The first"}, "second_label": {"en": "The second"}, "expected_trial_s": 5}]}
  ]})json";

class TaskPicturesTest : public PicturesWindowTest {
 protected:
  /// Takes a picture of the card and does what the card asks for. Returns false at the end.
  bool step_on(int number) {
    static const std::vector<std::string> kCards = {
        "begin",   "finish_break", "answer_first", "answer_yes",
        "matches", "present",      "finish_stage", "to_results"};
    const std::string name =
        "task-" + std::string(number < 10 ? "0" : "") + std::to_string(number);
    std::string card;
    const Screen now = window_->wait_until("a card", [&](const Screen& at) {
      card.clear();
      for (const std::string& one : kCards) {
        if (card.empty() && at.offers(one)) card = one;
      }
      return !card.empty();
    });
    take(name + '-' + card, 1);
    if (card == "to_results") return false;
    window_->use(card);
    if (card == "finish_break" && window_->screen().shows("Go on before")) {
      window_->type("enough");
      window_->press("Return");
    }
    window_->wait_until("the next card",
                        [&](const Screen& at) { return words_of(at) != words_of(now); });
    return true;
  }
};

TEST_F(TaskPicturesTest, OfEveryTask) {
  write_file(path("study.json"), kTasks);
  window_->start({"run", path("study.json").string(), "--study", path("tasks.study").string(),
                  "--participant", "P07", "--device", "lumped", "--seed", "7"});
  window_->wait_for("field_handedness_right");
  take("task-prepare", 1);
  window_->use("field_handedness_right");
  window_->wait_for("start_session");
  take("task-prepare-known", 1);
  window_->use("real_session");
  window_->use("start_session");
  for (int number = 1; step_on(number); ++number) ASSERT_LT(number, 110);
  window_->wait_for_text("complete");
  window_->use("to_results");
  take("task-results", 1);
  window_->kill();
}

}  // namespace task_pictures_test
}  // namespace jnd::app
