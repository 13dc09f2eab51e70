#include "analysis/report/report.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <set>

#include "analysis/charts/study_titles.h"
#include "analysis/hand_made_study.h"
#include "analysis/report/data_quality.h"
#include "analysis/report/figures.h"
#include "analysis/report/html_text.h"
#include "analysis/report/report_results.h"
#include "core/error.h"
#include "support/files.h"

namespace jnd::analysis {
namespace report_test {

namespace fs = std::filesystem;
using test_support::read_file;

constexpr char kProtocol[] = R"json({"name": "by_hand", "title": {"de": "Von Hand",
  "en": "By <hand>"}, "authors": ["A. & B."], "blinding": "participant", "stages": [
  {"kind": "block", "name": "estimation", "procedure": "magnitude_estimation", "title": {"en": "How strong"}},
  {"kind": "counterbalance", "name": "order", "arms": [{"name": "one", "stages": [
    {"kind": "block", "name": "group_d", "procedure": "constant_stimuli", "title": {"en": "Group D: thin"}}]}]}]})json";

const std::string kLaboratory = R"({"name": "test"})";

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

std::string without_breaks(std::string html) {
  const std::string mark = "<wbr>";
  for (std::size_t at = html.find(mark); at != std::string::npos; at = html.find(mark, at)) {
    html.erase(at, mark.size());
  }
  return html;
}

/// Returns report and supplement together.
std::string whole(const ReportOutcome& outcome) {
  return read_file(outcome.html) + read_file(outcome.supplement_html);
}
std::string whole_report(const ReportSource& source, const std::vector<Figure>& figures,
                         const std::vector<DrawnFigure>& drawn) {
  return report_html(source, figures, drawn) + supplement_html(source, figures, drawn);
}

/// Three people did an estimation, a production and one comparison. The last person tells
/// nothing apart.
class ReportTest : public ::testing::Test {
 protected:
  ReportTest() {
    for (const char* name : {"P01", "P02", "P03"}) {
      (void)study_.add(name, false, kLaboratory);
      for (std::int64_t repetition = 1; repetition <= 2; ++repetition) {
        for (const double scale : {0.0, 1.0, 2.0, 4.0}) {
          study_.estimate(scale, 60.0 * scale + static_cast<double>(repetition), repetition);
        }
      }
      for (const double target : {50.0, 100.0, 200.0}) study_.produce(target, target / 80.0);
      study_.compare_ten("group_d", name == std::string("P03") ? 5 : 8);
      study_.compare_ten("group_e", name == std::string("P03") ? 10 : 7);
    }
  }

  ReportOutcome report(const fs::path& folder, const ReportOptions& options = {},
                       bool pilot = false) {
    const StudyData data = load_study(study_.store(), pilot);
    const ResultsOptions results_options{.num_resamples = 100};
    const Published published{
        .citation = "Somebody (2018).",
        .values = {
            {"group_d.weber_fraction", {.value = 0.697, .place = "somewhere"}},
            {"estimation.k", {.value = 60.0, .standard_deviation = 5.0, .place = "somewhere"}},
            {"group_d.individual_weber_fraction_lsq_mean",
             {.value = 0.72,
              .place = "app. D",
              .statistic = "mean of individual Weber fractions, least squares",
              .compute = PublishedStatistic{
                  .kind = PublishedStatistic::Kind::kOwnWeberFractions, .block = "group_d"}}}}};
    const StudyResults results = results_of(data, published, results_options);
    const MovementAnalysis movement = analyse_movement(study_.store(), {.pilot = pilot});
    return write_report({.store = study_.store(),
                         .data = data,
                         .results = results,
                         .results_options = results_options,
                         .movement = movement,
                         .program_version = "1.2.3",
                         .pilot = pilot},
                        folder, options);
  }
  [[nodiscard]] fs::path out(const std::string& name = "out") const {
    return temporary_.path() / name;
  }
  /// Makes a program that stands for a browser or gnuplot.
  fs::path tool(const std::string& name, const std::string& text) {
    const fs::path file = temporary_.path() / name;
    std::ofstream(file) << "#!/bin/sh\n" << text;
    fs::permissions(file, fs::perms::owner_all);
    return file;
  }

  HandMadeStudy study_{kProtocol};
  test_support::TemporaryFolder temporary_{test_support::memory_folder()};
};

