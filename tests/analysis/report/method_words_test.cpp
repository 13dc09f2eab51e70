#include "analysis/report/method_words.h"

#include <gtest/gtest.h>

#include "analysis/hand_made_study.h"
#include "analysis/report/literature.h"
#include "core/error.h"

namespace jnd::analysis {
namespace method_words_test {

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// Returns every paragraph, and then the references.
std::string words_of(const HandMadeStudy& study) {
  const StudyData data = load_study(study.store());
  const StudyResults results = results_of(data, {}, {.num_resamples = 50, .seed = 7});
  const MethodWords words = method_words({.store = study.store(),
                                          .data = data,
                                          .results = results,
                                          .results_options = {.num_resamples = 50, .seed = 7},
                                          .movement = {},
                                          .program_version = "1.2.3"});
  std::string all;
  for (const auto& [topic, text] : words.topics) all += topic + ". " + text + "\n";
  for (const std::string& reference : words.references) all += reference + "\n";
  return all;
}

TEST(MethodWords, OfADiscriminationGiveTheCurveTheModelAndTheirSources) {
  HandMadeStudy study;
  for (const char* name : {"P01", "P02", "P03", "P04", "P05"}) {
    study.add(name);
    study.compare_ten("group_d", 6 + name[2] % 4);
    study.compare_ten("group_e", 7 + name[2] % 3);
  }
  const std::string words = words_of(study);
  for (const char* part :
       {"P(x) = Φ(ln(x / PSE) / ln(1 + w))", "lapse rate 0", "50 times (seed 7)",
        "α = Φ(−√(n / (n − 1)) t)", "a_i = −ln ln(1 + w_i)", "Hesterberg, T. C. (2015)",
        "Pinheiro, J. C.", "Wichmann, F. A.", "T the smaller sum of ranks",
        "exact up to 50 ranks, with ties, too", "Streitberg, B.", "each in their own way"}) {
    EXPECT_TRUE(has(words, part)) << part;
  }
  for (const char* part : {"S = k I^a", "Stevens", "Spearman", "hysteresis"}) {
    EXPECT_FALSE(has(words, part)) << part;
  }
}

TEST(MethodWords, OfMagnitudesSayNothingOfWeberFractions) {
  HandMadeStudy study;
  for (const char* name : {"P01", "P02"}) {
    study.add(name);
    for (const double scale : {0.0, 1.0, 2.0, 4.0}) study.estimate(scale, 60.0 * scale + 1.0);
  }
  const std::string words = words_of(study);
  EXPECT_TRUE(has(words, "S = k I^a (Stevens 1957)"));
  EXPECT_TRUE(has(words, "Psychological Review 64"));
  for (const char* part : {"Weber", "Φ(ln", "Production", "Hierarchical", "Wichmann"}) {
    EXPECT_FALSE(has(words, part)) << part;
  }
}

TEST(MethodWords, EveryCitationHasItsWork) {
  EXPECT_EQ(literature_of({"Stevens 1957", "Holm 1979"}).front().substr(0, 4), "Holm");
  EXPECT_THROW((void)literature_of({"Nobody 1900"}), core::Error);
}

}  // namespace method_words_test
}  // namespace jnd::analysis
