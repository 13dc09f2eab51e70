#include "app/operator/export_actions.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "analysis/hand_made_study.h"
#include "app/operator/results_model.h"
#include "app/operator/simulated_study.h"
#include "app/results/study_report.h"
#include "core/error.h"
#include "core/storage/backup.h"
#include "core/storage/export_note.h"

namespace jnd::app {
namespace export_actions_test {

namespace fs = std::filesystem;

class ExportActionsTest : public ::testing::Test {
 protected:
  [[nodiscard]] fs::path target() const { return study_.temporary() / "out"; }
  SimulatedStudy study_;
  WorkControl control_;
};

TEST_F(ExportActionsTest, TablesAreWrittenWithACodebook) {
  study_.simulate(2);
  const ActionOutcome outcome = export_study(study_.folder(), target(), {"csv"}, control_);
  EXPECT_TRUE(outcome.ok);
  EXPECT_EQ(outcome.sentence, "20 answers of 2 sessions are written to " + target().string() +
                                  ": tables with a codebook");
  EXPECT_EQ(outcome.opens, target());
  EXPECT_TRUE(fs::exists(target() / "trials.csv"));
  EXPECT_TRUE(fs::exists(target() / "codebook.csv"));
  EXPECT_EQ(control_.ratio(), 1.0);
}

TEST_F(ExportActionsTest, EveryFormatOfTheCommandIsWritten) {
  study_.simulate(1, /*record=*/true);
  const fs::path bids = study_.temporary() / "bids", hdf5 = study_.temporary() / "hdf5";
  const ActionOutcome first = export_study(study_.folder(), bids, {"bids"}, control_);
  EXPECT_TRUE(first.sentence.ends_with(": a BIDS data set")) << first.sentence;
  EXPECT_TRUE(fs::exists(bids / "dataset_description.json"));
  const ActionOutcome second = export_study(study_.folder(), hdf5, {"hdf5"}, control_);
  EXPECT_TRUE(second.sentence.ends_with(": tables and an HDF5 file")) << second.sentence;
  EXPECT_TRUE(fs::exists(hdf5 / "study.h5"));
  EXPECT_EQ(second.opens, hdf5);
  (void)export_study(study_.folder(), target(), {.format = "csv", .recordings = true},
                     control_);
  EXPECT_TRUE(fs::exists(target() / "recordings"));
}

TEST_F(ExportActionsTest, FiguresAreDrawnAsTheReportDrawsThem) {
  study_.simulate(2);
  const std::vector<analysis::ChartSet> charts =
      results_model(study_.folder(), control_).charts;
  const auto what = StudyFiguresRequest::What::kCharts;
  const ActionOutcome outcome = save_figures(
      {.folder = study_.folder(), .out = target(), .what = what, .charts = charts}, control_);
  EXPECT_TRUE(outcome.ok) << outcome.sentence;
  EXPECT_TRUE(outcome.sentence.ends_with(", as SVG and PDF")) << outcome.sentence;
  EXPECT_EQ(outcome.opens, target());
  EXPECT_EQ(control_.ratio(), 1.0);
  (void)write_report(study_.folder(), study_.temporary() / "report", control_);
  int num_svg = 0;
  for (const auto& entry : fs::directory_iterator(target())) {
    if (entry.path().extension() != ".svg") continue;
    ++num_svg;
    const fs::path name = entry.path().filename();
    EXPECT_TRUE(fs::exists(target() / fs::path(name).replace_extension(".pdf")));
    const fs::path reported = study_.temporary() / "report" / "figures" / name;
    ASSERT_TRUE(fs::exists(reported)) << name;
  }
  EXPECT_GT(num_svg, 0);
  EXPECT_EQ(core::noted_exports(study_.folder()).front().kind, "figures");
}

TEST_F(ExportActionsTest, OneParticipantsChartsAreFiguresOfTheirOwn) {
  study_.simulate(2);
  const std::vector<analysis::ChartSet> charts =
      results_model(study_.folder(), control_).charts;
  const ActionOutcome outcome = save_figures({.folder = study_.folder(),
                                              .out = target(),
                                              .charts = charts,
                                              .who = "P02",
                                              .simulated = true},
                                             control_);
  EXPECT_TRUE(outcome.ok) << outcome.sentence;
  for (const auto& entry : fs::directory_iterator(target())) {
    if (entry.path().extension() != ".svg") continue;
    EXPECT_TRUE(entry.path().stem().string().ends_with("_P02")) << entry.path();
  }
  EXPECT_THROW((void)save_figures({.folder = study_.folder(),
                                   .out = study_.temporary() / "nobody",
                                   .charts = charts,
                                   .who = "P99"},
                                  control_),
               core::Error);
  EXPECT_FALSE(fs::exists(study_.temporary() / "nobody"));
}

TEST_F(ExportActionsTest, BoxesAreFiguresOfTheReport) {
  study_.simulate(3);
  const ActionOutcome outcome = save_figures(
      {.folder = study_.folder(), .out = target(), .what = StudyFiguresRequest::What::kBoxes},
      control_);
  EXPECT_TRUE(outcome.ok) << outcome.sentence;
}

TEST_F(ExportActionsTest, TheStudyRemembersWhereItWasWrittenTo) {
  study_.simulate(1);
  EXPECT_TRUE(export_study(study_.folder(), target(), {"csv"}, control_).problems.empty());
  (void)write_report(study_.folder(), study_.temporary() / "report", control_);
  const std::vector<core::ExportNote> notes = core::noted_exports(study_.folder());
  ASSERT_EQ(notes.size(), 2U);
  EXPECT_EQ(notes[0].place, fs::canonical(target()));
  EXPECT_EQ(notes[0].kind, "csv");
  EXPECT_EQ(notes[0].sessions, std::vector<std::int64_t>{1});
  EXPECT_EQ(notes[1].kind, "report");
}

TEST_F(ExportActionsTest, NothingIsEverOverwritten) {
  study_.simulate(1);
  fs::create_directories(target());
  write_file(target() / "mine.txt", "x");
  EXPECT_THROW((void)export_study(study_.folder(), target(), {"csv"}, control_), core::Error);
  EXPECT_THROW((void)write_report(study_.folder(), target(), control_), core::Error);
  EXPECT_EQ(std::distance(fs::directory_iterator(target()), {}), 1);
}

TEST_F(ExportActionsTest, AVerificationCountsWhatItReadBack) {
  study_.simulate(1, /*record=*/true);
  const ActionOutcome outcome = verify_study(study_.folder(), control_);
  EXPECT_TRUE(outcome.ok) << outcome.sentence;
  EXPECT_EQ(outcome.sentence.find("a.study: complete, 1 session with 10 answers and "), 0U)
      << outcome.sentence;
  EXPECT_TRUE(outcome.problems.empty());
}

TEST_F(ExportActionsTest, AVerificationTellsEveryProblem) {
  study_.simulate(1, /*record=*/true);
  fs::remove(study_.folder() / "recordings" / "0001.sqlite");
  const ActionOutcome outcome = verify_study(study_.folder(), control_);
  EXPECT_FALSE(outcome.ok);
  ASSERT_FALSE(outcome.problems.empty());
  EXPECT_NE(outcome.problems.front().find("session 1: "), std::string::npos);
  EXPECT_NE(outcome.sentence.find(outcome.problems.front()), std::string::npos);
  EXPECT_FALSE(verify_study(study_.temporary() / "none", control_).ok);
}

TEST_F(ExportActionsTest, AVerificationPlaysEveryLogAgain) {
  // The rows of this session are sound, but its events are empty.
  analysis::HandMadeStudy study(kTinyStudy);
  study.add("P01");
  study.estimate(1.0, 100.0);
  EXPECT_FALSE(verify_study(study.folder(), control_).ok);
}

TEST_F(ExportActionsTest, ABackupIsReadBackAndKnown) {
  study_.simulate(1, /*record=*/true);
  const ActionOutcome outcome = back_up_study(study_.folder(), target(), control_);
  EXPECT_TRUE(outcome.ok);
  EXPECT_NE(outcome.sentence.find("complete"), std::string::npos) << outcome.sentence;
  EXPECT_EQ(core::known_backups(study_.folder()), std::vector<fs::path>{target()});
  EXPECT_TRUE(outcome.caution);
  EXPECT_NE(outcome.sentence.find("on the study's own disk"), std::string::npos)
      << outcome.sentence;
  EXPECT_TRUE(verify_study(target(), control_).ok);
  EXPECT_THROW((void)back_up_study(study_.folder(), study_.folder(), control_), core::Error);
}

TEST_F(ExportActionsTest, AReportIsTheOneOfTheCommand) {
  study_.simulate(3);
  const ActionOutcome outcome = write_report(study_.folder(), target(), control_);
  EXPECT_TRUE(outcome.ok);
  EXPECT_EQ(outcome.sentence.find("report.html"), 0U) << outcome.sentence;
  EXPECT_EQ(outcome.opens, target() / "report.html");
  EXPECT_EQ(control_.ratio(), 1.0);
  const fs::path other = study_.temporary() / "by_the_command";
  (void)write_study_report({.folder = study_.folder(), .out = other});
  EXPECT_EQ(read_file(target() / "report.html"), read_file(other / "report.html"));
  EXPECT_TRUE(fs::exists(target() / "figures"));
}

TEST_F(ExportActionsTest, AReportThatIsCancelledHalfWayLeavesNothingBehind) {
  study_.simulate(1);
  std::vector<double> steps;
  const auto cancelled = [&](double done) {
    steps.push_back(done);
    if (done > 0.6) throw WorkCancelled{};
  };
  EXPECT_THROW(
      (void)write_study_report(
          {.folder = study_.folder(), .out = target(), .jobs = 1, .on_progress = cancelled}),
      WorkCancelled);
  EXPECT_TRUE(std::ranges::is_sorted(steps));
  EXPECT_GT(steps.size(), 3U);
  EXPECT_FALSE(fs::exists(target()));
}

TEST_F(ExportActionsTest, ADoubleBlindStudyGivesNothingAway) {
  SimulatedStudy blind(kDoubleBlindStudy);
  blind.simulate(1);
  EXPECT_THROW((void)export_study(blind.folder(), target(), {"csv"}, control_), core::Error);
  EXPECT_THROW((void)write_report(blind.folder(), target(), control_), core::Error);
  EXPECT_FALSE(fs::exists(target()));
}

TEST_F(ExportActionsTest, AnUnblindingIsInTheLogOfEverySessionOnce) {
  SimulatedStudy blind(kDoubleBlindStudy);
  EXPECT_THROW((void)unblind_study(blind.folder(), "too early"), core::Error);
  blind.simulate(2);
  (void)unblind_study(blind.folder(), "all sessions done");
  (void)unblind_study(blind.folder(), "asked again");
  const core::StudyStore store(blind.folder(), core::StudyStore::Mode::kReadOnly);
  EXPECT_TRUE(store.unblinded());
  for (const std::int64_t session : {1, 2}) {
    const std::vector<core::EventRow> events = store.events(session);
    EXPECT_EQ(events.back().kind, "unblinded");
    EXPECT_NE(events.back().data.find("all sessions done"), std::string::npos);
    EXPECT_NE(events[events.size() - 2].kind, "unblinded");
  }
  EXPECT_TRUE(verify_study(blind.folder(), control_).ok);
  study_.simulate(1);
  EXPECT_THROW((void)unblind_study(study_.folder(), "not blind"), core::Error);
}

TEST_F(ExportActionsTest, WhatIsCancelledLeavesNothingBehind) {
  study_.simulate(1);
  control_.cancel();
  EXPECT_THROW((void)export_study(study_.folder(), target(), {"csv"}, control_), WorkCancelled);
  EXPECT_THROW((void)write_report(study_.folder(), target(), control_), WorkCancelled);
  EXPECT_FALSE(fs::exists(target()));
}

TEST_F(ExportActionsTest, AFreeFolderLiesBesideTheStudy) {
  const fs::path first = free_folder_beside(study_.folder(), "csv");
  EXPECT_EQ(first, study_.temporary() / "a-csv");
  fs::create_directories(first);
  EXPECT_EQ(free_folder_beside(study_.folder(), "csv"), study_.temporary() / "a-csv-2");
}

}  // namespace export_actions_test
}  // namespace jnd::app
