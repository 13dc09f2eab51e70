#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "app/gui/views/apparatus_view.h"
#include "app/gui/views/layout_problems.h"
#include "app/gui/views/run_view_fixture.h"

// The reason of a refusal is a whole sentence of any length. The view breaks it into as many
// lines as it takes, in every size of the window and at every step of the session.

namespace jnd::app::gui {
namespace refusal_test {

const std::string kLongRefusal =
    "session 12: expected an answer to a trial that is under way in order to store it, found "
    "that the presentation was abandoned because the device was disarmed at the very moment; "
    "the medium was taken away and nothing was stored; arm the device again, present both "
    "fluids once more from the first on, and ask the participant for an answer to what they "
    "feel then";

struct WaitingFor {
  const char* name;
  SessionView view;
};

std::vector<WaitingFor> whatever_is_waited_for() {
  std::vector<WaitingFor> all = {
      {"comparison", comparison()}, {"estimation", estimation()}, {"production", production()}};
  SessionView ready = comparison();
  ready.step = Step::kReady;
  all.push_back({"ready", ready});
  for (const auto& [name, step] : {std::pair{"begin", Step::kBegin},
                                   {"paused", Step::kPaused},
                                   {"break", Step::kBreak},
                                   {"block is over", Step::kStageDone},
                                   {"medium", Step::kMedium}}) {
    SessionView view = comparison();
    view.trial.reset();
    view.step = step;
    all.push_back({name, view});
  }
  all.push_back({"question", item_of({.kind = ItemView::Kind::kYesNo, .text = "Is it so?"})});
  return all;
}

class RefusalTest : public ::testing::TestWithParam<std::pair<int, int>> {
 protected:
  template <typename Draw>
  void expect_whole(const std::string& name, const Draw& draw) {
    for (int i = 0; i < 4; ++i) ui_.frame(draw);
    std::string lines;
    for (const Drawn::Line& line : ui_.drawn().lines) lines += line.words + " ";
    EXPECT_NE(lines.find("Not done: " + kLongRefusal + "."), std::string::npos)
        << name << ": " << lines;
    const LayoutProblems problems(ui_.drawn(), ui_.ui().screen());
    for (const std::string& problem : problems.sentences()) {
      ADD_FAILURE() << name << ": " << problem;
    }
    ui_.frame([](Ui&) {});
  }

  HeadlessUi ui_{static_cast<float>(GetParam().first), static_cast<float>(GetParam().second)};
};

TEST_P(RefusalTest, ALongRefusalIsReadableWholeOnTheCardOfASession) {
  for (WaitingFor waiting : whatever_is_waited_for()) {
    waiting.view.refusal = kLongRefusal;
    RunViewState state;
    AfterSession after;
    expect_whole(waiting.name,
                 [&](Ui& ui) { (void)draw_run_view(ui, waiting.view, {}, after, state); });
  }
}

TEST_P(RefusalTest, ALongRefusalIsReadableWholeBesideTheApparatus) {
  for (const bool hides : {false, true}) {
    SessionView view = comparison();
    view.refusal = kLongRefusal;
    view.hides_levels = hides;
    RunViewState run{.shows_apparatus = true};
    ApparatusViewState apparatus;
    expect_whole(hides ? "hidden" : "apparatus",
                 [&](Ui& ui) { (void)draw_apparatus_view(ui, view, {}, run, apparatus); });
  }
}

INSTANTIATE_TEST_SUITE_P(Windows, RefusalTest,
                         ::testing::Values(std::pair{1024, 640}, std::pair{1280, 800},
                                           std::pair{1920, 1080}),
                         [](const auto& instance) {
                           return "Of" + std::to_string(instance.param.first) + "By" +
                                  std::to_string(instance.param.second);
                         });

}  // namespace refusal_test
}  // namespace jnd::app::gui