TEST_F(ReportTest, ShowsEveryEstimateAndComparisonThatTheResultsHave) {
  const std::string html = without_breaks(whole(report(out())));
  const StudyData data = load_study(study_.store());
  const StudyResults results = results_of(data, {}, {.num_resamples = 100});
  const StudyTitles titles = titles_of(data.written);
  for (const ResultsSection& section : results.sections) {
    for (const Estimate& estimate : section.estimates) {
      if (section.name == "questionnaires") continue;  // Each row is an item, not an estimate.
      EXPECT_TRUE(has(html, "<code>" + estimate.name + "</code>")) << estimate.name;
    }
    for (const NamedComparison& named : section.comparisons) {
      EXPECT_TRUE(has(html, html_escaped(titles.titled(named.name)))) << named.name;
    }
  }
  EXPECT_TRUE(has(html, "0.697")) << "the published value";
  EXPECT_TRUE(has(html, "Somebody (2018)."));
}

TEST_F(ReportTest, OfPublishedValuesSaysWhatTheyAre) {
  const std::string html = without_breaks(whole(report(out())));
  EXPECT_TRUE(has(html, "<code>group_d.individual_weber_fraction_lsq_mean</code>"))
      << "an estimate of its own, for it is published of another statistic than ours";
  EXPECT_TRUE(has(html, "mean of individual Weber fractions, least squares"));
  EXPECT_TRUE(has(html, "b is the standard deviation between participants"));
  EXPECT_FALSE(has(html, "Simulated studies")) << "none are known";
}

TEST_F(ReportTest, OfAStudyWithoutTrialsSpeaksOfNone) {
  HandMadeStudy study(R"({"name": "by_hand", "blinding": "participant"})");
  (void)study.add("P01", false, kLaboratory);
  study.say("about", "age_years", "26");
  const StudyData data = load_study(study.store());
  const StudyResults results = results_of(data, {}, {.num_resamples = 100});
  const std::string html = without_breaks(whole_report({.store = study.store(),
                                                        .data = data,
                                                        .results = results,
                                                        .results_options = {},
                                                        .movement = {},
                                                        .program_version = "1"},
                                                       {}, {}));
  EXPECT_TRUE(has(html, "This study has no trials"));
  for (const char* none :
       {"0 of 0", "no whole stroke", "Weber", "Blinding", ">Drawn<", "p value", "Hesterberg"}) {
    EXPECT_FALSE(has(html, none)) << none;
  }
}

TEST(PublishedFigure, AnIntervalThatIsCutEndsInAnArrow) {
  const auto plot_of = [](double low) {
    const StudyData data;
    StudyResults results;
    results.sections.push_back({.name = "group_d",
                                .estimates = {{.name = "group_d.weber_fraction",
                                               .value = 0.4,
                                               .ci95 = {low, 0.5},
                                               .published = 0.4}}});
    return published_figures({data, results, {}}).at(0).plot;
  };
  EXPECT_TRUE(has(plot_of(0.01), "to graph 0,"));
  EXPECT_FALSE(has(plot_of(0.3), "to graph 0,"));
}

TEST(PublishedFigure, OfSimulatedStudiesIsADistributionAndAPoint) {
  const StudyData data;
  StudyResults results{.simulated = true};
  PredictiveTail tail{.values = {0.2, 0.3, 0.3, 0.4}, .median = 0.3, .low = 0.2, .high = 0.4};
  tail.tail = 0.25;
  results.predictive = {.num_people = 52, .num_studies = 4, .num_participants = 13};
  Estimate estimate{.name = "group_d.weber_fraction", .value = 0.35, .published = 0.25};
  estimate.predictive = tail;
  results.sections.push_back({.name = "group_d", .estimates = {estimate}});
  const Figure figure = published_figures({data, results, {}}).at(0);
  EXPECT_EQ(figure.name, "published");
  ASSERT_EQ(figure.tables.size(), 2U);
  int num_studies = 0;
  for (const auto& row : figure.tables[0].rows) {
    num_studies += static_cast<int>(row[4].number.value_or(0.0));
  }
  EXPECT_EQ(num_studies, 4) << "every study in one bin";
  ASSERT_EQ(figure.tables[1].rows.size(), 1U);
  EXPECT_EQ(figure.tables[1].rows[0][2].number, 0.25) << "the published value";
  EXPECT_EQ(figure.tables[1].rows[0][3].number, 0.35) << "this run";
  EXPECT_TRUE(has(figure.caption, "4 simulated studies of 13 participants"));
}

