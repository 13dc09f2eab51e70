#include "app/gui/views/participant_view.h"

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "app/gui/views/every_view.h"
#include "app/gui/views/layout_problems.h"
#include "support/files.h"
#include "support/places.h"

// On the smallest, the usual and the largest monitor, everything on the participant's screen
// has room, and nothing tells a level or the name of a block.

namespace jnd::app::gui {
namespace participant_view_test {

/// Everything that the operator may read and the participant must not is a unique word.
const std::string kTelltaleStudy = R"json({
  "format": 1, "name": "treacly", "languages": ["en"], "title": {"en": "Gluey things"},
  "authors": ["A. Author"],
  "device": {"min_contact_points": 1, "rate_hz": 1000, "ramp_s": 0.05},
  "stages": [
    {"kind": "checklist", "name": "gooey", "items": [{"text": {"en": "Fill the tank."}}]},
    {"kind": "consent", "name": "oily", "title": {"en": "Oily"},
     "paragraphs": [{"en": "You feel things."}, {"en": "You may stop."}],
     "agreement": {"en": "I take part."}},
    {"kind": "explore", "name": "creamy", "instruction": {"en": "Move."},
     "media": [{"medium": "viscous", "viscosity_pa_s": 0.4419, "duration_s": 0.5}]},
    {"kind": "block", "name": "syrupy", "title": {"en": "The tarry group"},
     "procedure": "constant_stimuli", "medium": "viscous", "answered_by": "participant",
     "viscosity_pa_s": [0.1372, 0.2719], "reference_viscosity_pa_s": 0.1913,
     "repetitions": 1, "free_space_between_s": 0.5, "instruction": {"en": "Compare."},
     "question": {"en": "More?"}, "expected_trial_s": 5},
    {"kind": "break", "name": "slimy", "title": {"en": "Slimy"},
     "instruction": {"en": "Rest."}, "duration_s": 30},
    {"kind": "block", "name": "brothy", "title": {"en": "The soupy group"},
     "procedure": "magnitude_production", "medium": "water", "scale": [0.8317],
     "target_percent": [100], "coarse_step_scale": 0.0537, "fine_step_scale": 0.0119,
     "free_space_between_s": 0, "instruction": {"en": "Set it."},
     "question": {"en": "So?"}, "expected_trial_s": 5},
    {"kind": "block", "name": "milky", "title": {"en": "Milky"},
     "procedure": "magnitude_estimation", "medium": "water", "scale": [0.6143],
     "repetitions": 1, "free_space_between_s": 0, "instruction": {"en": "Say."},
     "question": {"en": "How much?"}, "expected_trial_s": 5},
    {"kind": "questionnaire", "name": "lumpy", "title": {"en": "Lumpy"},
     "instruction": {"en": "You."}, "items": [
      {"name": "clotted", "kind": "number", "unit": "m", "minimum": 1, "maximum": 2.5,
       "question": {"en": "Height?"}}]}
  ]
})json";

constexpr const char* kTelltales[] = {
    "treacly", "luey",  "ooey",  "oily",  "Oily",  "creamy", "0.44",    "syrupy",   "tarry",
    "0.137",   "0.272", "0.191", "slimy", "Slimy", "brothy", "soupy",   "0.832",    "0.0537",
    "0.0119",  "milky", "Milky", "0.614", "lumpy", "Lumpy",  "clotted", "viscous",  "Pa s",
    "scale",   "water", "Fill",  "group", "Block", "Trial",  "trial",   "reference"};

/// Holds three monitors, each with letters of the size that the window chooses for it.
class ThreeMonitors {
 public:
  ThreeMonitors() {
    for (const auto& [width, height] : {std::pair(1024, 600), {1920, 1080}, {3840, 2160}}) {
      const float scale = scale_from_afar(width, height);
      screens_.push_back(std::make_unique<OneMonitor>(
          static_cast<float>(width) / scale, static_cast<float>(height) / scale, scale));
    }
  }
  /// `may_read` gets what was drawn on each.
  void look(const std::string& name, const ParticipantScreen& shown,
            const std::function<void(const Drawn&)>& may_read = {}) {
    for (const auto& one : screens_) {
      ParticipantViewState state;
      const Drawn& drawn =
          one->ui.frame([&](Ui& ui) { draw_participant_view(ui, shown, state); });
      const LayoutProblems problems(drawn, one->screen);
      for (const std::string& problem : problems.sentences()) {
        ADD_FAILURE() << name << " on " << one->screen.width << " x " << one->screen.height
                      << ": " << problem;
      }
      EXPECT_TRUE(drawn.widgets.empty()) << "nothing on it can be used";
      if (may_read) may_read(drawn);
    }
  }

 private:
  struct OneMonitor {
    OneMonitor(float width, float height, float scale)
        : ui(width, height, scale), screen{0, 0, width, height} {}
    HeadlessUi ui;
    Rect screen;
  };
  std::vector<std::unique_ptr<OneMonitor>> screens_;
};

