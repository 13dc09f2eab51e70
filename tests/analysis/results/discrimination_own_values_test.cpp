#include "analysis/results/discrimination_own_values.h"

#include <gtest/gtest.h>

#include <array>

#include "analysis/hand_made_study.h"
#include "core/error.h"

namespace jnd::analysis {
namespace discrimination_own_values_test {

constexpr double kReferencePaS = 1.853;
constexpr std::array kLevelsPaS = {1.093, 1.237, 1.646, 1.7495, 2.203, 2.553, 3.185, 3.883};
const ResultsOptions kQuick = {.num_resamples = 50, .seed = 1};

/// Adds a person with five answers at each level, of which these numbers are "more than the
/// reference".
void add_person(HandMadeStudy& study, const std::string& name,
                const std::array<int, kLevelsPaS.size()>& num_yes) {
  study.add(name);
  for (std::size_t level = 0; level < kLevelsPaS.size(); ++level) {
    for (int answer = 0; answer < 5; ++answer) {
      study.compare("group_d", kLevelsPaS[level], kReferencePaS, answer < num_yes[level]);
    }
  }
}

const ParticipantEstimate* find(const StudyResults& of, const std::string& person,
                                const std::string& name) {
  for (const ResultsSection& section : of.sections) {
    for (const ParticipantEstimate& own : section.participants) {
      if (own.participant == person && own.name == name) return &own;
    }
  }
  return nullptr;
}

const ParticipantEstimate& own(const StudyResults& of, const std::string& person,
                               const std::string& name) {
  const ParticipantEstimate* const found = find(of, person, name);
  if (found == nullptr) throw core::Error("no own value " + name);
  return *found;
}

/// Holds two people: one whose bias no curve through the reference describes, and one whom such
/// a curve describes well.
class DiscriminationOwnValues : public ::testing::Test {
 protected:
  DiscriminationOwnValues() {
    add_person(study_, "BIASED", {3, 5, 5, 5, 4, 5, 5, 5});
    add_person(study_, "SOUND", {0, 1, 2, 2, 4, 4, 5, 5});
    add_person(study_, "ALL_YES", {5, 5, 5, 5, 5, 5, 5, 5});
  }
  [[nodiscard]] StudyResults results() const {
    return results_of(load_study(study_.store()), {}, kQuick);
  }
  HandMadeStudy study_;
};

// The values are from R 4.2.2: glm(cbind(k, 5 - k) ~ u, binomial(probit)) with u = ln(x /
// 1.853), with and without intercept. The p values over 4000 redraws are 0.0002 and 0.947
// there.
TEST_F(DiscriminationOwnValues, HaveTheCurveWithItsPlaceFreeAndWhetherTheDataBearEach) {
  const StudyResults of = results();
  EXPECT_NEAR(*own(of, "BIASED", "group_d.weber_fraction").value, 1.84565093, 1e-6);
  EXPECT_NEAR(*own(of, "BIASED", "group_d.weber_fraction_free_pse").value, 1.00655912, 1e-6);
  EXPECT_NEAR(*own(of, "BIASED", "group_d.pse").value, 0.62689279, 1e-6);
  EXPECT_LT(*own(of, "BIASED", "group_d.goodness_p").value, 0.01);
  EXPECT_NEAR(*own(of, "SOUND", "group_d.weber_fraction_free_pse").value, 0.35001030, 1e-6);
  EXPECT_NEAR(*own(of, "SOUND", "group_d.pse").value, 1.79525135, 1e-6);
  EXPECT_NEAR(*own(of, "SOUND", "group_d.goodness_p").value, 0.947, 0.03);
  EXPECT_GT(*own(of, "SOUND", "group_d.goodness_p_free_pse").value, 0.05);
  EXPECT_TRUE(own(of, "SOUND", "group_d.pse").ci95.low.has_value());
}

TEST_F(DiscriminationOwnValues, OfAnswersAllAlikeHaveNeitherPlaceNorGoodness) {
  const StudyResults of = results();
  const ParticipantEstimate& free = own(of, "ALL_YES", "group_d.weber_fraction_free_pse");
  EXPECT_FALSE(free.value);
  EXPECT_FALSE(free.reason.empty());
  EXPECT_EQ(find(of, "ALL_YES", "group_d.goodness_p_free_pse"), nullptr);
}

TEST_F(DiscriminationOwnValues, CountThoseWhomTheCurveThroughTheReferenceDoesNotDescribe) {
  const StudyResults of = results();
  const ResultsSection& section = of.sections.front();
  ASSERT_EQ(section.name, "group_d");
  const FitsBorne borne = fits_borne(section, "group_d");
  const ParticipantEstimate* const all_yes = find(of, "ALL_YES", "group_d.goodness_p");
  EXPECT_EQ(borne.num_fits, all_yes == nullptr ? 2 : 3);
  EXPECT_EQ(borne.num_rejected, all_yes == nullptr || *all_yes->value >= 0.05 ? 1 : 2);
}

TEST_F(DiscriminationOwnValues, AreTheSameEveryTime) {
  EXPECT_EQ(*own(results(), "SOUND", "group_d.goodness_p").value,
            *own(results(), "SOUND", "group_d.goodness_p").value);
}

TEST_F(DiscriminationOwnValues, AFractionOfAnswersThatAreAllAlikeSaysWhatItRestsOn) {
  const StudyResults of = results();
  EXPECT_EQ(own(of, "ALL_YES", "group_d.weber_fraction").cautions.size(), 1U);
  EXPECT_TRUE(own(of, "SOUND", "group_d.weber_fraction").cautions.empty());
}

}  // namespace discrimination_own_values_test
}  // namespace jnd::analysis