TEST_F(ReportTest, SaysWhatWasRunWithWhichSeedsAndHashes) {
  const std::string html = without_breaks(whole(report(out())));
  const core::ProtocolRow protocol =
      study_.store().protocol(load_study(study_.store()).protocol_sha256);
  EXPECT_TRUE(has(html, protocol.sha256));
  EXPECT_TRUE(has(html, "By &lt;hand&gt;"));
  EXPECT_TRUE(has(html, "A. &amp; B."));
  EXPECT_TRUE(has(html, "jnd 1.2.3"));
  EXPECT_TRUE(has(html, "levels 0, 1, 2, 4"));
  EXPECT_TRUE(has(html, "set to feel like 50, 100, 200 %"));
  EXPECT_TRUE(has(html, "Group D: thin")) << "a title inside of an arm";
  EXPECT_TRUE(has(html, data_sha256(study_.store(), study_.store().sessions())));
}

TEST_F(ReportTest, SimulatedDataSaySoAtTheTopOnEveryPageAndInEveryFigure) {
  const ReportOutcome outcome = report(out());
  const std::string html = read_file(outcome.html);
  EXPECT_TRUE(has(html, "<p class=\"banner\">SIMULATED"));
  EXPECT_TRUE(has(html, "@top-right { content: \"SIMULATED data\""));
  ASSERT_FALSE(outcome.figures.empty());
  for (const Figure& figure : outcome.figures) {
    EXPECT_TRUE(has(read_file(out() / "figures" / (figure.name + ".gp")), "SIMULATED"))
        << figure.name;
  }
}

TEST_F(ReportTest, HasTheFiguresThatThereAreDataForAndTheirTables) {
  const ReportOutcome outcome = report(out());
  std::set<std::string> names;
  for (const Figure& figure : outcome.figures) {
    EXPECT_TRUE(names.insert(figure.name).second) << figure.name << " twice";
    EXPECT_FALSE(figure.caption.empty()) << figure.name;
    EXPECT_FALSE(figure.tables.empty()) << figure.name;
    for (const FigureTable& table : figure.tables) {
      EXPECT_TRUE(fs::exists(out() / "figures" / (table.name + ".csv"))) << table.name;
      for (const auto& row : table.rows) {
        ASSERT_EQ(row.size(), table.columns.size()) << table.name;
      }
    }
  }
  for (const char* name :
       {"published", "estimation_curves", "estimation_boxes", "estimation_repetitions",
        "production_curves", "production_boxes", "production_ratios", "power_laws",
        "group_d_psychometric", "group_d_participants", "group_e_psychometric",
        "weber_fractions", "difference_thresholds"}) {
    EXPECT_TRUE(names.contains(name)) << name;
  }
  EXPECT_FALSE(names.contains("joint_angles")) << "nothing was recorded";
}

TEST_F(ReportTest, WordsOfTheThesisStandInItsOwnStudiesAlone) {
  const StudyData data = load_study(study_.store());
  const StudyTitles titles;
  const auto figure_of = [&](const std::string& citation) {
    const StudyResults results =
        results_of(data, {.citation = citation}, {.num_resamples = 50});
    return weber_figures({.data = data, .results = results, .titles = titles}).at(1);
  };
  const Figure thesis = figure_of("Schmidt, A. (2018). Viscosity Perception.");
  EXPECT_EQ(thesis.name, "absolute_thresholds");
  EXPECT_TRUE(has(thesis.caption, "(Schmidt 2018 calls it the absolute threshold). One"));
  for (const char* other : {"", "Jones, L. A. (1993). After Schmidt, A. (2018)."}) {
    const Figure figure = figure_of(other);
    EXPECT_EQ(figure.name, "difference_thresholds");
    EXPECT_EQ(figure.tables.front().name, "difference_thresholds_boxes");
    EXPECT_FALSE(has(figure.caption, "Schmidt")) << figure.caption;
    EXPECT_TRUE(has(figure.caption, "times the reference. One circle")) << figure.caption;
  }
  EXPECT_FALSE(has(whole(report(out())), "<th>Schmidt (2018)")) << "of Somebody (2018)";
}

