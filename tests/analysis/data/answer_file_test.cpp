#include "analysis/data/answer_file.h"

#include "analysis/data/answer_cells.h"

#include <gtest/gtest.h>

#include "core/error.h"

namespace jnd::analysis {
namespace answer_file_test {

const AnswerColumns kTrials = {.intensity = "x", .yes = "r"};

std::vector<AnswerTally> tallies(std::string_view text, const AnswerColumns& columns) {
  return parse_answers(text, "t.csv", columns).groups.at(0).tallies;
}

std::string problem(std::string_view text, const AnswerColumns& columns) {
  try {
    static_cast<void>(parse_answers(text, "t.csv", columns));
  } catch (const core::Error& error) {
    return error.what();
  }
  return "";
}

TEST(AnswerFile, AddsUpTrialsOfOneIntensity) {
  const auto found = tallies("x,r\n1,0\n2,1\n1,1\n-1.5,0\n1.0,1\n", kTrials);
  ASSERT_EQ(found.size(), 3U);
  EXPECT_EQ(found[0].intensity, 1.0);
  EXPECT_EQ(found[0].num_yes, 2);
  EXPECT_EQ(found[0].num_trials, 3);
  EXPECT_EQ(found[2].intensity, -1.5);
}

TEST(AnswerFile, TakesAnswersAsTheyAreWritten) {
  for (const char* text : {"x,r\n1,true\n1,False\n", "x,r\n1,1\n1,-1\n", "x,r\n1,1\n1,0\n",
                           "x,r\n1,1.0\n1,0.0\n", "x,r\n1,Yes\n1,no\n"}) {
    const auto found = tallies(text, kTrials);
    EXPECT_EQ(found.at(0).num_yes, 1) << text;
    EXPECT_EQ(found.at(0).num_trials, 2) << text;
  }
  AnswerColumns left = kTrials;
  left.yes_value = "left";
  EXPECT_EQ(tallies("x,r\n1,left\n1,right\n1,left\n", left).at(0).num_yes, 2);
}

TEST(AnswerFile, TakesCounts) {
  const AnswerColumns counts = {.intensity = "x", .yes = "k", .trials = "n"};
  const auto found = tallies("x,k,n\n1,3,10\n2,9,10\n1,4,10\n", counts);
  EXPECT_EQ(found.at(0).num_yes, 7);
  EXPECT_EQ(found.at(0).num_trials, 20);
  EXPECT_NE(problem("x,k,n\n1,11,10\n", counts).find("t.csv:2: k: expected a whole number"),
            std::string::npos);
}

TEST(AnswerFile, TakesSemicolonsTabsAndDecimalCommas) {
  EXPECT_EQ(tallies("x;r\n-1,5;1\n", kTrials).at(0).intensity, -1.5);
  EXPECT_EQ(tallies("x\tr\n1,5\t1\n", kTrials).at(0).intensity, 1.5);
  EXPECT_EQ(tallies("sep=;\nx;r\n1,5;1\n", kTrials).at(0).intensity, 1.5);
  EXPECT_EQ(tallies("\xEF\xBB\xBFx,r\r\n1.5,1\r\n", kTrials).at(0).intensity, 1.5);
}

TEST(AnswerFile, LeavesOutAndCountsRowsWithoutAnAnswer) {
  const AnswerFile file =
      parse_answers("x,r,rt\n,,\n1,NA,\nNULL,1,\n2,1,0.4\nnan,1,\n", "t.csv", kTrials);
  EXPECT_EQ(file.num_rows, 5);
  EXPECT_EQ(file.num_missing.at("x"), 3);
  EXPECT_EQ(file.num_missing.at("r"), 1);
  ASSERT_EQ(file.groups.at(0).tallies.size(), 1U);
}

TEST(AnswerFile, AConditionMayBeCalledNone) {
  AnswerColumns columns = kTrials;
  columns.group_by = {"drug"};
  const AnswerFile file = parse_answers(
      "drug,x,r\nnone,1,1\nNA,1,1\nNull,1,0\n,1,0\nlow,None,1\n", "t.csv", columns);
  ASSERT_EQ(file.groups.size(), 2U);
  EXPECT_EQ(file.groups[0].key[0].second, "none");
  EXPECT_EQ(file.groups[1].key[0].second, "Null");
  EXPECT_EQ(file.num_missing.at("drug"), 2);
  EXPECT_EQ(file.num_missing.at("x"), 1);
}

TEST(AnswerFile, TwoColumnsOfOneNameAreRefusedWhereTheyAreUsed) {
  EXPECT_NE(problem("x,r,r\n1,1,0\n", kTrials)
                .find("t.csv:1: r: expected one column of this name, found 2"),
            std::string::npos);
  EXPECT_EQ(problem("x,r,rt,rt\n1,1,0,0\n", kTrials), "");
}

TEST(AnswerFile, TellsWhatEveryNoWasAndACellThatNoRowHas) {
  AnswerColumns columns = kTrials;
  columns.yes_value = "1";
  const AnswerFile file = parse_answers("x,r\n1,1\n1,0\n2,9\n2,9\n", "t.csv", columns);
  EXPECT_EQ(file.num_no.at("0"), 1);
  EXPECT_EQ(file.num_no.at("9"), 2);
  columns.where = {{"block", "Main"}};
  EXPECT_EQ(problem("x,r,block\n1,1,main\n1,0,practice\n", columns),
            "t.csv: block: expected rows with \"Main\", which --where asks for, found none; "
            "there are \"main\", \"practice\"");
}

TEST(AnswerFile, ColumnsOfRightAnswersAreKnownByTheirNames) {
  for (const char* name : {"correct", "Correct", "corr", "key_resp.corr", "ACC"}) {
    EXPECT_TRUE(is_called_right(name)) << name;
  }
  for (const char* name : {"yes", "correction", "response", "corr.rt", ""}) {
    EXPECT_FALSE(is_called_right(name)) << name;
  }
}

TEST(AnswerFile, GroupsAndTakesTheRowsThatAreAskedFor) {
  AnswerColumns columns = kTrials;
  columns.group_by = {"who", "eye"};
  columns.where = {{"block", "2"}};
  const AnswerFile file = parse_answers(
      "who,eye,block,x,r\nA,l,2,1,1\nB,l,2,1,0\nA,l,1,1,0\nA,l,2.0,1,0\nA,r,2,1,1\n", "t.csv",
      columns);
  ASSERT_EQ(file.groups.size(), 3U);
  EXPECT_EQ(file.num_elsewhere, 1);
  EXPECT_EQ(file.groups[0].key[0].second, "A");
  EXPECT_EQ(file.groups[0].tallies[0].num_trials, 2);
  EXPECT_EQ(file.groups[2].key[1].second, "r");
}

TEST(AnswerFile, TakesWhatPsychoPyWrites) {
  // Each line ends in a comma, instruction rows are empty, and some rows are shorter.
  const AnswerFile file = parse_answers(
      "level,trials.thisN,resp.keys,resp.corr,date,\n"
      ",,,,2026-01-05,\n"
      "0.5,0,left,1,2026-01-05,\n"
      "0.25,1,None,0,2026-01-05,\n"
      "0.5,2,right,0\n"
      "extraInfo\nparticipant,P01\n",
      "t.csv", {.intensity = "level", .yes = "resp.corr"});
  EXPECT_EQ(file.num_rows, 4);
  EXPECT_EQ(file.num_missing.at("level"), 1);
  EXPECT_EQ(file.groups[0].tallies[0].num_trials, 2);
  EXPECT_EQ(file.groups[0].tallies[0].num_yes, 1);
}

TEST(AnswerFile, TakesWhatJsPsychWrites) {
  const std::string json =
      R"([{"trial_type":"html-keyboard-response","stimulus":"Welcome","response":" "},
          {"rt":512,"correct":true,"response":"f","data":{"offset":-2.5}},
          {"rt":null,"correct":null,"response":null,"data":{"offset":-2.5}},
          {"rt":430,"correct":false,"response":"j","data":{"offset":-2.5}}])";
  const AnswerFile file =
      parse_answers(json, "t.json", {.intensity = "data.offset", .yes = "correct"});
  EXPECT_EQ(file.num_rows, 4);
  EXPECT_EQ(file.groups[0].tallies.at(0).intensity, -2.5);
  EXPECT_EQ(file.groups[0].tallies.at(0).num_yes, 1);
  EXPECT_EQ(file.groups[0].tallies.at(0).num_trials, 2);
  const std::string csv =
      "\"rt\",\"stimulus\",\"response\",\"offset\",\"correct\"\n"
      "\"512\",\"<p>a, b</p>\",\"{\"\"Q0\"\":\"\"x\"\"}\",\"-2.5\",\"true\"\n"
      "\"null\",\"\",\"\",\"\",\"\"\n";
  const AnswerFile table =
      parse_answers(csv, "t.csv", {.intensity = "offset", .yes = "correct"});
  EXPECT_EQ(table.groups[0].tallies.at(0).num_yes, 1);
  EXPECT_EQ(table.num_missing.at("offset"), 1);
}

