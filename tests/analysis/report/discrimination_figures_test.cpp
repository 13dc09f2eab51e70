#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "analysis/charts/charts.h"
#include "analysis/hand_made_study.h"
#include "analysis/report/chart_figures.h"
#include "analysis/report/figures.h"
#include "analysis/results/number_words.h"

namespace jnd::analysis {
namespace discrimination_figures_test {

/// Returns the figures of two people who compared `num_levels` levels with 8 Pa s. This
/// procedure chose the levels.
std::vector<Figure> figures_of(const std::string& procedure, int num_levels) {
  HandMadeStudy study;
  for (const char* name : {"P01", "P02"}) {
    study.add(name);
    for (int level = 0; level < num_levels; ++level) {
      for (int i = 0; i < 4; ++i) {
        (void)study.answer({.block = "thicker",
                            .procedure = procedure,
                            .quantity = "viscosity_pa_s",
                            .repetition = 1,
                            .intensity = 6.0 + 4.0 * level / num_levels,
                            .reference_intensity = 8.0,
                            .response = i * num_levels < 4 * level ? 1.0 : 0.0});
      }
    }
  }
  const StudyData data = load_study(study.store());
  const StudyResults results = results_of(data, {}, {.num_resamples = 50});
  const StudyTitles titles;
  return chart_figures(
      psychometric_charts({.data = data, .results = results, .titles = titles}));
}

std::vector<Figure> figures_of(const FigureSource& source) {
  return chart_figures(psychometric_charts(source));
}

/// Returns the table of this name, or an empty one if there is none.
FigureTable table_of(const Figure& figure, const std::string& name) {
  const auto found = std::ranges::find(figure.tables, name, &FigureTable::name);
  return found == figure.tables.end() ? FigureTable{} : *found;
}

bool draws(const Figure& figure, const std::string& part) {
  return figure.plot.find(part) != std::string::npos;
}

TEST(DiscriminationFigures, LevelsThatAnswersLedToHaveSharesHoweverFewTheyAre) {
  for (const char* procedure : {"quest_plus", "staircase"}) {
    const std::vector<Figure> figures = figures_of(procedure, 4);
    ASSERT_EQ(figures.size(), 2U);
    EXPECT_FALSE(table_of(figures[0], "thicker_shares").rows.empty()) << procedure;
    EXPECT_FALSE(draws(figures[0], "yerrorbars")) << procedure;
    EXPECT_FALSE(draws(figures[1], "yerrorbars")) << procedure;
    EXPECT_EQ(figures[0].caption.find("standard deviation"), std::string::npos);
  }
}

TEST(DiscriminationFigures, LevelsOfTheStudyFileHaveMeansHoweverManyTheyAre) {
  for (const char* procedure : {"constant_stimuli", "limits"}) {
    const std::vector<Figure> figures = figures_of(procedure, 25);
    ASSERT_EQ(figures.size(), 2U);
    EXPECT_EQ(table_of(figures[0], "thicker_means").rows.size(), 25U) << procedure;
    EXPECT_TRUE(draws(figures[0], "yerrorbars")) << procedure;
    EXPECT_TRUE(draws(figures[1], "yerrorbars")) << procedure;
  }
}

/// Makes a study of people with these numbers of right answers, each of ten.
struct SomePeople {
  explicit SomePeople(const std::vector<int>& nums_right) {
    for (const int num_right : nums_right) {
      study.add("P0" + std::to_string(++num_people));
      study.compare_ten("thicker", num_right);
    }
  }
  [[nodiscard]] FigureSource source() const {
    return {.data = data, .results = results, .titles = titles};
  }
  int num_people = 0;
  HandMadeStudy study;
  StudyTitles titles;
  StudyData data = {};
  StudyResults results = {};
};

TEST(DiscriminationFigures, TheMedianPersonComesFirstAndThePooledCurveIsCalledWhatItIs) {
  SomePeople people({9, 8, 7, 9, 6, 8});
  people.data = load_study(people.study.store());
  people.results = results_of(people.data, {}, {.num_resamples = 50});
  const Figure figure = figures_of(people.source()).at(0);
  const Estimate* const person = people.results.find("thicker.weber_fraction_median_person");
  ASSERT_NE(person, nullptr);
  ASSERT_TRUE(person->value && person->ci95.low && person->ci95.high);
  const std::string first = "median person: w = " + number_words(person->value, 2) + " (" +
                            number_words(person->ci95.low, 2) + " .. " +
                            number_words(person->ci95.high, 2) + ")";
  EXPECT_TRUE(draws(figure, first)) << first << '\n' << figure.plot;
  EXPECT_LT(figure.plot.find(first), figure.plot.find("through everybody’s answers: w = "));
  EXPECT_TRUE(draws(figure, "through everybody’s answers: w = "));
  EXPECT_FALSE(draws(figure, "fit to all pooled")) << figure.plot;
  EXPECT_LT(figure.caption.find("median person"), figure.caption.find("everybody’s answers"));
  EXPECT_NE(figure.caption.find("flatten"), std::string::npos) << figure.caption;
}

TEST(DiscriminationFigures, ErrorBarsOfSharesStayWithinNothingAndAll) {
  SomePeople people({10, 10, 9, 5});
  people.data = load_study(people.study.store());
  people.results = results_of(people.data, {}, {.num_resamples = 50});
  const FigureTable means = table_of(figures_of(people.source()).at(0), "thicker_means");
  ASSERT_EQ(means.columns.at(3), "low");
  bool any_cut = false;
  for (const std::vector<FigureCell>& row : means.rows) {
    EXPECT_GE(row[3].number.value(), 0.0);
    EXPECT_LE(row[4].number.value(), 1.0);
    any_cut |= row[1].number.value() + row[2].number.value() > 1.0;
  }
  EXPECT_TRUE(any_cut) << "or this says nothing";
}

TEST(DiscriminationFigures, BoxesRestOnThePseOfThePrimaryValueAndSaySo) {
  SomePeople people({9, 8, 7, 9, 6, 8});
  people.data = load_study(people.study.store());
  people.results = results_of(people.data, {}, {.num_resamples = 50});
  const auto boxes_of = [&] { return weber_figures(people.source()).at(1); };
  EXPECT_NE(boxes_of().caption.find("point of subjective equality free"), std::string::npos);
  const auto is_free = [&](const std::vector<FigureCell>& row) {
    const ParticipantEstimate* const own =
        people.source().own("thicker", row.at(2).text, "thicker.weber_fraction_free_pse");
    return own != nullptr && own->value && std::fabs(*own->value * 8.0 - *row[3].number) < 1e-9;
  };
  const FigureTable values = boxes_of().tables.at(1);
  EXPECT_TRUE(std::ranges::all_of(values.rows, is_free));
  Published published;
  published.values["thicker.individual_weber_fraction_median"] = {.value = 0.5};
  people.results = results_of(people.data, published, {.num_resamples = 50});
  EXPECT_NE(boxes_of().caption.find("point of subjective equality free"), std::string::npos)
      << "whatever was published";
}

TEST(DiscriminationFigures, PanelsOfPeopleAreTitledWithTheFractionOfThePrimaryPse) {
  SomePeople people({9, 8});
  for (int answered = 0; answered < 10; ++answered) {
    people.study.compare("thicker", 9.0, 8.0, answered < 2);
  }
  people.data = load_study(people.study.store());
  people.results = results_of(people.data, {}, {.num_resamples = 50});
  const auto title_of = [&](const char* name) {
    return "P02   w = " + number_words(people.source().own("thicker", "P02", name)->value, 2);
  };
  const std::string free = title_of("thicker.weber_fraction_free_pse");
  ASSERT_NE(free, title_of("thicker.weber_fraction"));
  const Figure panels = figures_of(people.source()).at(1);
  EXPECT_TRUE(draws(panels, free)) << panels.plot;
  EXPECT_NE(panels.caption.find("free, as the primary value has it"), std::string::npos);
}

}  // namespace discrimination_figures_test
}  // namespace jnd::analysis
