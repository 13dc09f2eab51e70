#include "analysis/hierarchical/hierarchical_data.h"

#include <gtest/gtest.h>

#include <string>

#include "core/error.h"

namespace jnd::analysis {
namespace hierarchical_data_test {

std::vector<ParticipantAnswers> answers_of(const std::string& text,
                                           std::optional<double> reference = std::nullopt) {
  return read_participant_answers(CsvTable::parse(text, "t.csv"), reference);
}

TEST(HierarchicalData, AReferenceIsANumberHoweverItIsWritten) {
  const std::vector<ParticipantAnswers> all = answers_of(
      "participant,condition,reference,intensity,num_yes,num_trials\n"
      "A,d,1.0,0.5,1,10\n"
      "A,d,1,2,9,10\n"
      "B,d,1e0,0.5,2,10\n"
      "A,d,+1.00,3,10,10\n"
      "B,d, 1 ,2,8,10\n");
  ASSERT_EQ(all.size(), 2U) << "one entry a participant and condition";
  EXPECT_EQ(all[0].participant, "A");
  EXPECT_EQ(all[0].reference, 1.0);
  ASSERT_EQ(all[0].rows.size(), 3U);
  EXPECT_EQ(all[0].rows[2].num_yes, 10);
  EXPECT_EQ(all[1].participant, "B");
  EXPECT_EQ(all[1].rows.size(), 2U);
}

TEST(HierarchicalData, ParticipantsAndConditionsAreWords) {
  const std::vector<ParticipantAnswers> all = answers_of(
      "participant,condition,intensity,num_yes,num_trials\n"
      "1,d,0.5,1,10\n"
      "01,d,0.5,1,10\n"
      "1,e,0.5,1,10\n",
      2.0);
  ASSERT_EQ(all.size(), 3U);
  EXPECT_EQ(all[1].participant, "01");
  EXPECT_EQ(all[2].condition, "e");
  EXPECT_EQ(all[2].reference, 2.0);
}

TEST(HierarchicalData, AReferenceThatIsNoneIsRefusedAtItsLine) {
  try {
    (void)answers_of(
        "participant,reference,intensity,num_yes,num_trials\nA,1,1,1,2\nA,0,1,1,2\n");
    FAIL() << "a reference of 0 was accepted";
  } catch (const core::Error& error) {
    EXPECT_STREQ(error.what(), "t.csv:3: reference: expected a number > 0, found \"0\"");
  }
}

}  // namespace hierarchical_data_test
}  // namespace jnd::analysis