void expect_no_telltale(const std::string& name, const Drawn& drawn) {
  for (const char* telltale : kTelltales) {
    for (const std::string& text : drawn.texts) {
      EXPECT_EQ(text.find(telltale), std::string::npos)
          << name << ": \"" << text << "\" tells " << telltale;
    }
  }
}

TEST(ScaleFromAfar, LeavesRoomFor1024By600OnAnyMonitor) {
  EXPECT_EQ(scale_from_afar(1024, 600), 1.0f);
  EXPECT_EQ(scale_from_afar(1920, 1080), 1.75f);
  EXPECT_EQ(scale_from_afar(3840, 2160), 2.5f);
  EXPECT_EQ(scale_from_afar(640, 480), 0.5f);
  EXPECT_EQ(scale_from_afar(0, 0), 0.5f);
}

class ParticipantViewTest : public EverySessionTest {
 protected:
  static const std::map<std::string, std::string>& pedals() {
    static const std::map<std::string, std::string> kPedals = {
        {"first", "FootSwitch: A"},   {"second", "FootSwitch: B"}, {"present", "FootSwitch: C"},
        {"matches", "FootSwitch: B"}, {"raise", "FootSwitch: A"},  {"step_1", "Box: 1"}};
    return kPedals;
  }
  ThreeMonitors monitors_;
};

TEST_F(ParticipantViewTest, NoLevelAndNoNameOfABlockReachesItInAnyStage) {
  open(kTelltaleStudy);
  std::set<Step> seen;
  const auto look = [&](SessionView now) {
    seen.insert(now.step);
    now.controls = pedals();
    const std::string name = now.heading + ", " + now.sentence;
    for (const char* typed : {"", "120"}) {
      monitors_.look(name, participant_screen(now, typed),
                     [&](const Drawn& drawn) { expect_no_telltale(name, drawn); });
    }
  };
  look(view());
  act(operate::Begin{});
  for (int guard = 0; guard < 500 && view().step != Step::kFinished; ++guard) {
    const SessionView now = view();
    look(now);
    if (now.step != Step::kReady) {
      step_on(now);
      continue;
    }
    const std::int64_t trial = now.trial->trial;
    if (now.trial->has_reference) {
      look(act(operate::Present{trial, "reference"}));
      pass(0.5);
    }
    look(act(operate::Present{trial, "test"}));
    if (now.trial->adjustable) {
      look(act(operate::Adjust{trial, experiments::Direction::kRaise}));
    }
    pass(0.5);
    look(act(operate::Pause{}));
    look(act(operate::GoOn{}));
    answer_trial(view(), 1.0);
  }
  look(view());
  EXPECT_EQ(view().step, Step::kFinished);
  EXPECT_GE(seen.size(), 10U);
}

TEST_F(ParticipantViewTest, WhatTheParticipantNeedsStandsOnIt) {
  SessionView now = comparison();
  now.participant_answers = true;
  now.controls = pedals();
  monitors_.look("comparison", participant_screen(now, ""), [](const Drawn& drawn) {
    EXPECT_TRUE(drawn.shows("thicker than the reference"));
    EXPECT_TRUE(drawn.shows("hand sign one finger"));
    EXPECT_TRUE(drawn.shows("press FootSwitch: A"));
  });
  monitors_.look("estimation", participant_screen(estimation(), "120"),
                 [](const Drawn& drawn) { EXPECT_TRUE(drawn.shows("120 %")); });
  SessionView rest{.language = "en", .step = Step::kBreak, .break_left_s = 82.3};
  rest.participant_text = "Rest.";
  monitors_.look("break", participant_screen(rest, ""),
                 [](const Drawn& drawn) { EXPECT_TRUE(drawn.shows("1:23")); });
}

TEST_F(ParticipantViewTest, NothingIsCutInAnyStateOfAnyProcedure) {
  int num_seen = 0;
  for_each_state([&](const std::string& name, const SessionView& now) {
    ++num_seen;
    monitors_.look(name, participant_screen(now, "120"));
    SessionView answered = now;
    answered.participant_answers = true;
    answered.controls = pedals();
    answered.language = "de";
    monitors_.look(name, participant_screen(answered, "1.75"));
  });
  EXPECT_GT(num_seen, 30);
}

/// Everything that a shipped study may show, in each of its languages.
class ShippedTexts {
 public:
  using Look = std::function<void(const std::string&, const ParticipantScreen&)>;
  explicit ShippedTexts(Look look) : look_(std::move(look)) {}