TEST(AnswerFile, ATrialOfJsPsychThatWasMissedIsNoWrongAnswer) {
  const std::string header = "rt,response,trial_type,trial_index,offset,correct\n";
  const std::string rows =
      "612,f,html-keyboard-response,1,20,true\nnull,null,html-keyboard-response,2,20,false\n"
      "455,j,html-keyboard-response,3,20,false\n,,html-keyboard-response,4,20,false\n";
  const AnswerFile file =
      parse_answers(header + rows, "t.csv", {.intensity = "offset", .yes = "correct"});
  EXPECT_EQ(file.groups[0].tallies[0].num_trials, 2);
  EXPECT_EQ(file.groups[0].tallies[0].num_yes, 1);
  EXPECT_EQ(file.num_missing.at("response"), 2);
  // In a task of go and no-go no response is right at times: then it is an answer.
  const AnswerFile go =
      parse_answers(header + rows + "null,null,html-keyboard-response,5,20,true\n", "t.csv",
                    {.intensity = "offset", .yes = "correct"});
  EXPECT_EQ(go.groups[0].tallies[0].num_trials, 5);
  EXPECT_TRUE(go.num_missing.empty());
  // A column of that name in another program's table means nothing.
  const AnswerFile other = parse_answers("response,offset,correct\n,20,false\n", "t.csv",
                                         {.intensity = "offset", .yes = "correct"});
  EXPECT_EQ(other.groups[0].tallies[0].num_trials, 1);
}

