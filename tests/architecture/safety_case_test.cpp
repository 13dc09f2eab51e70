#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "core/safety/fault.h"
#include "support/files.h"
#include "support/places.h"

namespace safety_case_test {

namespace fs = std::filesystem;

/// Returns the rows of the table of hazards in SAFETY.md, without its head.
std::vector<std::string> hazards() {
  std::vector<std::string> rows;
  std::ifstream stream(jnd::test_support::source_folder() / "SAFETY.md");
  for (std::string line; std::getline(stream, line);) {
    if (line.starts_with("| ") && !line.starts_with("| hazard") && !line.starts_with("| ---")) {
      rows.push_back(line);
    }
  }
  return rows;
}

/// Returns "Suite.Name" of every test in the tree, whatever its instance.
std::set<std::string> tests_there_are() {
  static const std::regex kPattern(R"re(\bTEST(?:_F|_P)?\(\s*(\w+),\s*(\w+)\))re");
  std::set<std::string> names;
  for (const auto& entry :
       fs::recursive_directory_iterator(jnd::test_support::source_folder() / "tests")) {
    if (entry.path().extension() != ".cpp") continue;
    const std::string text = jnd::test_support::read_file(entry.path());
    for (std::sregex_iterator at(text.begin(), text.end(), kPattern), end; at != end; ++at) {
      names.insert((*at)[1].str() + "." + (*at)[2].str());
    }
  }
  return names;
}

std::set<std::string> tests_named_in(const std::string& row) {
  static const std::regex kPattern(R"re(`(\w+\.\w+)`)re");
  std::set<std::string> names;
  for (std::sregex_iterator at(row.begin(), row.end(), kPattern), end; at != end; ++at) {
    names.insert((*at)[1].str());
  }
  return names;
}

TEST(SafetyCase, EveryHazardNamesTestsThatThereAre) {
  const std::set<std::string> there_are = tests_there_are();
  const std::vector<std::string> rows = hazards();
  ASSERT_GT(rows.size(), 15U);
  for (const std::string& row : rows) {
    const std::set<std::string> named = tests_named_in(row);
    EXPECT_FALSE(named.empty()) << row;
    for (const std::string& test : named) {
      EXPECT_TRUE(there_are.contains(test)) << test << " is named in SAFETY.md and is no test";
    }
  }
}

TEST(SafetyCase, EveryFaultIsAHazard) {
  std::string all;
  for (const std::string& row : hazards()) all += row;
  for (int number = 1; number <= static_cast<int>(jnd::core::kLastFault); ++number) {
    const auto name = std::string(jnd::core::name(static_cast<jnd::core::Fault>(number)));
    EXPECT_NE(all.find("(`" + name + "`)"), std::string::npos)
        << name << " has no row in SAFETY.md";
  }
}

}  // namespace safety_case_test
