#include "experiments/protocol/design_rules.h"

#include <gtest/gtest.h>

#include "experiments/designed_study.h"
#include "tests/experiments/protocol/broken_study.h"

namespace jnd::experiments {
namespace design_rules_test {

std::string problems(const std::string& text) { return problems_of(text); }

std::string with(const std::string& from, const std::string& to) {
  return problems(broken(from, to, designed_study(fluid_contrast())));
}

TEST(DesignRules, TakeASoundDesign) {
  EXPECT_EQ(problems(designed_study(fluid_contrast())), "");
  EXPECT_EQ(problems(designed_study(fluid_contrast(
                R"(, "hypothesis": {"en": "Thin is harder."}, "direction": "greater",
                    "smallest_effect": 1.25, "alpha": 0.01, "family": "main",
                    "correction": "bonferroni")"))),
            "");
  const Study study = read_study_text(
      designed_study(fluid_contrast(R"(, "smallest_effect": 1.25, "direction": "less")")),
      "x.json");
  ASSERT_EQ(study.contrasts.size(), 1U);
  const PlannedContrast& plan = study.contrasts.front();
  EXPECT_EQ(plan.name, "fluids");
  EXPECT_EQ(plan.measure, ContrastMeasure::kWeberFraction);
  EXPECT_EQ(plan.weights.at("fluid").at("thick"), -1.0);
  EXPECT_TRUE(plan.primary);
  EXPECT_EQ(plan.direction, ContrastDirection::kLess);
  EXPECT_EQ(plan.smallest_effect, 1.25);
  EXPECT_EQ(plan.alpha, 0.05);
  EXPECT_EQ(plan.family, "primary");
  EXPECT_EQ(plan.correction, Correction::kHolm);
}

TEST(DesignRules, TellAnUnknownFactorOrLevelWithTheNearest) {
  EXPECT_NE(with(R"("levels": {"fluid": "thin"})", R"("levels": {"fluit": "thin"})")
                .find("expected one of the study's `factors`: `fluid`, found `fluit`; did you "
                      "mean `fluid`?"),
            std::string::npos);
  EXPECT_NE(with(R"("levels": {"fluid": "thin"})", R"("levels": {"fluid": "thinn"})")
                .find("expected a level of `fluid`: `thin` or `thick`, found `thinn`; did you "
                      "mean `thin`?"),
            std::string::npos);
  EXPECT_NE(with(R"("of": {"fluid": {"thin": 1)", R"("of": {"fluid": {"tin": 1)")
                .find("/contrasts/0/of/fluid/tin: expected a level of `fluid`: `thin` or "
                      "`thick`, found `tin`; did you mean `thin`?"),
            std::string::npos);
  EXPECT_NE(with(R"("of": {"fluid")", R"("of": {"fluids")")
                .find("/contrasts/0/of/fluids: expected one of the study's `factors` or "
                      "`block`"),
            std::string::npos);
}

TEST(DesignRules, WantWeightsThatCompare) {
  EXPECT_NE(with(R"("thin": 1, "thick": -1)", R"("thin": 1, "thick": 1)")
                .find("/contrasts/0/of: expected a factor with weights that add up to 0"),
            std::string::npos);
  EXPECT_NE(with(R"("thin": 1, "thick": -1)", R"("thin": 1, "thick": -0.5)")
                .find("found weights of both signs that add up to 0.5"),
            std::string::npos);
  EXPECT_NE(with(R"("thin": 1, "thick": -1)", R"("thin": 0, "thick": 0)")
                .find("expected a weight other than 0, found none"),
            std::string::npos);
  EXPECT_NE(with(R"("thin": 1, "thick": -1)", R"("thin": "1", "thick": -1)")
                .find("/contrasts/0/of/fluid/thin: expected a number"),
            std::string::npos);
}

TEST(DesignRules, WantLevelsThatSomethingHas) {
  EXPECT_NE(with(R"("levels": ["thin", "thick"])", R"("levels": ["thin", "thick", "air"])")
                .find("/factors/0/levels/2: expected a block with this level in its `levels`, "
                      "found none"),
            std::string::npos);
  EXPECT_NE(with(R"("levels": ["primed", "control"])", R"("levels": ["primed", "contrl"])")
                .find("/factors/1/levels/1: expected one of what people are in `priming`: "
                      "`primed` or `control`, found `contrl`; did you mean `control`?"),
            std::string::npos);
  EXPECT_NE(with(R"("name": "fluid", "levels")", R"("name": "block", "levels")")
                .find("found `block`, a factor that every study has"),
            std::string::npos);
}

TEST(DesignRules, WantWhatPeopleDifferInApartFromBlocks) {
  EXPECT_NE(
      with(R"("levels": {"fluid": "thin"})",
           R"("levels": {"fluid": "thin", "priming": "primed"})")
          .find("expected a factor that blocks differ in, found `priming`, in which people "
                "differ"),
      std::string::npos);
}

TEST(DesignRules, WantARatioAboveOneAsSmallestEffect) {
  EXPECT_NE(problems(designed_study(fluid_contrast(R"(, "smallest_effect": 0.8)")))
                .find("/contrasts/0/smallest_effect: expected a ratio above 1, as 1.25 for a "
                      "quarter more or a fifth less, found 0.8"),
            std::string::npos);
}

TEST(DesignRules, WantOneCorrectionOfAFamily) {
  EXPECT_NE(problems(designed_study(fluid_contrast() + ", " +
                                    fluid_contrast(R"(, "correction": "none")", "again")))
                .find("/contrasts/1/correction: expected the correction of its family "
                      "`primary`, `holm`, found `none`"),
            std::string::npos);
  EXPECT_EQ(problems(designed_study(
                fluid_contrast() + ", " +
                fluid_contrast(R"(, "correction": "none", "family": "other")", "again"))),
            "");
}

TEST(DesignRules, WantBlocksThatHaveWhatIsCompared) {
  EXPECT_NE(
      problems(designed_study(fluid_contrast("", "x", R"({"fluid": {"thin": 1, "thick": -1}})",
                                             "exponent")))
          .find("/contrasts/0/of: expected blocks with these levels that have the measure "
                "`exponent`, found none"),
      std::string::npos);
}

TEST(DesignRules, WantBlocksAlikeWhoseAnswersAreTakenTogether) {
  const std::string text = designed_study(fluid_contrast());
  const std::size_t at = text.rfind("\"reference_viscosity_pa_s\": 4");
  std::string changed = text;
  changed.replace(at, 29, "\"reference_viscosity_pa_s\": 5");
  EXPECT_NE(problems(changed).find(
                "expected blocks with the same levels to have the same medium, reference, "
                "standard and task, for their answers are taken together, found others in "
                "`thin_a` and `thin_c`"),
            std::string::npos)
      << problems(changed);
}

}  // namespace design_rules_test
}  // namespace jnd::experiments