TEST_F(ReportTest, TellsBothNumbersOfTwoGroupsAndOneOfPairs) {
  const StudyData data = load_study(study_.store());
  Comparison welch = welch_t_test({1.0, 2.0, 4.0}, {2.0, 3.0, 6.0});
  Comparison paired = paired_t_test({1.0, 2.0, 4.0}, {2.0, 3.0, 6.0});
  const StudyResults results{.study = "by_hand"};
  const auto written = [&](const Comparison& comparison) {
    HtmlText html;
    write_section(html, data, results, {},
                  {.name = "x", .comparisons = {{.name = "test", .comparison = comparison}}});
    return html.text();
  };
  EXPECT_TRUE(has(written(welch), ">3, 3<")) << written(welch);
  EXPECT_FALSE(has(written(paired), ">3, 3<"));
  EXPECT_TRUE(has(written(paired), ">3<"));
}

TEST_F(ReportTest, OfAdaptiveBlocksTellsWhatWasRunAndOfPracticeWhatItWas) {
  HandMadeStudy study(R"json({"name": "by_hand", "stages": [
    {"kind": "block", "name": "warm_up", "procedure": "constant_stimuli", "medium": "viscous",
     "task": "two_interval", "feedback": true, "viscosity_pa_s": [16, 4],
     "reference_viscosity_pa_s": 8,
     "practice": {"min_correct_ratio": 0.8, "num_trials_judged": 5, "max_trials": 20}},
    {"kind": "block", "name": "thicker", "procedure": "staircase", "medium": "viscous",
     "reference_viscosity_pa_s": 8, "start_viscosity_pa_s": [12],
     "lowest_viscosity_pa_s": 1, "highest_viscosity_pa_s": 64, "step_ratio": [2]}]})json");
  for (const auto& [name, num] : {std::pair("P01", 4), std::pair("P02", 7)}) {
    (void)study.add(name, false, kLaboratory);
    for (int i = 0; i < num; ++i) {
      (void)study.answer({.block = "thicker",
                          .procedure = "staircase",
                          .quantity = "viscosity_pa_s",
                          .repetition = 1,
                          .intensity = 9.0 + i,
                          .reference_intensity = 8.0,
                          .response = i % 2});
    }
  }
  const StudyData data = load_study(study.store());
  const StudyResults results = results_of(data, {}, {.num_resamples = 50});
  const std::string html = without_breaks(whole_report({.store = study.store(),
                                                        .data = data,
                                                        .results = results,
                                                        .results_options = {},
                                                        .movement = {},
                                                        .program_version = "1"},
                                                       {}, {}));
  EXPECT_TRUE(has(html, "trials a participant as the answers led to: mean 5.5, from 4 to 7."));
  EXPECT_FALSE(has(html, "7 trials a participant"));
  EXPECT_TRUE(has(html, "; 7 levels from 9 to 15 Pa s; reference 8 Pa s; trials"));
  EXPECT_TRUE(has(html,
                  "as a two-interval task (order drawn); viscosity; levels 4, 16 Pa s; "
                  "reference 8 Pa s; participants were told after every answer whether it was "
                  "right; until 80 % of the last 5 answers were right, at most 20 trials."));
}

TEST_F(ReportTest, MethodsTellHowTheOrderOfTheIntervalsCameAboutAndLeaveNoGap) {
  HandMadeStudy study(R"json({"name": "by_hand", "stages": [
    {"kind": "block", "name": "warm_up", "procedure": "staircase", "medium": "viscous", "task": "two_interval",
     "interval_order": "balanced", "reference_viscosity_pa_s": 8,
     "start_viscosity_pa_s": [12], "lowest_viscosity_pa_s": 8.1,
     "practice": {"min_correct_ratio": 0.8, "num_trials_judged": 5, "max_trials": 20}},
    {"kind": "block", "name": "thicker", "procedure": "constant_stimuli", "task": "two_interval",
     "interval_order": "balanced"}]})json");
  (void)study.add("P01", false, kLaboratory);
  study.compare_ten("thicker", 8);
  const StudyData data = load_study(study.store());
  const StudyResults results = results_of(data, {}, {.num_resamples = 50});
  const std::string html = without_breaks(whole_report({.store = study.store(),
                                                        .data = data,
                                                        .results = results,
                                                        .results_options = {},
                                                        .movement = {},
                                                        .program_version = "1"},
                                                       {}, {}));
  EXPECT_TRUE(has(html,
                  "staircase as a two-interval task (order balanced); viscosity; "
                  "reference 8 Pa s; without feedback"));
  EXPECT_TRUE(has(html,
                  "method of constant stimuli as a two-interval task (order balanced); "
                  "viscosity; levels"));
  EXPECT_FALSE(has(html, "order drawn"));
  EXPECT_FALSE(has(html, "; ;"));
}

