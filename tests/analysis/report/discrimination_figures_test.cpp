#include <gtest/gtest.h>

#include "analysis/hand_made_study.h"
#include "analysis/report/figures.h"

namespace jnd::analysis {
namespace {

/// Two people who compared with 8 Pa s at so many levels, chosen by this procedure.
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
  const StudyWords words;
  return discrimination_figures({.data = data, .results = results, .words = words});
}

bool draws(const Figure& figure, const std::string& part) {
  return figure.plot.find(part) != std::string::npos;
}

TEST(DiscriminationFigures, LevelsThatAnswersLedToHaveSharesHoweverFewTheyAre) {
  for (const char* procedure : {"quest_plus", "staircase"}) {
    const std::vector<Figure> figures = figures_of(procedure, 4);
    ASSERT_EQ(figures.size(), 2U);
    EXPECT_EQ(figures[0].tables[0].name, "thicker_shares") << procedure;
    EXPECT_FALSE(draws(figures[0], "yerrorbars")) << procedure;
    EXPECT_FALSE(draws(figures[1], "yerrorbars")) << procedure;
    EXPECT_EQ(figures[0].caption.find("standard deviation"), std::string::npos);
  }
}

TEST(DiscriminationFigures, LevelsOfTheStudyFileHaveMeansHoweverManyTheyAre) {
  for (const char* procedure : {"constant_stimuli", "limits"}) {
    const std::vector<Figure> figures = figures_of(procedure, 25);
    ASSERT_EQ(figures.size(), 2U);
    EXPECT_EQ(figures[0].tables[0].name, "thicker_means") << procedure;
    EXPECT_EQ(figures[0].tables[0].rows.size(), 25U);
    EXPECT_TRUE(draws(figures[0], "yerrorbars")) << procedure;
    EXPECT_TRUE(draws(figures[1], "yerrorbars")) << procedure;
  }
}

}  // namespace
}  // namespace jnd::analysis
