#include <gtest/gtest.h>

#include "analysis/hand_made_study.h"
#include "analysis/report/explored_media.h"
#include "analysis/report/recording_conditions.h"
#include "analysis/report/report_results.h"

namespace jnd::analysis {
namespace report_movement_test {

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

std::string movement_chapter(const HandMadeStudy& study, const MovementAnalysis& movement) {
  const StudyData data = load_study(study.store());
  const StudyResults results = results_of(data, {}, {.num_resamples = 50});
  HtmlText html;
  write_movement(html,
                 {.store = study.store(),
                  .data = data,
                  .results = results,
                  .results_options = {},
                  .movement = movement,
                  .program_version = "1"},
                 {});
  return html.text();
}

void present(HandMadeStudy& study, const std::string& interval, std::int64_t presentation,
             std::optional<double> width_m) {
  study.move({.presentation = presentation,
              .interval = interval,
              .intensity = 8.0,
              .measures = {.num_strokes = width_m ? 1 : 0,
                           .stroke_width_m = width_m,
                           .max_speed_m_per_s = width_m}});
}

TEST(ReportMovement, WarnsWhereMoreThanATenthHoldNoWholeStroke) {
  HandMadeStudy study;
  study.add("P01");
  for (int trial = 0; trial < 10; ++trial) {
    study.compare("group_d", 8.0, 8.0, true);
    present(study, "reference", 1, 0.6);
    study.compare("group_d", 8.0, 8.0, true);
    present(study, "test", 2, trial < 8 ? std::optional(0.4) : std::nullopt);
  }
  const std::string html = movement_chapter(study, {});
  EXPECT_TRUE(has(html, "no whole stroke in group_d test (20 %)")) << html;
}

TEST(ReportMovement, DoesNotWarnOfATenth) {
  HandMadeStudy study;
  study.add("P01");
  for (int trial = 0; trial < 10; ++trial) {
    study.compare("group_d", 8.0, 8.0, true);
    present(study, "test", 1, trial < 9 ? std::optional(0.4) : std::nullopt);
  }
  const std::string html = movement_chapter(study, {});
  EXPECT_TRUE(has(html, "10 %"));
  EXPECT_FALSE(has(html, "Caution"));
}

/// Returns the movement of two people in free space and honey, where one of them made no whole
/// stroke.
MovementAnalysis explored() {
  MovementAnalysis movement;
  for (const char* name : {"P01", "P02"}) {
    ParticipantMovement person{.participant = name, .num_samples = 1000};
    const double more_m = name == std::string("P02") ? 0.1 : 0.0;
    person.conditions.push_back(
        {.medium = "free_space",
         .intensity = 0.0,
         .num_presentations = 1,
         .strokes = {
             .num_strokes = 16, .stroke_width_m = 0.3 + more_m, .max_speed_m_per_s = 0.4}});
    person.conditions.push_back(
        {.medium = "viscous", .intensity = 25.0, .num_presentations = 1});
    movement.participants.push_back(std::move(person));
  }
  movement.participants[0].conditions[1].strokes = {
      .num_strokes = 3, .stroke_width_m = 0.2, .max_speed_m_per_s = 0.1};
  return movement;
}

TEST(ReportMovement, OfAStudyWithoutTrialsTellsStrokesByTheMediaExplored) {
  HandMadeStudy study;
  study.add("P01");
  study.add("P02");
  const std::string html = movement_chapter(study, explored());
  EXPECT_TRUE(has(html, "This study has no trials"));
  EXPECT_TRUE(has(html, "free space"));
  EXPECT_TRUE(has(html, "0.350 ± 0.071"));
  EXPECT_TRUE(has(html, "viscous, 25 Pa s"));
  EXPECT_TRUE(has(html, "3, 0")) << "strokes of each";
  EXPECT_FALSE(has(html, "no whole stroke in")) << "nothing was presented";

  const StudyData data = load_study(study.store());
  const StudyResults results = results_of(data, {}, {.num_resamples = 50});
  const std::vector<Figure> figures = explored_figures({data, results, {}}, explored());
  ASSERT_EQ(figures.size(), 1U);
  EXPECT_EQ(figures[0].tables[0].rows.size(), 4U);
  EXPECT_FALSE(figures[0].tables[1].rows.empty());
}

TEST(ReportMovement, ASelectionIsCalledOne) {
  EXPECT_EQ(selection_words(4, 9, "conditions"), " A selection: the first 4 of 9 conditions.");
  EXPECT_EQ(selection_words(4, 4, "conditions"), "");
  EXPECT_EQ(person_selection_words(explored()), " (one of 2 with recordings)");
}

}  // namespace report_movement_test
}  // namespace jnd::analysis