TEST_F(ReportTest, MethodsTellWhichBlocksWereMixed) {
  HandMadeStudy study(R"json({"name": "by_hand", "stages": [
    {"kind": "interleaved", "name": "fluids", "blocks": [
      {"kind": "block", "name": "thin", "procedure": "constant_stimuli", "medium": "viscous",
       "reference_viscosity_pa_s": 8},
      {"kind": "block", "name": "thick", "procedure": "constant_stimuli", "medium": "viscous",
       "title": {"en": "Thick fluids"}, "reference_viscosity_pa_s": 8}]}]})json");
  (void)study.add("P01", false, kLaboratory);
  study.compare_ten("thin", 8);
  study.compare_ten("thick", 8);
  const StudyData data = load_study(study.store());
  const StudyResults results = results_of(data, {}, {.num_resamples = 50});
  const std::string html = without_breaks(whole_report({.store = study.store(),
                                                        .data = data,
                                                        .results = results,
                                                        .results_options = {},
                                                        .movement = {},
                                                        .program_version = "1"},
                                                       {}, {}));
  EXPECT_TRUE(has(html,
                  "Trials of “thin” and “Thick fluids” were interleaved: in every round each "
                  "block that had trials left came once, in an order drawn anew."));
}

TEST_F(ReportTest, MethodsTellWhatBoundsATrialAndWhatBecomesOfAnswersWithoutAChoice) {
  HandMadeStudy study(R"json({"name": "by_hand", "stages": [
    {"kind": "block", "name": "thicker", "procedure": "constant_stimuli", "medium": "viscous",
     "reference_viscosity_pa_s": 8, "cannot_tell": true, "answer_deadline_s": 6.5,
     "min_stimulus_s": 2, "max_stimulus_s": 4, "max_returns": 1},
    {"kind": "block", "name": "brief", "procedure": "constant_stimuli", "medium": "viscous",
     "reference_viscosity_pa_s": 8, "min_stimulus_s": 3, "max_stimulus_s": 3,
     "max_returns": 0}]})json");
  (void)study.add("P01", false, kLaboratory);
  study.compare_ten("thicker", 8);
  study.compare_ten("brief", 8);
  const StudyData data = load_study(study.store());
  const StudyResults results = results_of(data, {}, {.num_resamples = 50});
  const std::string html = without_breaks(whole_report({.store = study.store(),
                                                        .data = data,
                                                        .results = results,
                                                        .results_options = {},
                                                        .movement = {},
                                                        .program_version = "1"},
                                                       {}, {}));
  EXPECT_TRUE(
      has(html,
          "; each stimulus was felt for 2 s at least; each stimulus ended after 4 s at "
          "most; at most 1 return to stimuli in a trial; a trial without an answer 6.5 s "
          "after the start of the stimulus with which all had been felt was run again; "
          "“cannot tell” was an answer, too"));
  EXPECT_TRUE(has(html, "; each stimulus was felt for 3 s; nobody went back to a stimulus"));
  EXPECT_TRUE(has(html, "it is in no curve and in no rate"));
  EXPECT_TRUE(has(html, "An answer that missed the deadline of its block is in no estimate"));
  EXPECT_TRUE(has(html, "cannot_tell_ratio"));
}

TEST_F(ReportTest, ScalesWithoutABetterEndHaveATableOfTheirOwn) {
  HandMadeStudy study(R"json({"name": "by_hand", "stages": [
    {"kind": "questionnaire", "name": "form", "items": [
      {"name": "side", "kind": "scale", "num_steps": 7, "question": {"en": "Which side?"},
       "low_label": {"en": "left"}, "high_label": {"en": "right"}}]}]})json");
  (void)study.add("P01", false, kLaboratory);
  study.say("form", "side", "2");
  const StudyData data = load_study(study.store());
  const StudyResults results = results_of(data, {}, {.num_resamples = 50});
  const std::string html = without_breaks(whole_report({.store = study.store(),
                                                        .data = data,
                                                        .results = results,
                                                        .results_options = {},
                                                        .movement = {},
                                                        .program_version = "1"},
                                                       {}, {}));
  EXPECT_TRUE(has(html, "Steps of scales without a better end"));
  EXPECT_TRUE(has(html, "1: left, 7: right"));
  EXPECT_FALSE(has(html, "the worst"));
}

