#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <set>
#include <string>

#include "app/gui/headless_ui.h"
#include "app/gui/text_layout.h"
#include "app/gui/views/overview_view.h"
#include "app/gui/views/prepare_view.h"
#include "app/gui/views/record_view.h"
#include "app/gui/views/results_parts.h"
#include "app/gui/views/results_view.h"
#include "app/gui/views/run_view_fixture.h"
#include "app/gui/views/sessions_view.h"
#include "app/gui/views/study_view.h"
#include "app/operator/operated_session_fixture.h"
#include "app/operator/results_model.h"
#include "app/operator/simulated_study.h"
#include "app/operator/study_outline.h"
#include "support/files.h"
#include "support/places.h"

// People read the study's titles and words, and not the names that the program uses.

namespace jnd::app::gui {
namespace drawn_words_test {

namespace fs = std::filesystem;

/// Returns what is wrong with a text on the screen, or "" if nothing is.
std::string problem_of(const std::string& text) {
  // The name of a file, a path, and the words that name a device are allowed.
  static const std::regex kFile(
      R"re(\S*/\S*|\S+\.(json|study|csv|html|sqlite|svg|pdf|h5)\b)re");
  static const std::regex kName(R"re(\b[a-z][a-z0-9]*(_[a-z0-9]+)+\b)re");
  static const std::regex kWrong(R"re(\bPA S\b|\bPse\b|\bJnd\b|\b(\w+) is \1\b)re");
  const std::string words = std::regex_replace(text, kFile, "");
  std::smatch found;
  if (std::regex_search(words, found, kName)) return "a name of the program: " + found.str();
  if (std::regex_search(words, found, kWrong)) return "\"" + found.str() + "\"";
  const std::string heading = in_capitals(words);
  if (std::regex_search(heading, found, kWrong)) {
    return "\"" + found.str() + "\" as a heading";
  }
  return "";
}

void expect_words(const Drawn& drawn, const std::string& where) {
  for (const std::string& text : drawn.texts) {
    EXPECT_EQ(problem_of(text), "") << where << ": " << text;
  }
}

std::vector<fs::path> shipped_studies() {
  std::vector<fs::path> files;
  for (const auto& entry :
       fs::directory_iterator(test_support::source_folder() / "protocols")) {
    const std::string name = entry.path().filename().string();
    if (name.ends_with(".json") && !name.ends_with(".schema.json")) {
      files.push_back(entry.path());
    }
  }
  EXPECT_GT(files.size(), 10U);
  return files;
}

TEST(DrawnWords, AProblemIsSeenWhereThereIsOne) {
  for (const char* wrong :
       {"group_d: no fraction", "Pse, median person", "only where solid is solid",
        "largest max_speed_m_per_s", "1 PA S"}) {
    EXPECT_NE(problem_of(wrong), "") << wrong;
  }
  for (const char* right : {"Group D: 1.85 Pa s", "written to /data/my_study-csv/trials.csv",
                            "my_study.json", "PSE, median person", "pse free", "This is it"}) {
    EXPECT_EQ(problem_of(right), "") << right;
  }
}

TEST(DrawnWords, OfEveryShippedStudysOutlineAndOrders) {
  const StudyFolder folder{.folder = "/data/honey.study", .name = "honey", .title = "Honey"};
  for (const fs::path& file : shipped_studies()) {
    const experiments::Study study = experiments::read_study(file);
    const StudyOutline outline = outline_of(study);
    const std::vector<PlannedOrder> orders = planned_orders(study, {.num_participants = 4});
    HeadlessUi ui(1600, 4000);
    StudyViewState state{.num_participants = 4};
    const Drawn& drawn = ui.frame([&](Ui& now) {
      (void)draw_study_view(now, {.study = &folder, .outline = outline, .orders = orders},
                            state);
    });
    expect_words(drawn, file.filename().string());
  }
}

/// Simulates a shipped study and looks at its results.
void look_at_results(const std::string& shipped, int num_participants) {
  SimulatedStudy study(
      test_support::read_file(test_support::source_folder() / "protocols" / shipped));
  study.simulate(num_participants);
  WorkControl control;
  const ResultsModel results = results_model(study.folder(), control);
  const StudyFolder folder = open_study_folder(study.folder());
  HeadlessUi ui(1600, 4000);
  SessionsViewState sessions;
  expect_words(ui.frame([&](Ui& now) { (void)draw_sessions_view(now, folder, {}, sessions); }),
               shipped + ", sessions");
  const StudyOverview overview = study_overview(study.folder(), 3, control);
  OverviewState overview_state;
  expect_words(ui.frame([&](Ui& now) {
    (void)draw_overview(now, {.study = folder, .overview = &overview}, overview_state);
  }),
               shipped + ", overview");
  const SessionRecord record = session_record(study.folder(), 1);
  RecordViewState record_state;
  for (const RecordPage page :
       {RecordPage::kTimeline, RecordPage::kAnswers, RecordPage::kNotes, RecordPage::kFaults}) {
    record_state.page = page;
    expect_words(ui.frame([&](Ui& now) {
      (void)draw_record_view(now, {.study = folder, .record = &record}, record_state);
    }),
                 shipped + ", a session");
  }
  const ResultsViewModel model{.study = folder, .results = &results};
  ResultsViewState state;
  for (std::size_t page = 0; page < pages_of(results).size(); ++page) {
    for (std::size_t participant = 0; participant <= results.rows.size(); ++participant) {
      state.page = page;
      state.participant = participant;
      expect_words(ui.frame([&](Ui& now) { (void)draw_results_view(now, model, state); }),
                   shipped + ", page " + std::to_string(page));
    }
  }
  // These texts appear if the mouse is over a number.
  for (const results::NumberLine& line : results.numbers) {
    for (const std::string& told : {line.meaning, line.caution}) {
      EXPECT_EQ(problem_of(told), "") << shipped << ": " << told;
    }
  }
  for (const results::TableRow& row : results.rows) {
    EXPECT_EQ(problem_of(row.note), "") << shipped << ": " << row.note;
  }
}

TEST(DrawnWords, OfTheResultsOfThePublishedStudies) {
  look_at_results("viscosity_discrimination.json", 2);
  look_at_results("magnitude_of_virtual_water.json", 2);
}

TEST(DrawnWords, OfTheResultsOfAdaptiveBlocksAndOfMatching) {
  look_at_results("viscosity_staircase.json", 2);
  look_at_results("viscosity_matching.json", 2);
}

class DrawnSession : public OperatedSessionTest {};

TEST_F(DrawnSession, HasTheWordsOfItsStudy) {
  open();
  act(operate::Begin{});
  HeadlessUi ui;
  RunViewState state;
  AfterSession after;
  std::set<int> seen;
  for (int guard = 0; guard < 500 && view().step != Step::kFinished; ++guard) {
    const SessionView now = view();
    seen.insert(static_cast<int>(now.step));
    expect_words(
        ui.frame([&](Ui& frame) { (void)draw_run_view(frame, now, {}, after, state); }),
        "session");
    step_on(now);
  }
  EXPECT_EQ(view().step, Step::kFinished);
  EXPECT_GT(seen.size(), 5U);
}

TEST(DrawnWords, OfAPreparation) {
  const StudyFolder folder{.folder = "/data/honey.study", .name = "honey", .title = "Honey"};
  const PrepareModel model{.study = folder,
                           .devices = {{"lumped", "a simulated hand", true}},
                           .languages = {"en"},
                           .assigned = "group d, then group e",
                           .seed = 7};
  PrepareViewState state{.participant = "P01", .device = "lumped", .language = "en"};
  HeadlessUi ui;
  expect_words(ui.frame([&](Ui& now) { (void)draw_prepare_view(now, model, state); }),
               "prepare");
}

}  // namespace drawn_words_test
}  // namespace jnd::app::gui
