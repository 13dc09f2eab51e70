#include "core/storage/table_rules.h"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>

#include "core/storage/study_format.h"

namespace jnd::core {
namespace table_rules_test {

std::map<std::string, std::set<std::string>> tables_by_rule() {
  Database study;
  bring_up_to_date(study);
  std::map<std::string, std::set<std::string>> tables;
  for (const TableRule& rule : table_rules(study)) {
    tables["erased by " + rule.erased_by].insert(rule.table);
    if (!rule.is_compared) tables["not compared"].insert(rule.table);
  }
  return tables;
}

using Tables = std::set<std::string>;

TEST(TableRules, SayOfEveryTableWhetherAWithdrawalEmptiesIt) {
  const auto tables = tables_by_rule();
  EXPECT_EQ(tables.at("erased by session"),
            (Tables{"acknowledgement", "answer", "design", "event", "presentation",
                    "question_answer", "session", "trial"}));
  EXPECT_EQ(tables.at("erased by participant"), Tables{"appointment"});
  EXPECT_EQ(tables.at("erased by "),
            (Tables{"adverse_event", "backup", "device_profile", "export", "export_session",
                    "planned_number", "protocol", "sequential_look", "sequential_look_session",
                    "study_format", "study_identity", "unblinding", "unsealing", "withdrawal",
                    "withdrawal_step"}))
      << "what no column tells of a person has to hold nothing of one";
}

TEST(TableRules, SayWhichTablesABackupComparesOtherwiseOrNotAtAll) {
  EXPECT_EQ(tables_by_rule().at("not compared"),
            (Tables{"answer", "backup", "design", "event", "export", "export_session",
                    "presentation", "question_answer", "study_format", "study_identity",
                    "trial", "withdrawal", "withdrawal_step"}));
}

}  // namespace table_rules_test
}  // namespace jnd::core