TEST_F(ReportTest, WhoAnswersTheWrongWayRoundIsNamedBesideEveryNumberThatHasThem) {
  HandMadeStudy study(R"json({"name": "by_hand", "stages": [
    {"kind": "block", "name": "thicker", "procedure": "constant_stimuli"}]})json");
  for (int i = 1; i <= 5; ++i) {
    (void)study.add("P0" + std::to_string(i), false, kLaboratory);
    study.compare_ten("thicker", i == 5 ? 1 : 8 + i % 2);
  }
  const StudyData data = load_study(study.store());
  const StudyResults results = results_of(data, {}, {.num_resamples = 50});
  const std::string html = without_breaks(whole_report({.store = study.store(),
                                                        .data = data,
                                                        .results = results,
                                                        .results_options = {},
                                                        .movement = {},
                                                        .program_version = "1"},
                                                       {}, {}));
  EXPECT_TRUE(has(html, "Cautions: in the numbers all the same"));
  EXPECT_TRUE(has(html, "as of somebody who answers the wrong way round"));
  const std::size_t primary = html.find("Primary values");
  ASSERT_NE(primary, std::string::npos);
  EXPECT_NE(html.find("Caution: P05, who answers the wrong way round, is in it", primary),
            std::string::npos);
}

TEST_F(ReportTest, DegenerateDataAreSaidToBeSoAndNoNumberIsMadeUp) {
  const std::string html = whole(report(out()));
  EXPECT_TRUE(has(html, "P03"));
  EXPECT_TRUE(has(html, "separated"));
  for (const char* no_number : {">nan<", ">inf<", "nan to", " inf ", "-nan"}) {
    EXPECT_FALSE(has(html, no_number)) << no_number;
  }
}

TEST_F(ReportTest, OfTheSameStudyEveryByteIsTheSame) {
  (void)report(out("a"));
  (void)report(out("b"), {.jobs = 4});
  std::size_t num_files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(out("a"))) {
    if (!entry.is_regular_file()) continue;
    ++num_files;
    EXPECT_EQ(read_file(entry.path()),
              read_file(out("b") / fs::relative(entry.path(), out("a"))))
        << entry.path();
  }
  EXPECT_GT(num_files, 20U);
}

TEST_F(ReportTest, WithoutGnuplotAndBrowserTablesRemainAndTheLackIsSaid) {
  const ReportOutcome outcome = report(out());
  ASSERT_EQ(outcome.problems.size(), 2U);
  EXPECT_TRUE(has(outcome.problems[0], "gnuplot is not installed"));
  EXPECT_TRUE(has(outcome.problems[1], "neither chromium nor wkhtmltopdf"));
  EXPECT_TRUE(outcome.pdf.empty());
  const std::string html = without_breaks(read_file(outcome.html));
  EXPECT_FALSE(has(html, "<svg"));
  EXPECT_TRUE(has(html, "Not drawn: gnuplot is not installed"));
  EXPECT_TRUE(has(html, "group_d.weber_fraction"));
}

TEST_F(ReportTest, ABrowserMakesThePdfWhoseDatesAreThoseOfTheData) {
  const fs::path browser = tool("chromium",
                                "for word in \"$@\"; do case \"$word\" in\n"
                                "--print-to-pdf=*) target=\"${word#--print-to-pdf=}\";;\n"
                                "file://*) page=\"${word#file://}\";; esac; done\n"
                                "test -f \"$page\" || exit 1\n"
                                "printf '%%PDF\\n/CreationDate (D:20300101000000Z)\\n' "
                                "> \"$target\"\n");
  const ReportOutcome outcome = report(out(), {.browser = browser});
  EXPECT_EQ(outcome.pdf, out() / "report.pdf");
  EXPECT_EQ(read_file(outcome.pdf), "%PDF\n/CreationDate (D:19700101000000Z)\n");
}

