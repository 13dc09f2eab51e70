#pragma once

#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

#include "core/storage/study_store.h"

namespace jnd::app {

inline std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// Returns the complete lines of `text`. A killed program may leave an incomplete last line,
/// which is dropped.
inline std::vector<std::string> whole_lines_of(const std::string& text) {
  return lines_of(text.substr(0, text.rfind('\n') + 1));
}

/// Expects that the database holds every acknowledged line as it was printed. Returns how many
/// events the database holds.
inline std::size_t check_acknowledged(const core::StudyStore& store,
                                      const std::vector<std::string>& lines) {
  const std::vector<core::EventRow> events = store.events(1);
  for (const std::string& line : lines) {
    std::istringstream words(line);
    std::string word;
    std::size_t sequence = 0;
    std::string kind;
    words >> word >> sequence >> kind;
    EXPECT_EQ(word, "EVENT") << line;
    EXPECT_TRUE(words.eof()) << line;
    if (sequence < 1 || sequence > events.size()) {
      ADD_FAILURE() << "acknowledged and lost: " << line;
      continue;
    }
    EXPECT_EQ(events[sequence - 1].kind, kind) << line;
  }
  return events.size();
}

}  // namespace jnd::app
