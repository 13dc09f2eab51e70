#include "experiments/study/written_data.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

namespace jnd::experiments {
namespace {

/// What stands between the brackets of `CREATE TABLE name (`, in the layout of study folders.
std::string columns_of(const std::string& table) {
  std::ifstream stream(std::filesystem::path(JND_SOURCE_DIR) / "data/database/1_study.sql");
  const std::string sql{std::istreambuf_iterator<char>(stream), {}};
  const std::size_t begin = sql.find("CREATE TABLE " + table + " (");
  return begin == sql.npos ? "" : sql.substr(begin, sql.find(") WITHOUT ROWID", begin) - begin);
}

TEST(WrittenData, NamesColumnsThatTheStudyFolderHas) {
  const std::map<std::string, std::string> tables = {
      {"trials.csv", "trial"}, {"answers.csv", "answer"}, {"events.csv", "event"}};
  for (const ParameterTable* stage : stage_tables()) {
    for (const WrittenColumn& column : written_columns(*stage)) {
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

}  // namespace
}  // namespace jnd::experiments
