#include "app/operator/results_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "analysis/hand_made_study.h"
#include "analysis/statistics/wilson_interval.h"
#include "app/operator/simulated_study.h"
#include "app/results/results_output.h"
#include "core/error.h"
#include "core/storage/recording.h"

namespace jnd::app {
namespace results_model_test {

using namespace results;
using analysis::HandMadeStudy;
using Tone = QualityChip::Tone;

ResultsModel model_of(const std::filesystem::path& folder) {
  WorkControl control;
  return results_model(folder, control);
}

/// Six participants who compare, each with another number of right answers.
void add_six_comparers(HandMadeStudy& study) {
  for (const int right : {7, 8, 9, 8, 7, 9}) {
    static int number = 0;
    study.add("P0" + std::to_string(1 + number++ % 6));
    study.compare_ten("comparison", right);
  }
}

double y_at(const std::vector<Point>& curve, double x) {
  const auto next = std::find_if(curve.begin(), curve.end(),
                                 [x](const Point& point) { return point.x >= x; });
  if (next == curve.begin() || next == curve.end()) return NAN;
  const Point& before = *std::prev(next);
  return before.y + (next->y - before.y) * (x - before.x) / (next->x - before.x);
}

TEST(ResultsModel, EveryNumberIsTheOneOfTheResultsCommand) {
  HandMadeStudy study(kTinyStudy);
  add_six_comparers(study);
  const ResultsModel model = model_of(study.folder());
  const analysis::StudyResults results = results_of_folder(study.folder());
  EXPECT_EQ(model.study, "tiny");
  EXPECT_EQ(model.title, "Tiny");
  EXPECT_EQ(model.num_participants, 6);
  ASSERT_EQ(model.discriminations.size(), 1U);
  const Discrimination& figure = model.discriminations.front();
  EXPECT_EQ(figure.title, "Comparison");
  EXPECT_EQ(figure.quantity, "viscosity");
  EXPECT_EQ(figure.unit, "Pa s");
  EXPECT_EQ(figure.reference, 8.0);
  const analysis::Estimate& person = *results.find("comparison.weber_fraction_median_person");
  ASSERT_TRUE(person.primary);
  EXPECT_EQ(figure.pooled.weber_fraction, person.value);
  EXPECT_EQ(figure.pooled.ci95.low, person.ci95.low);
  EXPECT_EQ(figure.pooled.ci95.high, person.ci95.high);
  EXPECT_EQ(figure.pooled.pse, results.find("comparison.pse_median_person")->value);
  EXPECT_FALSE(figure.pooled.pooled_curve.empty());
  std::size_t own = 0;
  for (const analysis::ResultsSection& section : results.sections) {
    for (const analysis::ParticipantEstimate& one : section.participants) {
      if (one.name != "comparison.weber_fraction_free_pse") continue;
      EXPECT_TRUE(one.primary);
      const PsychometricFigure& drawn = figure.participants.at(own++);
      EXPECT_EQ(drawn.who, one.participant);
      EXPECT_EQ(drawn.weber_fraction, one.value);
      EXPECT_EQ(drawn.ci95.low, one.ci95.low);
    }
  }
  EXPECT_EQ(own, 6U);
  std::size_t num_estimates = 0;
  for (const analysis::ResultsSection& section : results.sections) {
    num_estimates += section.estimates.size();
  }
  EXPECT_EQ(model.numbers.size(), num_estimates);
}

TEST(ResultsModel, PointsAreProportionsWithWilsonsIntervals) {
  HandMadeStudy study(kTinyStudy);
  add_six_comparers(study);
  const Discrimination figure = model_of(study.folder()).discriminations.front();
  ASSERT_EQ(figure.pooled.points.size(), 2U);
  const Proportion& upper = figure.pooled.points[1];
  EXPECT_DOUBLE_EQ(upper.intensity, 12.0);
  EXPECT_EQ(upper.num_trials, 60);
  EXPECT_EQ(upper.num_yes, 48);
  EXPECT_DOUBLE_EQ(upper.ratio, 0.8);
  EXPECT_EQ((std::pair{upper.low, upper.high}), analysis::wilson_interval(48, 60));
  EXPECT_EQ(figure.participants[2].points[1].num_yes, 9);
}

TEST(ResultsModel, TheCurveIsHalfAtTheReferenceAndEightyFourPercentAtTheWeberLine) {
  HandMadeStudy study(kTinyStudy);
  add_six_comparers(study);
  const Discrimination figure = model_of(study.folder()).discriminations.front();
  EXPECT_NEAR(y_at(figure.pooled.curve, 8.0), 0.5, 1e-3);
  EXPECT_DOUBLE_EQ(*figure.pooled.weber_line,
                   figure.pooled.pse * (1.0 + *figure.pooled.weber_fraction));
  const PsychometricFigure& steep = figure.participants[2];
  EXPECT_NEAR(y_at(steep.curve, *steep.weber_line), 0.8413, 1e-3);
  // Through everybody's answers: 80 % right at 1.5 times the reference.
  EXPECT_NEAR(y_at(figure.pooled.pooled_curve, 12.0), 0.8, 1e-3);
}

/// As nine of ten right at 12, but with a pse above the reference.
void compare_above(HandMadeStudy& study) {
  study.compare_ten("comparison", 9);
  for (int answered = 0; answered < 10; ++answered) {
    study.compare("comparison", 9.0, 8.0, answered < 2);
  }
}

TEST(ResultsModel, CurveTableAndBoxOfAPersonHaveTheOneFractionThatIsPrimary) {
  HandMadeStudy study(kTinyStudy);
  for (const char* name : {"P01", "P02"}) {
    study.add(name);
    compare_above(study);
  }
  const ResultsModel model = model_of(study.folder());
  const PsychometricFigure& own = model.discriminations.front().participants[0];
  const double w = own.weber_fraction.value();
  EXPECT_EQ(model.rows[0].values[0], w);
  const auto weber = std::ranges::find(model.boxes, "weber_fraction", &BoxFigure::name);
  EXPECT_DOUBLE_EQ(weber->boxes.at(0).median, w);
  EXPECT_NEAR(y_at(own.curve, own.pse), 0.5, 1e-3);
  EXPECT_GT(own.pse, 8.2);
  const analysis::StudyResults results = results_of_folder(study.folder());
  for (const analysis::ResultsSection& section : results.sections) {
    for (const analysis::ParticipantEstimate& one : section.participants) {
      if (one.participant == "P01" && one.name == "comparison.weber_fraction") {
        EXPECT_GT(std::fabs(*one.value - w), 0.05) << "or this says nothing";
      }
    }
  }
  ASSERT_EQ(own.others.size(), 1U);
  EXPECT_TRUE(own.others[0].starts_with("with the PSE at the reference 0.")) << own.others[0];
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
  EXPECT_TRUE(std::ranges::any_of(
      model.discriminations.front().pooled.cautions,
      [](const std::string& one) { return one.find("P05") != std::string::npos; }));
  const auto number = std::ranges::find(
      model.numbers, "comparison.weber_fraction_median_person", &NumberLine::name);
  EXPECT_NE(number->caution.find("P05"), std::string::npos);
  EXPECT_TRUE(number->meaning.starts_with("primary value: "));
}

TEST(ResultsModel, TheBandLiesBetweenTheCurvesOfTheIntervalsEnds) {
  HandMadeStudy study(kTinyStudy);
  add_six_comparers(study);
  const Discrimination figure = model_of(study.folder()).discriminations.front();
  for (const PsychometricFigure* one : {&figure.pooled, &figure.participants[0]}) {
    ASSERT_EQ(one->band.size(), one->curve.size());
    for (std::size_t i = 0; i < one->band.size(); ++i) {
      EXPECT_LE(one->band[i].low, one->curve[i].y + 1e-12);
      EXPECT_GE(one->band[i].high, one->curve[i].y - 1e-12);
      EXPECT_EQ(one->band[i].x, one->curve[i].x);
    }
    const double w = one->ci95.low.value();
    const BandPoint& last = one->band.back();
    const double z = std::log(last.x / one->pse) / std::log1p(w);
    const double rise = 0.5 * std::erfc(-z / std::sqrt(2.0));
    EXPECT_NEAR(last.high, one->lapse_rate + (1.0 - 2.0 * one->lapse_rate) * rise, 1e-12);
  }
}

TEST(ResultsModel, AnOpenEndOfTheBandIsAFlatLine) {
  HandMadeStudy study(kTinyStudy);
  study.add("P01");
  study.compare_ten("comparison", 6);
  const Discrimination figure = model_of(study.folder()).discriminations.front();
  const PsychometricFigure& own = figure.participants.front();
  ASSERT_FALSE(own.ci95.high.has_value());
  EXPECT_EQ(own.band.back().low, 0.5);
  EXPECT_TRUE(figure.pooled.band.empty()) << "one participant says nothing of others";
}

TEST(ResultsModel, ADegenerateFitSaysWhyAndDrawsNoCurve) {
  HandMadeStudy study(kTinyStudy);
  study.add("P01");
  study.compare_ten("comparison", 10);
  const ResultsModel model = model_of(study.folder());
  const Discrimination& figure = model.discriminations.front();
  for (const PsychometricFigure* one : {&figure.pooled, &figure.participants[0]}) {
    EXPECT_FALSE(one->weber_fraction);
    EXPECT_FALSE(one->reason.empty());
    EXPECT_TRUE(one->curve.empty());
    EXPECT_EQ(one->points.size(), 2U);
  }
  EXPECT_NE(model.rows.front().note.find("no Weber fraction"), std::string::npos);
  EXPECT_FALSE(model.rows.front().values.front().has_value());
}

/// 2 I and 8 I in percent of hundreds; sets 2 and 8 for 100 %, 4 and 16 for 200 %.
void add_two_estimators(HandMadeStudy& study) {
  for (const auto& [name, k] : {std::pair{"P01", 2.0}, {"P02", 8.0}}) {
    study.add(name);
    for (const double intensity : {1.0, 2.0}) {
      study.estimate(intensity, 50.0 * k * intensity, 1);
      study.estimate(intensity, 150.0 * k * intensity, 2);
    }
    study.produce(100.0, k);
    study.produce(200.0, 2.0 * k);
  }
}

TEST(ResultsModel, MagnitudesHaveBothMeansWithTheirSpread) {
  HandMadeStudy study(kTinyStudy);
  add_two_estimators(study);
  const ResultsModel model = model_of(study.folder());
  ASSERT_EQ(model.magnitudes.size(), 1U);
  const Magnitude& figure = model.magnitudes.front();
  EXPECT_EQ(figure.title, "Estimation and Production");
  EXPECT_EQ(figure.quantity, "scaling factor");
  ASSERT_EQ(figure.pooled.estimation.size(), 2U);
  // The participants' own means are 2 and 8: mean 5, sd 3 sqrt 2, geometric mean 4.
  const Mean& first = figure.pooled.estimation[0];
  EXPECT_EQ(first.at, 1.0);
  EXPECT_EQ(first.n, 2);
  EXPECT_NEAR(first.arithmetic, 5.0, 1e-12);
  EXPECT_NEAR(first.arithmetic_high - 5.0, 3.0 * std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(first.geometric.value(), 4.0, 1e-12);
  EXPECT_NEAR(first.geometric_high.value() / 4.0, std::exp(std::log(4.0) / std::sqrt(2.0)),
              1e-9);
  ASSERT_EQ(figure.pooled.production.size(), 2U);
  EXPECT_DOUBLE_EQ(figure.pooled.production[1].at, 2.0);
  EXPECT_NEAR(figure.pooled.production[1].arithmetic, 10.0, 1e-12);
  // One participant's own: the answers 1 and 3 at intensity 1.
  EXPECT_EQ(figure.participants[0].estimation[0].n, 2);
  EXPECT_NEAR(figure.participants[0].estimation[0].arithmetic, 2.0, 1e-12);
}

TEST(ResultsModel, PowerCurvesAreThoseOfTheResultsOnALogLogPlot) {
  HandMadeStudy study(kTinyStudy);
  add_two_estimators(study);
  const Magnitude figure = model_of(study.folder()).magnitudes.front();
  const analysis::StudyResults results = results_of_folder(study.folder());
  EXPECT_EQ(figure.pooled.estimation_curve->k, results.find("estimation.k")->value);
  EXPECT_EQ(figure.pooled.production_curve->a, results.find("production.a")->value);
  EXPECT_EQ(figure.pooled.combined_curve->k, results.find("combined.k")->value);
  EXPECT_NEAR(*figure.participants[1].estimation_curve->k, 8.0, 1e-6);
  EXPECT_NEAR(*figure.pooled.estimation_curve->k, 5.0, 1e-6);
  for (const Point& point : figure.pooled.estimation_curve->curve) {
    EXPECT_NEAR(point.y, 5.0 * point.x, 1e-5);
  }
  EXPECT_GT(figure.pooled.estimation_curve->curve.size(), 50U);
}

TEST(ResultsModel, APowerLawThatDoesNotExistSaysWhy) {
  HandMadeStudy study(kTinyStudy);
  study.add("P01");
  study.estimate(1.0, 100.0);
  const Magnitude figure = model_of(study.folder()).magnitudes.front();
  EXPECT_FALSE(figure.pooled.estimation_curve->k);
  EXPECT_FALSE(figure.pooled.estimation_curve->reason.empty());
  EXPECT_TRUE(figure.pooled.estimation_curve->curve.empty());
  EXPECT_FALSE(figure.pooled.production_curve.has_value());
  EXPECT_FALSE(figure.pooled.combined_curve.has_value());
}

TEST(ResultsModel, AnAnswerOfZeroHasNoGeometricMean) {
  HandMadeStudy study(kTinyStudy);
  study.add("P01");
  study.estimate(1.0, 0.0);
  study.estimate(2.0, 100.0);
  study.add("P02");
  study.estimate(1.0, 50.0);
  const Magnitude figure = model_of(study.folder()).magnitudes.front();
  EXPECT_FALSE(figure.pooled.estimation[0].geometric.has_value());
  EXPECT_TRUE(figure.pooled.estimation[1].geometric.has_value());
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
  // 1 2 3 4 5 100: quartiles 2.25 and 4.75, fences -1.5 and 8.5.
  const Box box = box_of("x", {{"a", 5}, {"b", 1}, {"c", 3}, {"d", 100}, {"e", 2}, {"f", 4}});
  EXPECT_DOUBLE_EQ(box.median, 3.5);
  EXPECT_DOUBLE_EQ(box.lower_quartile, 2.25);
  EXPECT_DOUBLE_EQ(box.upper_quartile, 4.75);
  EXPECT_EQ(box.lower_whisker, 1.0);
  EXPECT_EQ(box.upper_whisker, 5.0);
  ASSERT_EQ(box.outliers.size(), 1U);
  EXPECT_EQ(box.outliers[0].participant, "d");
  EXPECT_EQ(box.n, 6);
}

TEST(BoxOf, HasOutliersOnBothSides) {
  const Box box =
      box_of("x", {{"a", -5}, {"b", -1}, {"c", -3}, {"d", -100}, {"e", -2}, {"f", -4}});
  EXPECT_EQ(box.lower_whisker, -5.0);
  ASSERT_EQ(box.outliers.size(), 1U);
  EXPECT_EQ(box.outliers[0].value, -100.0);
}

TEST(BoxOf, OneValueIsABoxOfNoHeight) {
  const Box box = box_of("x", {{"a", 5}});
  EXPECT_EQ(box.lower_whisker, 5.0);
  EXPECT_EQ(box.median, 5.0);
  EXPECT_EQ(box.upper_whisker, 5.0);
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

/// Group D and Group E, which everybody compares in.
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