  void walk(const nlohmann::json& part) {
    if (part.is_object() && part.contains("paragraphs")) return look_at_consent(part);
    for (const char* key : {"instruction", "question"}) {
      if (!part.is_object() || !part.contains(key)) continue;
      for (const auto& [language, words] : part[key].items()) {
        SessionView view = comparison();
        view.language = language;
        view.participant_text = words.get<std::string>();
        view.trial->answer = AnswerKind::kStep;
        view.trial->num_steps = 10;
        look_(words.get<std::string>(), participant_screen(view, ""));
      }
    }
    if (!part.is_structured()) return;
    for (const auto& [key, inner] : part.items()) walk(inner);
  }

 private:
  void look_at_consent(const nlohmann::json& part) {
    for (const auto& [language, agreement] : part["agreement"].items()) {
      ItemView consent{.kind = ItemView::Kind::kConsent, .text = agreement.get<std::string>()};
      for (const auto& paragraph : part["paragraphs"]) {
        consent.paragraphs.push_back(paragraph[language].get<std::string>());
      }
      SessionView view = item_of(consent);
      view.sign = HandSign::kNone;
      view.language = language;
      look_("a consent", participant_screen(view, ""));
    }
  }

  Look look_;
};

TEST_F(ParticipantViewTest, TextsOfShippedStudiesHaveRoomAndNoConsentTakesTwoPages) {
  int num_seen = 0;
  for (const std::string& name : EveryView::shipped_names()) {
    ShippedTexts([&](const std::string& what, const ParticipantScreen& shown) {
      ++num_seen;
      monitors_.look(name + ": " + what, shown, [&](const Drawn& drawn) {
        for (const std::string& text : drawn.texts) {
          EXPECT_FALSE(text.starts_with("Page ") || text.starts_with("Seite ")) << text;
        }
      });
    })
        .walk(nlohmann::json::parse(test_support::read_file(test_support::source_folder() /
                                                            "protocols" / (name + ".json"))));
  }
  EXPECT_GT(num_seen, 100);
}

ParticipantScreen long_consent(std::size_t num_paragraphs) {
  ParticipantScreen shown{.text = participant_word(ParticipantWord::kRead, "en"),
                          .agree = participant_word(ParticipantWord::kAgree, "en"),
                          .agreement = "I have read this, and I take part of my own will.",
                          .page = participant_word(ParticipantWord::kPage, "en")};
  for (std::size_t i = 1; i <= num_paragraphs; ++i) {
    std::string text = "Paragraph " + std::to_string(i) + ".";
    for (int sentence = 0; sentence < 6; ++sentence) {
      text += " What is said here has to be read before anybody can agree to it.";
    }
    shown.paragraphs.push_back(text);
  }
  return shown;
}

TEST_F(ParticipantViewTest, AConsentOfAnyLengthHasRoomAndItsAgreementIsAlwaysThere) {
  for (const std::size_t num : {1U, 3U, 5U, 8U, 30U}) {
    monitors_.look(std::to_string(num) + " paragraphs", long_consent(num),
                   [](const Drawn& drawn) { EXPECT_TRUE(drawn.shows("of my own will")); });
  }
}

TEST_F(ParticipantViewTest, ALongConsentIsReadPageByPage) {
  HeadlessUi ui(1024, 600);
  ui.frame_s = 1.0f;
  ParticipantViewState state;
  const ParticipantScreen shown = long_consent(12);
  std::set<std::string> read;
  std::string pages;
  std::string before;
  for (int second = 0; second < 600; ++second) {
    const Drawn& drawn =
        ui.one_frame([&](Ui& frame) { draw_participant_view(frame, shown, state); });
    for (const std::string& text : drawn.texts) {
      if (text.starts_with("Paragraph ")) read.insert(text.substr(0, text.find('.')));
      if (text.starts_with("Page ") && text != before) pages += (before = text) + ", ";
    }
  }
  EXPECT_EQ(read.size(), 12U) << "each of them stood there";
  EXPECT_TRUE(pages.starts_with("Page 1 of ")) << pages;
  EXPECT_NE(pages.rfind("Page 1 of "), 0U) << "and again from the first: " << pages;
}

TEST_F(ParticipantViewTest, MoreChoicesThanFitInARowStandInSeveral) {
  ParticipantScreen shown{.text = "Which of these is it most like?"};
  for (const char* label : {"water", "oil", "honey as it is sold in a jar", "wet sand", "jelly",
                            "dough", "cream", "yoghurt", "tar", "nothing that I know"}) {
    shown.choices.push_back({label, "press Button box of the laboratory: 12"});
  }
  monitors_.look("choices", shown, [&](const Drawn& drawn) {
    for (const auto& choice : shown.choices) EXPECT_TRUE(drawn.shows(choice.label));
  });
  shown = {.text = "From 1 to 100?", .num_steps = 100, .low_label = "thin"};
  monitors_.look("steps", shown, [](const Drawn& drawn) { EXPECT_TRUE(drawn.shows("100")); });
}

}  // namespace participant_view_test
}  // namespace jnd::app::gui
