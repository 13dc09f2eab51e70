#include "app/window/pictures_fixture.h"

namespace jnd::app {
namespace session_pictures_test {

namespace fs = std::filesystem;
using nlohmann::json;

/// Takes pictures of a shipped study that has every part of a long session, but few of each.
class SessionPicturesTest : public PicturesWindowTest {
 protected:
  static std::string short_study(const std::string& blinding = "participant") {
    json study = shipped("viscosity_discrimination");
    const json tour = shipped("short_tour");
    study["blinding"] = blinding;
    json& stages = study["stages"];
    std::set<std::string> kinds;
    json few = json::array();
    for (json& stage : stages) {
      const std::string kind = stage.at("kind");
      if (kind == "checklist" && !kinds.insert(kind).second) continue;
      if (kind == "counterbalance") {
        for (const json& tour_stage : tour.at("stages")) {
          if (tour_stage.at("kind") == "block") few.push_back(tour_stage);
        }
        few.push_back({{"kind", "break"},
                       {"name", "rest"},
                       {"instruction",
                        {{"en", "Let the participant drink something."},
                         {"de", "Etwas zu trinken anbieten."}}},
                       {"duration_s", 300}});
        continue;
      }
      few.push_back(stage);
    }
    stages = few;
    for (json& stage : stages) {
      if (stage.at("kind") == "checklist" && stage.at("items").size() > 3) {
        stage["items"].erase(stage["items"].begin() + 3, stage["items"].end());
      }
      if (stage.at("kind") != "block") continue;
      stage["free_space_between_s"] = 0;
      if (stage.contains("repetitions")) stage["repetitions"] = 1;
      for (const char* levels : {"scale", "viscosity_pa_s"}) {
        if (!stage.contains(levels) || stage.at(levels).size() < 2) continue;
        json& all = stage[levels];
        all = {all.front(), all.back()};
      }
    }
    return study.dump(1);
  }

  /// Takes a picture of every new kind of card and does what the card asks for. Returns false
  /// at the end.
  bool step_on() {
    static const std::vector<std::string> kCards = {
        "begin",       "item_done", "consent_given",  "item_text",    "item_yes",
        "feel_medium", "scale_7",   "finish_medium",  "finish_break", "present",
        "answer_yes",  "matches",   "answer_percent", "finish_stage", "to_results"};
    std::string card;
    const Screen now = window_->wait_until("a card", [&](const Screen& at) {
      for (const std::string& name : kCards) {
        if (at.find(name) != nullptr) card = name;
      }
      for (const Screen::Widget& widget : at.widgets) {
        if (widget.name.starts_with("option_")) card = widget.name;
      }
      return !card.empty() && at.find("dialog_do") == nullptr;
    });
    const bool to_test = card == "present" && now.find(card)->label == "Present the test";
    const std::string kind = card.starts_with("option_") ? "option" : card;
    take("session-" + kind + (to_test ? "-test" : ""));
    if (card == "to_results") return false;
    const Screen then = window_->wait_until("the card", [&](const Screen& at) {
      return at.find(card) != nullptr || at.offers("present") || at.offers("feel_medium");
    });
    if (then.find(card) == nullptr) return true;
    answer(card, now);
    window_->wait_until("the next card",
                        [&](const Screen& at) { return words_of(at) != words_of(now); });
    return true;
  }

  void answer(const std::string& card, const Screen& now) {
    if (card == "item_text") {
      window_->press("ctrl+a");
      window_->type(now.shows("word, word") ? "calm, soft, thick"
                    : now.shows("1 to 2.5") ? "1.78"
                                            : "42");
      window_->press("Return");
    } else if (card == "answer_percent") {
      window_->type("120");
      window_->wait_for(card);
      take("session-percent");
      window_->use(card);
    } else if (card == "finish_break") {
      window_->use(card);
      window_->wait_for_text("Go on before the rest is over");
      window_->type("enough");
      window_->press("Return");
    } else {
      window_->use(card);
    }
  }

  /// Opens a dialog, takes a picture of it and leaves it.
  void take_dialog(const std::string& name, const std::string& key, const std::string& widget) {
    window_->press(key);
    window_->wait_for(widget);
    take(name, key == "F1" ? 1 : 2);
    window_->press(key == "F1" ? key : "F2");
    window_->wait_until("the dialog's end",
                        [&](const Screen& now) { return !now.find(widget); });
  }
};

TEST_F(SessionPicturesTest, OfASessionFromItsPreparationToItsEnd) {
  write_file(path("study.json"), short_study());
  window_->start({"run", path("study.json").string(), "--study",
                  path("viscosity.study").string(), "--participant", "P07", "--device",
                  "lumped", "--seed", "7"});
  window_->wait_for("start_session");
  take("prepare");
  window_->use("real_session");
  window_->use("start_session");
  while (step_on()) {
  }
  window_->wait_for_text("complete");
  take("session-finished");
  window_->kill();
}

TEST_F(SessionPicturesTest, OfADoubleBlindPilotAndWhatInterruptsIt) {
  write_file(path("study.json"), short_study("double"));
  window_->start({"run", path("study.json").string(), "--study", path("blind.study").string(),
                  "--participant", "P08", "--device", "lumped", "--seed", "7", "--pilot"});
  taken_ = {"session-begin",        "session-item_done", "session-consent_given",
            "session-item_text",    "session-option",    "session-feel_medium",
            "session-finish_medium"};
  window_->use("start_session");
  while (window_->screen().find("answer_percent") == nullptr) ASSERT_TRUE(step_on());
  take("session-blind");
  take_dialog("session-screens", "F9", "screen_close");
  take_dialog("session-keys", "F1", "keys_close");
  take_dialog("session-note", "ctrl+n", "dialog_cancel");
  take_dialog("session-leave", "ctrl+w", "dialog_cancel");
  do {
    window_->use("pause");
    // The pause is refused if the window has stalled meanwhile.
    window_->wait_until("a pause", [](const Screen& now) {
      return now.offers("dialog_cancel") || now.shows("Not done");
    });
    if (!window_->screen().offers("dialog_cancel")) continue;
    take("session-pause");
    window_->press("F2");
    window_->wait_until("a pause", [](const Screen& now) {
      return now.offers("go_on") || now.offers("pause");
    });
  } while (!window_->screen().offers("go_on"));
  take("session-paused");
  window_->use("go_on");
  feel_test();
  window_->press("Escape");
  window_->wait_for("release_stop");
  take("session-stopped");
  window_->press("ctrl+w");
  window_->wait_for_text("Leave the session");
  window_->press("Return");
  window_->wait_for_view("sessions");
  take("sessions-blind");
  window_->use("tab_results");
  window_->wait_for_view("results");
  window_->wait_for("unblind");
  take("results-blind");
  window_->use("tab_start");
  window_->wait_for("resume_1");
  take("start-interrupted");
  close();
}

}  // namespace session_pictures_test
}  // namespace jnd::app