TEST_F(ReportTest, ABrowserThatFailsIsSaidAndTheRestIsWhole) {
  const ReportOutcome outcome =
      report(out(), {.browser = tool("chromium", "echo no display >&2\nexit 1\n")});
  EXPECT_TRUE(outcome.pdf.empty());
  EXPECT_FALSE(fs::exists(out() / "report.pdf"));
  ASSERT_GE(outcome.problems.size(), 2U);
  EXPECT_TRUE(has(outcome.problems.back(), "there is no supplement.pdf: chromium: no display"));
  EXPECT_TRUE(has(outcome.problems[outcome.problems.size() - 2],
                  "there is no report.pdf: chromium: no display"));
  EXPECT_TRUE(fs::exists(outcome.html));
}

TEST_F(ReportTest, AFolderWithSomethingInItIsRefusedAndLeftAlone) {
  fs::create_directories(out());
  std::ofstream(out() / "mine.txt") << "mine";
  EXPECT_THROW((void)report(out()), core::Error);
  EXPECT_EQ(read_file(out() / "mine.txt"), "mine");
  EXPECT_EQ(std::distance(fs::directory_iterator(out()), fs::directory_iterator()), 1);
  std::ofstream(out("file")) << "a file";
  EXPECT_THROW((void)report(out("file")), core::Error);
}

TEST_F(ReportTest, NothingOfAReportStaysThatCouldNotBeFinished) {
  // This gnuplot leaves files without their end, as on a full disk.
  const fs::path gnuplot =
      tool("gnuplot", "name=\"${1%.gp}\"\necho '<svg>' > $name.svg\necho %PDF > $name.pdf\n");
  try {
    (void)report(out(), {.gnuplot = gnuplot});
    FAIL() << "expected an error";
  } catch (const core::Error& error) {
    EXPECT_TRUE(has(error.what(), "is the disk full?")) << error.what();
  }
  EXPECT_FALSE(fs::exists(out()));
  fs::create_directories(out("empty"));
  EXPECT_THROW((void)report(out("empty"), {.gnuplot = gnuplot}), core::Error);
  EXPECT_TRUE(fs::is_empty(out("empty")));
}

TEST_F(ReportTest, PilotsAreLeftOutUnlessAskedFor) {
  (void)study_.add("PILOT", true, kLaboratory);
  study_.compare_ten("group_d", 9);
  const std::string without = whole(report(out("a")));
  EXPECT_FALSE(has(without, "PILOT"));
  EXPECT_TRUE(has(without, "1 pilot session left out"));
  const std::string with = whole(report(out("b"), {}, /*pilot=*/true));
  EXPECT_TRUE(has(with, "PILOT sessions are among these data"));
  EXPECT_TRUE(has(with, "4 participants"));
}

TEST_F(ReportTest, CountsWhatWasUndoneSetAsideAndNeverAnswered) {
  const std::int64_t session = study_.add("P04", false, kLaboratory);
  study_.compare_ten("group_d", 8);
  study_.exclude(3);
  study_.compare("group_d", 12.0, 8.0, true);
  study_.undo_last_answer();
  const std::vector<SessionQuality> quality =
      session_quality(study_.store(), {study_.store().session(session)});
  ASSERT_EQ(quality.size(), 1U);
  EXPECT_EQ(quality[0].num_drawn, 21);
  EXPECT_EQ(quality[0].num_answered, 19);
  EXPECT_EQ(quality[0].num_excluded, 1);
  EXPECT_EQ(quality[0].num_missing(), 1);
  EXPECT_EQ(quality[0].num_undone, 1);
  EXPECT_FALSE(quality[0].completed);
  EXPECT_FALSE(quality[0].timing);
  EXPECT_TRUE(has(whole(report(out())), "P04: trial 3 set aside"));
}

TEST_F(ReportTest, AParticipantWithAMissingBlockDoesNotSpoilTheOthers) {
  (void)study_.add("P05", false, kLaboratory);
  study_.estimate(1.0, 100.0);
  const std::string html = without_breaks(whole(report(out())));
  EXPECT_TRUE(has(html, "no answers in group_d"));
  EXPECT_TRUE(has(html, "<code>combined.k</code>"));
}

}  // namespace report_test
}  // namespace jnd::analysis
