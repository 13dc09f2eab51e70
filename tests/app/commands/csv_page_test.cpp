#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "app/commands/fit_fixture.h"
#include "support/files.h"
#include "support/places.h"

namespace jnd::app {
namespace csv_page_test {

/// Returns the text of each block of the page that stands between ```KIND and ```.
std::vector<std::string> blocks(const std::string& page, const std::string& kind) {
  std::vector<std::string> found;
  std::istringstream lines(page);
  bool inside = false;
  for (std::string line; std::getline(lines, line);) {
    if (!inside && line == "```" + kind) {
      inside = true;
      found.emplace_back();
    } else if (inside && line == "```") {
      inside = false;
    } else if (inside) {
      found.back() += line + "\n";
    }
  }
  return found;
}

class CsvPage : public FitFixture {};

TEST_F(CsvPage, EveryCommandOfThePageRuns) {
  const std::string page = test_support::read_file(test_support::source_folder() / "docs" /
                                                   "from_my_csv_to_a_figure.md");
  const std::vector<std::string> tables = blocks(page, "csv");
  ASSERT_EQ(tables.size(), 1U);
  table("order.csv", tables[0]);
  int num_commands = 0;
  for (const std::string& block : blocks(page, "sh")) {
    std::istringstream lines(block);
    for (std::string line; std::getline(lines, line);) {
      std::istringstream words(line);
      std::vector<std::string> command;
      for (std::string word; words >> word;) command.push_back(word);
      ASSERT_FALSE(command.empty());
      ASSERT_EQ(command.front(), "jnd") << line;
      command.erase(command.begin());
      const test_support::ProgramOutcome outcome = jnd(command);
      EXPECT_EQ(outcome.exit_code, 0) << line << outcome.err;
      EXPECT_FALSE(outcome.out.empty()) << line;
      ++num_commands;
    }
  }
  EXPECT_EQ(num_commands, 8);
  EXPECT_TRUE(std::filesystem::exists(path("order.svg")));
}

}  // namespace csv_page_test
}  // namespace jnd::app
