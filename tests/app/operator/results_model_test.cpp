#include "app/operator/results_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "analysis/hand_made_study.h"
#include "analysis/results/number_words.h"
#include "app/environment.h"
#include "app/language/words.h"
#include "app/operator/simulated_study.h"
#include "app/results/results_output.h"
#include "core/error.h"
#include "core/storage/recording.h"
#include "support/places.h"
#include "support/temporary_folder.h"

namespace jnd::app {
namespace results_model_test {

using namespace results;
using analysis::HandMadeStudy;
using Tone = QualityChip::Tone;

ResultsModel model_of(const std::filesystem::path& folder) {
  WorkControl control;
  return results_model(folder, control);
}

/// Adds six participants who compare, with different numbers of right answers.
void add_six_comparers(HandMadeStudy& study) {
  for (const int right : {7, 8, 9, 8, 7, 9}) {
    static int number = 0;
    study.add("P0" + std::to_string(1 + number++ % 6));
    study.compare_ten("comparison", right);
  }
}

TEST(ResultsModel, EveryNumberIsTheOneOfTheResultsCommand) {
  HandMadeStudy study(kTinyStudy);
  add_six_comparers(study);
  const ResultsModel model = model_of(study.folder());
  const analysis::StudyResults results = results_of_folder(study.folder());
  EXPECT_EQ(model.study, "tiny");
  EXPECT_EQ(model.title, "Tiny");
  EXPECT_EQ(model.num_participants, 6);
  ASSERT_EQ(model.charts.size(), 1U);
  EXPECT_EQ(model.charts.front().heading, "Comparison");
  std::size_t num_estimates = 0;
  for (const analysis::ResultsSection& section : results.sections) {
    num_estimates += section.estimates.size();
  }
  EXPECT_EQ(model.numbers.size(), num_estimates);
}

TEST(ResultsModel, SectionsOfTheWholeStudyAreTitledInTheWindowsLanguage) {
  if (std::system("command -v msgfmt >/dev/null") != 0) GTEST_SKIP() << "no msgfmt";
  const EnvironmentVariable language("LANGUAGE", nullptr);
  SimulatedStudy study;
  study.simulate(1);
  const test_support::TemporaryFolder temporary;
  const std::filesystem::path compiled = temporary.path() / "de/LC_MESSAGES/jnd.mo";
  std::filesystem::create_directories(compiled.parent_path());
  const auto source = test_support::source_folder() / "data/languages/de.po";
  const std::string command =
      "msgfmt --output-file='" + compiled.string() + "' '" + source.string() + "'";
  ASSERT_EQ(std::system(command.c_str()), 0);
  const auto has = [&](const std::string& section) {
    const ResultsModel model = model_of(study.folder());
    return std::ranges::find(model.numbers, section, &NumberLine::section) !=
           model.numbers.end();
  };
  EXPECT_TRUE(has("Movement"));
  ASSERT_TRUE(begin_language(temporary.path(), "de"));
  const bool is_german = has("Bewegung");
  (void)begin_language(temporary.path(), "en");
  EXPECT_TRUE(is_german);
}

/// The answers are nine of ten right at 12, but with a pse above the reference.
void compare_above(HandMadeStudy& study) {
  study.compare_ten("comparison", 9);
  for (int answered = 0; answered < 10; ++answered) {
    study.compare("comparison", 9.0, 8.0, answered < 2);
  }
}

TEST(ResultsModel, ChartTableAndBoxOfAPersonHaveTheOneFractionThatIsPrimary) {
  HandMadeStudy study(kTinyStudy);
  for (const char* name : {"P01", "P02"}) {
    study.add(name);
    compare_above(study);
  }
  const ResultsModel model = model_of(study.folder());
  const double w = model.rows[0].values[0].value();
  EXPECT_EQ(model.charts.front().participants[0].value,
            "w = " + analysis::number_words(w, w < 0.1 ? 3 : 2));
  const auto weber = std::ranges::find(model.boxes, "weber_fraction", &BoxFigure::name);
  EXPECT_DOUBLE_EQ(weber->boxes.at(0).plot.median, w);
  const analysis::StudyResults results = results_of_folder(study.folder());
  for (const analysis::ResultsSection& section : results.sections) {
    for (const analysis::ParticipantEstimate& one : section.participants) {
      if (one.participant == "P01" && one.name == "comparison.weber_fraction") {
        EXPECT_GT(std::fabs(*one.value - w), 0.05) << "or this says nothing";
      }
    }
  }
}

TEST(ResultsModel, WhoAnswersTheWrongWayRoundIsNamedInChipTableAndBesideTheNumber) {
  HandMadeStudy study(kTinyStudy);
  for (int i = 1; i <= 5; ++i) {
    study.add("P0" + std::to_string(i));
    study.compare_ten("comparison", i == 5 ? 1 : 8 + i % 2);
  }
  const ResultsModel model = model_of(study.folder());
  EXPECT_TRUE(std::ranges::any_of(model.quality, [](const QualityChip& chip) {
    return chip.tone == Tone::kWarning && chip.text.starts_with("P05: Comparison: the answers");
  }));
  EXPECT_NE(model.rows[4].note.find("wrong way round"), std::string::npos);
  EXPECT_NE(model.charts.front().everybody->caution.find("P05"), std::string::npos);
  const auto number = std::ranges::find(
      model.numbers, "comparison.weber_fraction_median_person", &NumberLine::name);
  EXPECT_NE(number->caution.find("P05"), std::string::npos);
  EXPECT_TRUE(number->meaning.starts_with("primary value: "));
}

TEST(ResultsModel, ADegenerateFitHasNoNumberInTheTableButANote) {
  HandMadeStudy study(kTinyStudy);
  study.add("P01");
  study.compare_ten("comparison", 10);
  const ResultsModel model = model_of(study.folder());
  EXPECT_NE(model.rows.front().note.find("no Weber fraction"), std::string::npos);
  EXPECT_FALSE(model.rows.front().values.front().has_value());
}

TEST(ResultsModel, BoxesOfWeberFractionsHaveThePseOfThePrimaryValueAndSaySo) {
  HandMadeStudy study(kTinyStudy);
  add_six_comparers(study);
  const ResultsModel model = model_of(study.folder());
  const auto weber = std::ranges::find(model.boxes, "weber_fraction", &BoxFigure::name);
  ASSERT_NE(weber, model.boxes.end());
  EXPECT_EQ(weber->boxes.at(0).label, "Comparison, pse free");
  EXPECT_EQ(weber->boxes.at(0).n, 6);
}

TEST(BoxOf, HasQuartilesWhiskersAndOutliersAsWorkedByHand) {
  // 1 2 3 4 5 100 has the quartiles 2.25 and 4.75, and the fences -1.5 and 8.5.
  const Box box = box_of("x", {{"a", 5}, {"b", 1}, {"c", 3}, {"d", 100}, {"e", 2}, {"f", 4}});
  EXPECT_DOUBLE_EQ(box.plot.median, 3.5);
  EXPECT_DOUBLE_EQ(box.plot.lower_quartile, 2.25);
  EXPECT_DOUBLE_EQ(box.plot.upper_quartile, 4.75);
  EXPECT_EQ(box.plot.lower_whisker, 1.0);
  EXPECT_EQ(box.plot.upper_whisker, 5.0);
  ASSERT_EQ(box.outliers.size(), 1U);
  EXPECT_EQ(box.outliers[0].participant, "d");
  EXPECT_EQ(box.n, 6);
}

TEST(BoxOf, HasOutliersOnBothSides) {
  const Box box =
      box_of("x", {{"a", -5}, {"b", -1}, {"c", -3}, {"d", -100}, {"e", -2}, {"f", -4}});
  EXPECT_EQ(box.plot.lower_whisker, -5.0);
  ASSERT_EQ(box.outliers.size(), 1U);
  EXPECT_EQ(box.outliers[0].value, -100.0);
}

TEST(BoxOf, OneValueIsABoxOfNoHeight) {
  const Box box = box_of("x", {{"a", 5}});
  EXPECT_EQ(box.plot.lower_whisker, 5.0);
  EXPECT_EQ(box.plot.median, 5.0);
  EXPECT_EQ(box.plot.upper_whisker, 5.0);
  EXPECT_TRUE(box.outliers.empty());
}

TEST(ResultsModel, BoxesAndTableHoldWhatTheMeansOfMovementRestOn) {
  SimulatedStudy study;
  study.simulate(5);
  const ResultsModel model = model_of(study.folder());
  const analysis::StudyResults results = results_of_folder(study.folder());
  const auto speed = std::find_if(model.boxes.begin(), model.boxes.end(), [](const auto& box) {
    return box.name == "max_speed_m_per_s";
  });
  ASSERT_NE(speed, model.boxes.end());
  EXPECT_EQ(speed->boxes.size(), 3U);
  EXPECT_EQ(speed->boxes[0].label, "Estimation") << "as the study file has them";
  EXPECT_EQ(speed->boxes[0].n, 5);
  const auto column = std::find_if(model.columns.begin(), model.columns.end(),
                                   [](const auto& one) { return one.title == "Speed"; }) -
                      model.columns.begin();
  double sum = 0.0;
  ASSERT_EQ(model.rows.size(), 5U);
  for (const TableRow& row : model.rows) {
    ASSERT_EQ(row.values.size(), model.columns.size());
    sum += row.values.at(column).value();
  }
  EXPECT_NEAR(sum / 5.0, results.find("max_speed_m_per_s")->value.value(), 1e-12);
}

bool has_chip(const ResultsModel& model, const std::string& text, Tone tone) {
  return std::any_of(model.quality.begin(), model.quality.end(), [&](const QualityChip& chip) {
    return chip.text == text && chip.tone == tone;
  });
}

TEST(ResultsModel, ChipsSayHowGoodTheDataAre) {
  SimulatedStudy study;
  study.simulate(2, /*record=*/true);
  ResultsModel model = model_of(study.folder());
  EXPECT_TRUE(model.simulated);
  EXPECT_TRUE(has_chip(model, "simulated data", Tone::kWarning));
  EXPECT_TRUE(has_chip(model, "20 of 20 answers", Tone::kGood));
  EXPECT_TRUE(has_chip(model, "no gap in 2 recordings", Tone::kGood));

  (void)study.interrupt(3);
  (void)study.interrupt(1, /*pilot=*/true);
  {
    const core::StudyStore store(study.folder(), core::StudyStore::Mode::kReadOnly);
    const std::int64_t last = core::RecordingReader(store.recording_file(1)).last_tick();
    core::RecordingWriter writer(store.recording_file(1), 1000.0);
    core::Sample sample;
    sample.tick = last + 1 + 7;
    writer.append(sample);
  }
  model = model_of(study.folder());
  EXPECT_TRUE(has_chip(model, "23 of 30 answers", Tone::kWarning));
  EXPECT_TRUE(has_chip(model, "1 session not finished", Tone::kWarning));
  EXPECT_TRUE(has_chip(model, "1 pilot left out", Tone::kNeutral));
  EXPECT_TRUE(has_chip(model, "7 samples missing in 3 recordings", Tone::kWarning));
}

TEST(ResultsModel, TrialsSetAsideAndExcludedParticipantsAreNamed) {
  HandMadeStudy study(kTinyStudy);
  study.add("P01");
  study.compare_ten("comparison", 8);
  study.exclude(1);
  study.add("P02");
  study.estimate(1.0, 100.0);
  const ResultsModel model = model_of(study.folder());
  EXPECT_TRUE(has_chip(model, "1 trial set aside", Tone::kWarning));
  EXPECT_TRUE(has_chip(model, "no recordings kept", Tone::kNeutral));
  EXPECT_TRUE(has_chip(model, "P02: no answers in Comparison", Tone::kWarning));
}

/// Returns a study in which everybody compares in both Group D and Group E.
std::string two_groups() {
  return replaced(
      replaced(kTinyStudy, R"("name": "production", "procedure": "magnitude_production",
     "medium": "water", "scale": [1, 2], "target_percent": [100],
     "coarse_step_scale": 0.5, "fine_step_scale": 0.25,)",
               R"("name": "group_d", "title": {"en": "Group D"},
     "procedure": "constant_stimuli", "medium": "viscous", "viscosity_pa_s": [4, 16],
     "reference_viscosity_pa_s": 8, "repetitions": 2,)"),
      R"("name": "comparison",)", R"("name": "group_e", "title": {"en": "Group E"},)");
}

TEST(ResultsModel, ComparisonsAreInWordsWithTheTitlesOfBlocks) {
  HandMadeStudy study(two_groups());
  for (const char* name : {"P01", "P02", "P03"}) {
    study.add(name);
    study.compare_ten("group_d", 6 + name[2] - '0');
    study.compare_ten("group_e", 8);
  }
  const ResultsModel model = model_of(study.folder());
  ASSERT_FALSE(model.comparisons.empty());
  EXPECT_TRUE(model.comparisons.front().is_primary) << model.comparisons.front().name;
  EXPECT_TRUE(model.comparisons.front().name.starts_with("Group D - Group E"));
  EXPECT_NE(model.comparisons.front().detail.find("exploratory, every two blocks"),
            std::string::npos)
      << model.comparisons.front().detail;
  const auto of_groups =
      std::ranges::find_if(model.comparisons, [](const ComparisonLine& line) {
        return line.name.starts_with("Group D - Group E: ln ln(1 + w), paired");
      });
  ASSERT_NE(of_groups, model.comparisons.end());
  const ComparisonLine& first = *of_groups;
  EXPECT_TRUE(first.estimate.has_value());
  EXPECT_NE(first.detail.find("95 % "), std::string::npos) << first.detail;
  EXPECT_NE(first.detail.find("t(2) = "), std::string::npos) << first.detail;
  EXPECT_NE(first.detail.find("p = 0."), std::string::npos) << first.detail;
  EXPECT_TRUE(std::ranges::any_of(model.comparisons, [](const ComparisonLine& line) {
    return line.detail.find("V = ") != std::string::npos;
  })) << "tests of ranks name their statistic";
  EXPECT_TRUE(std::ranges::none_of(model.comparisons, [](const ComparisonLine& line) {
    return line.name.find("troke") != std::string::npos;
  })) << "nobody moved";
}

TEST(ResultsModel, AComparisonWithoutAValueSaysWhy) {
  HandMadeStudy study(two_groups());
  study.add("P01");
  study.compare_ten("group_d", 10);
  study.compare_ten("group_e", 10);
  const ResultsModel model = model_of(study.folder());
  const auto without = std::ranges::find_if(
      model.comparisons, [](const ComparisonLine& line) { return !line.estimate; });
  ASSERT_NE(without, model.comparisons.end());
  EXPECT_FALSE(without->detail.empty());
}

TEST(ResultsModel, ADoubleBlindStudyIsRefusedInTheWordsOfEveryCommand) {
  SimulatedStudy study(kDoubleBlindStudy);
  study.simulate(1);
  std::string expected;
  try {
    (void)results_of_folder(study.folder());
  } catch (const core::Error& error) {
    expected = error.what();
  }
  BackgroundTask<ResultsModel> task(
      [&](WorkControl& control) { return results_model(study.folder(), control); });
  task.wait();
  EXPECT_EQ(task.status(), WorkStatus::kFailed);
  EXPECT_NE(task.error().find("nobody has unblinded"), std::string::npos);
  EXPECT_EQ(task.error(), expected);
  core::StudyStore(study.folder(), core::StudyStore::Mode::kReadWrite)
      .add_unblinding(1, "done");
  EXPECT_NO_THROW((void)model_of(study.folder()));
}

TEST(ResultsModel, StopsBetweenItsPartsWhenItIsCancelled) {
  SimulatedStudy study;
  study.simulate(1);
  WorkControl control;
  control.cancel();
  EXPECT_THROW((void)results_model(study.folder(), control), WorkCancelled);
}

}  // namespace results_model_test
}  // namespace jnd::app
