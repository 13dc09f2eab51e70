#include "experiments/protocol/written_data.h"
#include "experiments/protocol/study_table.h"
#include "support/files.h"
#include "support/places.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <iterator>
#include <set>

namespace jnd::experiments {
namespace written_data_test {

std::string layout(const std::string& name) {
  return test_support::read_file(test_support::source_folder() / "data/database" / name);
}

/// What stands between the brackets of `CREATE TABLE name (` in the layout of study folders,
/// and what later layouts added.
std::string columns_of(const std::string& table) {
  const std::string sql = layout("1_study.sql") + layout("8_answers_to_questions.sql");
  const std::size_t begin = sql.find("CREATE TABLE " + table + " (");
  std::string columns =
      begin == sql.npos ? "" : sql.substr(begin, sql.find(") WITHOUT ROWID", begin) - begin);
  const std::string added = "ALTER TABLE " + table + " ADD COLUMN ";
  const std::string later = layout("4_adaptive_trials.sql") + layout("9_three_intervals.sql");
  for (std::size_t at = later.find(added); at != later.npos; at = later.find(added, at)) {
    at += added.size();
    columns += "\n  " + later.substr(at, later.find(';', at) - at);
  }
  return columns;
}

TEST(WrittenData, NamesColumnsThatTheStudyFolderHas) {
  const std::map<std::string, std::string> tables = {{"trials.csv", "trial"},
                                                     {"answers.csv", "answer"},
                                                     {"events.csv", "event"},
                                                     {"questions.csv", "question_answer"}};
  // Exports compute these columns from the study file, or from the order of the intervals.
  const std::set<std::string> worked_out = {"is_practice", "right_interval", "chosen_interval"};
  for (const ParameterTable* stage : stage_tables()) {
    for (const WrittenColumn& column : written_columns(*stage)) {
      if (worked_out.contains(column.column)) continue;
      ASSERT_TRUE(tables.contains(column.file)) << column.file;
      EXPECT_NE(columns_of(tables.at(column.file)).find("\n  " + column.column + ' '),
                std::string::npos)
          << stage->name << ": " << column.file << ": " << column.column;
      EXPECT_FALSE(column.meaning.empty());
    }
  }
}

TEST(WrittenData, IsToldOfEveryStageThatAsksSomething) {
  for (const char* kind : {"checklist", "consent", "explore", "training", "block",
                           "post_experiment", "questionnaire"}) {
    EXPECT_FALSE(written_columns(*stage_table(kind)).empty()) << kind;
  }
}

TEST(WrittenData, OfAProcedureIsForOneThatExists) {
  const auto& allowed = stage_table("block")->find("procedure")->allowed;
  for (const WrittenColumn& column : written_columns(*stage_table("block"))) {
    for (const Condition& condition : column.only_where) {
      EXPECT_EQ(condition.key, "procedure");
      for (const std::string& name : condition.values) {
        EXPECT_NE(std::find(allowed.begin(), allowed.end(), name), allowed.end()) << name;
      }
    }
  }
}

}  // namespace written_data_test
}  // namespace jnd::experiments
