#include "analysis/hierarchical/hierarchical_assumptions.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/psychometric_function.h"

namespace jnd::analysis {
namespace hierarchical_assumptions_test {

/// Returns ten people with w = 0.22 on average at easy levels, with twenty answers each, as
/// even as counts can be. `place_ln` shifts the pse of one person up and that of the next
/// person down.
std::vector<ParticipantAnswers> people(double place_ln, int num_lapses) {
  std::vector<ParticipantAnswers> all;
  for (int person = 0; person < 10; ++person) {
    const double w = 0.22 * std::exp(0.05 * (person - 4.5));
    const double place = person % 2 == 0 ? place_ln : -place_ln;
    ParticipantAnswers one{.participant = "P" + std::to_string(person), .reference = 1.0};
    for (const double x : {0.6, 0.75, 0.87, 0.95, 1.06, 1.16, 1.4, 1.8}) {
      const double z = (std::log(x) - place) / std::log1p(w);
      one.rows.push_back({x, std::llround(20.0 * core::standard_normal_cdf(z)), 20});
    }
    one.rows.front().num_yes += num_lapses;
    one.rows.back().num_yes -= num_lapses;
    all.push_back(one);
  }
  return all;
}

std::vector<std::string> cautions_of(const std::vector<ParticipantAnswers>& answers,
                                     const HierarchicalOptions& options) {
  HierarchicalFit fit = fit_hierarchical(answers, options);
  EXPECT_EQ(fit.status, FitStatus::kOk) << fit.reason;
  const std::string before = fit.note;
  tell_assumptions(fit, answers, options);
  const bool assumes = options.lapses != HierarchicalLapses::kCommon ||
                       options.pse == HierarchicalPse::kReference ||
                       options.pse == HierarchicalPse::kCommon;
  EXPECT_EQ(fit.note.find("the intervals hold if ") != std::string::npos, assumes) << fit.note;
  EXPECT_EQ(fit.note == before, !assumes);
  return fit.conditions[0].cautions;
}

TEST(HierarchicalAssumptions, ThatThereAreNoLapsesIsToldWhereAnswersSpeakAgainstIt) {
  const HierarchicalOptions none{.lapses = HierarchicalLapses::kNone};
  const auto cautions = cautions_of(people(0.0, 1), none);
  ASSERT_EQ(cautions.size(), 1U);
  EXPECT_NE(cautions[0].find("assumption that the lapse rate is 0: with a free lapse rate"),
            std::string::npos)
      << cautions[0];
  EXPECT_TRUE(cautions_of(people(0.0, 0), none).empty());
  EXPECT_TRUE(cautions_of(people(0.0, 1), {}).empty()) << "nothing is assumed";
}

TEST(HierarchicalAssumptions, ThatEverybodysPseIsTheReferenceIsToldWhereItIsNot) {
  const HierarchicalOptions at_reference{.pse = HierarchicalPse::kReference};
  const auto cautions = cautions_of(people(0.2, 0), at_reference);
  ASSERT_FALSE(cautions.empty());
  EXPECT_NE(cautions.back().find("that everybody's pse is the reference: with a pse of each"),
            std::string::npos)
      << cautions.back();
  EXPECT_TRUE(cautions_of(people(0.0, 0), at_reference).empty());
  const auto common = cautions_of(people(0.2, 0), {.pse = HierarchicalPse::kCommon});
  ASSERT_FALSE(common.empty());
  EXPECT_NE(common.back().find("that everybody's pse is the same"), std::string::npos)
      << common.back();
}

TEST(HierarchicalAssumptions, BothAreNamedWhereBothAreMade) {
  const auto cautions = cautions_of(people(0.2, 1), {.pse = HierarchicalPse::kReference,
                                                     .lapses = HierarchicalLapses::kKnown,
                                                     .lapse_rate = 0.0});
  ASSERT_FALSE(cautions.empty());
  EXPECT_NE(cautions.back().find("a pse of each person's own and a free lapse rate"),
            std::string::npos)
      << cautions.back();
}

}  // namespace hierarchical_assumptions_test
}  // namespace jnd::analysis
