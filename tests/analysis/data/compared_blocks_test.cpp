#include "analysis/data/compared_blocks.h"

#include <gtest/gtest.h>

#include <array>
#include <stdexcept>
#include <string>

#include "analysis/hand_made_study.h"
#include "analysis/results/study_results.h"
#include "analysis/results/test_families.h"
#include "core/error.h"

namespace jnd::analysis {
namespace compared_blocks_test {

BlockDesign block(const std::string& name, const std::string& procedure = "constant_stimuli",
                  const std::string& quantity = "viscosity_pa_s") {
  return {
      .block = name, .procedure = procedure, .quantity = quantity, .reference_intensity = 2};
}

std::vector<std::string> pairs(const std::vector<BlockDesign>& blocks,
                               const std::vector<BlockNames>& asked = {}) {
  std::vector<std::string> names;
  for (const ComparedBlocks& pair : compared_blocks(blocks, asked)) {
    names.push_back(pair.first.block + pair.second.block + (pair.has_primary ? "!" : ""));
  }
  return names;
}

using Names = std::vector<std::string>;

TEST(ComparedBlocks, AreEveryTwoOfAQuantity) {
  EXPECT_EQ(pairs({block("a"), block("b"), block("c")}), (Names{"ab!", "ac!", "bc!"}));
  EXPECT_EQ(
      pairs({block("a"), block("s", "constant_stimuli", "stiffness_n_per_m"), block("b")}),
      Names{"ab!"});
  EXPECT_EQ(pairs({block("a")}), Names{});
}

TEST(ComparedBlocks, OfManyAreEachWithTheNext) {
  EXPECT_EQ(pairs({block("a"), block("b"), block("c"), block("d"), block("e"), block("f")}),
            (Names{"ab!", "bc!", "cd!", "de!", "ef!"}));
}

TEST(ComparedBlocks, OfOtherProceduresHaveNoPrimaryTestUnlessNoneHas) {
  EXPECT_EQ(pairs({block("a"), block("q", "quest_plus"), block("b")}),
            (Names{"aq", "ab!", "qb"}));
  EXPECT_EQ(pairs({block("a"), block("q", "quest_plus")}), Names{"aq!"});
  BlockDesign intervals = block("i");
  intervals.written.settings.set("task", "two_interval");
  EXPECT_EQ(pairs({block("a"), intervals, block("b")}), (Names{"ai", "ab!", "ib"}));
}

TEST(ComparedBlocks, AreThoseAskedForInTheirOrder) {
  EXPECT_EQ(pairs({block("a"), block("q", "quest_plus"), block("b")}, {{"b", "a"}, {"a", "q"}}),
            (Names{"ba!", "aq!"}));
}

TEST(ComparedBlocks, RefuseWhatCannotBeCompared) {
  const std::vector<BlockDesign> blocks = {block("a"),
                                           block("s", "constant_stimuli", "stiffness_n_per_m")};
  const auto problem = [&](const BlockNames& asked) -> std::string {
    try {
      (void)compared_blocks(blocks, {asked});
    } catch (const core::Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(problem({"a", "x"}),
            "--compare: expected two of the blocks with a Weber fraction (a, s), found `x`");
  EXPECT_EQ(problem({"a", "a"}), "--compare: expected two different blocks, found `a` twice");
  EXPECT_EQ(problem({"a", "s"}),
            "--compare: expected two blocks of the same quantity, found viscosity_pa_s in `a` "
            "and stiffness_n_per_m in `s`");
}

/// Returns the results of three people, each in three blocks.
StudyResults results(const std::vector<BlockNames>& compared) {
  HandMadeStudy study;
  int person = 0;
  for (const auto& [thin, middle, thick] : {std::array{7, 8, 9}, {6, 8, 7}, {8, 7, 9}}) {
    study.add("P0" + std::to_string(++person));
    study.compare_ten("thin", thin);
    study.compare_ten("middle", middle);
    study.compare_ten("thick", thick);
  }
  return results_of(load_study(study.store()), {},
                    {.num_resamples = 100, .compared = compared});
}

Names primary_tests(const StudyResults& results, const char* family) {
  Names names;
  for (const ResultsSection& section : results.sections) {
    for (const NamedComparison& named : section.comparisons) {
      if (!named.primary) continue;
      EXPECT_TRUE(named.p_value_holm.has_value()) << named.name;
      EXPECT_EQ(named.family, family);
      names.push_back(section.name);
    }
  }
  return names;
}

TEST(ComparedBlocks, OfOtherPeopleAreTwoGroups) {
  HandMadeStudy study;
  int person = 0;
  for (const int num_right : {7, 8, 9, 6}) {
    study.add("P0" + std::to_string(++person));
    study.compare_ten(person < 3 ? "thin" : "thick", num_right);
  }
  const auto between = [](const StudyResults& all) {
    for (const ResultsSection& section : all.sections) {
      for (const NamedComparison& named : section.comparisons) {
        if (named.primary) return named.comparison.of_other_people;
      }
    }
    throw std::runtime_error("no primary comparison");
  };
  EXPECT_TRUE(between(results_of(load_study(study.store()), {}, {.num_resamples = 100})));
  EXPECT_FALSE(between(results({{"thin", "thick"}})));
}

TEST(ComparedBlocks, NobodyPlannedThemWhetherChosenByNobodyOrAskedFor) {
  EXPECT_EQ(primary_tests(results({}), kPairsFamily),
            (Names{"middle_against_thick", "middle_against_thin", "thick_against_thin"}));
  EXPECT_EQ(primary_tests(results({{"thin", "thick"}}), kAskedFamily),
            Names{"thin_against_thick"});
}

TEST(ComparedBlocks, SaysOfBothFamiliesWhatTheirPValuesAre) {
  EXPECT_EQ(family_note({.name = "a", .comparison = {}, .family = kPairsFamily}), kPairsNote);
  EXPECT_EQ(family_note({.name = "a", .comparison = {}, .family = kAskedFamily}), kAskedNote);
  EXPECT_EQ(family_note({.name = "a", .comparison = {}, .family = kMovementFamily}), "");
  EXPECT_EQ(std::string(kPairsFamily).find("exploratory"), 0U);
}

}  // namespace compared_blocks_test
}  // namespace jnd::analysis