TEST(AnswerFile, SaysWhereWhatIsWrong) {
  EXPECT_EQ(problem("x,r\n1,maybe\n", kTrials),
            "t.csv:2: r: expected 0 or 1, true or false, or -1 or 1; --yes-value names what is "
            "a yes, found \"maybe\"");
  EXPECT_EQ(problem("x,r\n1,1\nloud,1\n", kTrials),
            "t.csv:3: x: expected a number, found \"loud\"");
  EXPECT_EQ(problem("level,r\n1,1\n", kTrials),
            "t.csv:1: x: expected a column of this name, found the columns level, r");
  EXPECT_NE(problem("x,r\n1,5,1\n", kTrials).find("t.csv:2: expected 2 cells, found 3"),
            std::string::npos);
  EXPECT_NE(problem("", kTrials).find("expected a header line"), std::string::npos);
  EXPECT_NE(problem("x,r\n\"1,1\n", kTrials).find("closing quote"), std::string::npos);
  EXPECT_NE(problem("[1, 2", kTrials).find("no JSON"), std::string::npos);
  AnswerColumns log_axis = kTrials;
  log_axis.signed_intensities = false;
  EXPECT_NE(problem("x,r\n-1,1\n", log_axis).find("a number >= 0 on a logarithmic axis"),
            std::string::npos);
}

TEST(AnswerFile, SeesPeopleThatAreAddedUp) {
  const AnswerFile file = parse_answers("participant,x,r\nA,1,1\nB,1,0\n", "t.csv", kTrials);
  EXPECT_EQ(file.num_pooled.at("participant"), 2U);
}

}  // namespace answer_file_test
}  // namespace jnd::analysis
