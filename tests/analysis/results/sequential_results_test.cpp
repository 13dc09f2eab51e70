#include "analysis/results/sequential_results.h"

#include <gtest/gtest.h>

#include <cmath>

#include "analysis/hand_made_study.h"
#include "analysis/results/contrast_words.h"
#include "analysis/statistics/sequential_estimate.h"
#include "core/error.h"
#include "experiments/designed_study.h"

namespace jnd::analysis {
namespace sequential_results_test {

using experiments::designed_study;
using experiments::fluid_contrast;

/// Returns a study that compares times in two fluids, after four and after six people of one
/// group.
std::string study_text(const std::string& more = "", const std::string& others = "") {
  std::string text =
      designed_study(fluid_contrast(R"(, "family": "decides")" + more, "fluids",
                                    R"({"fluid": {"thin": 1, "thick": -1}})", "response_time") +
                     others);
  const std::string factor = R"(,
              {"name": "priming", "levels": ["primed", "control"]})";
  text.erase(text.find(factor), factor.size());
  const std::string at = "\"factors\":";
  return text.replace(text.find(at), at.size(),
                      R"("sequential": {"contrast": "fluids", "looks": [4, 6]}, "factors":)");
}

/// Makes people whose times in thin fluids are `ratios` times those in thick ones.
class Timed {
 public:
  explicit Timed(const std::vector<double>& ratios, const std::string& text = study_text())
      : made(text) {
    for (const double ratio : ratios) {
      sessions.push_back(
          made.add("P0" + std::to_string(sessions.size() + 1), false, "", "priming=primed"));
      answer("thin_a", 4.0, ratio);
      answer("thick_b", 16.0, 1.0);
    }
  }

  [[nodiscard]] std::vector<ContrastResult> results() const {
    return planned_contrasts(load_study(made.store()));
  }

  HandMadeStudy made;
  std::vector<std::int64_t> sessions;

