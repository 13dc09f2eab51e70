#include "core/storage/table_rules.h"

#include <algorithm>
#include <iterator>
#include <string_view>

namespace jnd::core {
namespace {

struct Exception {
  std::string_view table;
  bool stays = false;       ///< A withdrawal leaves its rows.
  bool is_compared = true;  ///< A backup's rows are compared with the study's.
  std::string_view row;     ///< "" if its name says what it is.
};

constexpr Exception kExceptions[] = {
    // A newer program may have brought the copy to a newer layout.
    {.table = "study_format", .is_compared = false},
    // A copy of another study is refused before.
    {.table = "study_identity", .is_compared = false},
    // The last event of each session is compared, and the rest of a session comes with events.
    {.table = "event", .is_compared = false},
    {.table = "design", .is_compared = false},
    {.table = "presentation", .is_compared = false},
    {.table = "trial", .is_compared = false},
    {.table = "answer", .is_compared = false},
    {.table = "question_answer", .is_compared = false},
    // The tombstones of a withdrawal, whose sessions are compared; a copy notes for itself how
    // far its own erasure is.
    {.table = "withdrawal", .stays = true, .is_compared = false},
    {.table = "withdrawal_step", .stays = true, .is_compared = false},
    // The study takes over what the copy knows. Numbers of sessions alone say where a file of
    // somebody who withdrew may still be.
    {.table = "backup", .is_compared = false},
    {.table = "export", .is_compared = false},
    {.table = "export_session", .stays = true, .is_compared = false},
    // A record of harm has to be kept.
    {.table = "adverse_event", .stays = true, .row = "an adverse event"},
    // A look has to show which sessions decided it.
    {.table = "sequential_look", .row = "a look at the study"},
    {.table = "sequential_look_session", .stays = true, .row = "a session of a look"},
    {.table = "protocol", .row = "a study file"},
    {.table = "acknowledgement", .row = "a note that was read"},
    {.table = "planned_number", .row = "a planned number of people"},
};

std::string with_article(std::string_view name) {
  const bool begins_with_vowel =
      std::string_view("aeiou").find(name[0]) != std::string_view::npos;
  std::string words = (begins_with_vowel ? "an " : "a ") + std::string(name);
  std::ranges::replace(words, '_', ' ');
  return words;
}

bool has_column(Database& database, const std::string& table, const std::string& column) {
  return Statement(database, "SELECT 1 FROM pragma_table_info(?) WHERE name = ?")
      .bind(table)
      .bind(column)
      .step();
}

}  // namespace

std::vector<TableRule> table_rules(Database& database) {
  Statement names(database,
                  "SELECT name FROM sqlite_master WHERE type = 'table'"
                  " AND name NOT LIKE 'sqlite\\_%' ESCAPE '\\' ORDER BY name");
  std::vector<TableRule> rules;
  while (names.step()) {
    TableRule rule{.table = names.text(0)};
    const auto* known = std::ranges::find(kExceptions, rule.table, &Exception::table);
    const Exception exception = known == std::end(kExceptions) ? Exception{} : *known;
    rule.is_compared = exception.is_compared;
    rule.row = exception.row.empty() ? with_article(rule.table) : std::string(exception.row);
    for (const char* column : {"participant", "session"}) {
      if (!exception.stays && has_column(database, rule.table, column)) rule.erased_by = column;
    }
    rules.push_back(std::move(rule));
  }
  return rules;
}

}  // namespace jnd::core