 private:
  void answer(const std::string& block, double reference, double time_s) {
    for (const double factor : {0.5, 2.0}) {
      (void)made.answer({.block = block,
                         .procedure = "constant_stimuli",
                         .quantity = "viscosity_pa_s",
                         .repetition = 1,
                         .intensity = factor * reference,
                         .reference_intensity = reference,
                         .response = factor > 1.0 ? 1.0 : 0.0,
                         .measures = {.response_time_s = time_s}});
    }
  }
};

const std::vector<double> kRatios = {1.4, 1.1, 1.3, 0.9, 1.5, 1.6};

/// Computes the effect by hand, from the logarithms of the first `num` ratios.
EffectEstimate by_hand(std::size_t num) {
  double sum = 0.0, squares = 0.0;
  for (std::size_t i = 0; i < num; ++i) sum += std::log(kRatios[i]);
  const auto n = static_cast<double>(num);
  for (std::size_t i = 0; i < num; ++i) squares += std::pow(std::log(kRatios[i]) - sum / n, 2);
  return {sum / n, std::sqrt(squares / (n - 1.0) / n), n - 1.0};
}

TEST(SequentialResults, TakeAlphaAndDirectionFromTheContrast) {
  const experiments::Study study =
      load_study(
          Timed(kRatios, study_text(R"(, "alpha": 0.01, "direction": "less")")).made.store())
          .written;
  const SequentialRule rule = sequential_rule(study);
  EXPECT_EQ(rule.looks, (std::vector<int>{4, 6}));
  EXPECT_EQ(rule.alpha, 0.01);
  EXPECT_EQ(rule.tail, Tail::kLess);
  EXPECT_EQ(rule.spending, SpendingFunction::kObrienFleming);
  EXPECT_THROW((void)sequential_rule(experiments::Study{}), core::Error);
}

TEST(SequentialResults, EstimatesAreOfThoseWhoCameUntilTheLook) {
  const Timed timed(kRatios);
  const auto found = estimates_at_looks(load_study(timed.made.store()),
                                        {{"P01", "P02", "P03", "P04"}, {"P05", "P06"}});
  ASSERT_EQ(found.size(), 2U);
  EXPECT_NEAR(found[0]->effect, by_hand(4).effect, 1e-12);
  EXPECT_NEAR(found[0]->standard_error, by_hand(4).standard_error, 1e-12);
  EXPECT_NEAR(found[1]->effect, by_hand(6).effect, 1e-12);
  EXPECT_NEAR(found[1]->standard_error, by_hand(6).standard_error, 1e-12);
}

TEST(SequentialResults, AtTheEndTheAdjustedValueStandsFirstAndTheOrdinaryOneBeside) {
  Timed timed(kRatios);
  const std::vector<std::int64_t>& all = timed.sessions;
  timed.made.look("go_on", {all[0], all[1], all[2], all[3]});
  timed.made.look("stop", {all[4], all[5]});
  const ContrastResult one = timed.results().at(0);
  const SequentialBoundaries boundaries = boundaries_of({.looks = {4, 6}});
  const auto expected = SequentialEstimate::of(
      boundaries, {.estimates = {by_hand(4), by_hand(6)}, .ended = true});
  ASSERT_TRUE(one.sequential);
  EXPECT_TRUE(one.sequential->ended);
  EXPECT_EQ(one.sequential->num_participants, 6);
  EXPECT_NEAR(*one.test.effect, std::exp(*expected->median_unbiased()), 1e-6);
  EXPECT_NEAR(*one.test.ci95.low, std::exp(*expected->interval(0.95).low), 1e-6);
  EXPECT_NEAR(*one.test.p_value, expected->p_value(), 1e-9);
  EXPECT_EQ(one.p_value_adjusted, one.test.p_value);
  EXPECT_NE(one.sentence.find(", adjusted for the looks."), std::string::npos) << one.sentence;
  EXPECT_EQ(looks_sentence(one),
            "The study was to be looked at by the contrast fluids after so many complete "
            "sessions, and to end where p is below the level beside: 4 (p < 0.012) and 6 "
            "(p < 0.046). Its rule ended it at look 2, with 6 participants.");
  EXPECT_NE(one.test.method.find("adjusted for the looks"), std::string::npos);
  ASSERT_FALSE(one.otherwise.empty());
  EXPECT_NEAR(*one.otherwise[0].effect, std::exp(by_hand(6).effect), 1e-12);
  EXPECT_NE(one.otherwise[0].method.find("not adjusted for the looks"), std::string::npos);
  EXPECT_EQ(one.cautions.at(0),
            "the study ended by its rule at look 2 of 2, with 6 participants of at most 6");
}

TEST(SequentialResults, WhoCameAfterTheEndIsLeftOut) {
  Timed timed(kRatios);
  const std::vector<std::int64_t>& all = timed.sessions;
  timed.made.look("stop", {all[0], all[1], all[2], all[3]});
  const ContrastResult one = timed.results().at(0);
  EXPECT_NEAR(*one.test.effect, std::exp(by_hand(4).effect), 1e-6);
  EXPECT_EQ(one.sequential->num_participants, 4);
  bool names_them = false, doubts = false;
  for (const std::string& caution : one.cautions) {
    names_them |= caution == "of 2 participants beyond those looks nothing is in this value";
    doubts |= caution.find("do not cross its boundary") != std::string::npos;
  }
  EXPECT_TRUE(names_them);
  EXPECT_TRUE(doubts) << "these data would not have ended it";
}

TEST(SequentialResults, BeforeTheEndNothingIsAdjustedAndThatIsSaid) {
  Timed timed(kRatios);
  const ContrastResult one = timed.results().at(0);
  ASSERT_TRUE(one.sequential);
  EXPECT_FALSE(one.sequential->ended);
  EXPECT_NEAR(*one.test.effect, std::exp(by_hand(6).effect), 1e-12);
  EXPECT_EQ(one.test.method.find("adjusted for the looks"), std::string::npos);
  ASSERT_FALSE(one.cautions.empty());
  EXPECT_NE(one.cautions[0].find("which was not planned"), std::string::npos);
}

TEST(SequentialResults, EquivalenceIsOfTheAdjustedInterval) {
  Timed timed(kRatios, study_text(R"(, "smallest_effect": 3)"));
  const std::vector<std::int64_t>& all = timed.sessions;
  timed.made.look("go_on", {all[0], all[1], all[2], all[3]});
  timed.made.look("stop", {all[4], all[5]});
  const ContrastResult one = timed.results().at(0);
  const auto expected = SequentialEstimate::of(
      boundaries_of({.looks = {4, 6}}), {.estimates = {by_hand(4), by_hand(6)}, .ended = true});
  ASSERT_TRUE(one.equivalence);
  EXPECT_TRUE(one.equivalence->is_shown);
  EXPECT_NEAR(*one.equivalence->interval.high, std::exp(*expected->interval(0.9).high), 1e-6);
  EXPECT_NEAR(one.equivalence->p_value, expected->probability_below(std::log(3.0)), 1e-9);
}

TEST(SequentialResults, OtherContrastsSayThatTheyAreNotAdjusted) {
  Timed timed(kRatios,
              study_text("", ", " + fluid_contrast("", "others",
                                                   R"({"fluid": {"thin": 1, "thick": -1}})",
                                                   "response_time")));
  const std::vector<ContrastResult> both = timed.results();
  EXPECT_FALSE(both.at(1).sequential);
  ASSERT_FALSE(both.at(1).cautions.empty());
  EXPECT_NE(both.at(1).cautions.back().find("is not adjusted for them"), std::string::npos);
}

}  // namespace sequential_results_test
}  // namespace jnd::analysis
