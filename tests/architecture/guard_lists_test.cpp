#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "support/files.h"
#include "support/places.h"

// `./dev guards` and `./dev chaos --mutants` take hours, so nobody runs them for a change that
// only moves a line. Without this test, a guard whose line is no longer found would go untested
// until then.

namespace jnd::architecture {
namespace guard_lists_test {

struct Guard {
  std::string head;  ///< For example "device/haptic_loop.cpp: the heartbeat".
  std::string code;
};

std::vector<Guard> guards_of(const std::filesystem::path& list) {
  std::vector<Guard> guards;
  std::ifstream lines(list);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("@ ")) guards.push_back({.head = line.substr(2), .code = ""});
    if (!line.starts_with('-')) continue;
    std::string& code = guards.back().code;
    code += (code.empty() ? "" : "\n") + line.substr(1);
  }
  return guards;
}

int num_places(const std::string& text, const std::string& code) {
  int num = 0;
  for (std::size_t at = text.find(code); at != std::string::npos;
       at = text.find(code, at + 1)) {
    ++num;
  }
  return num;
}

TEST(GuardLists, EachGuardStandsOnceInTheCode) {
  const std::filesystem::path root = test_support::source_folder();
  for (const char* list : {"tests/guards/guards.txt", "tests/chaos/guards.txt"}) {
    const std::vector<Guard> guards = guards_of(root / list);
    EXPECT_GT(guards.size(), 10U) << list;
    for (const Guard& guard : guards) {
      const std::string file = guard.head.substr(0, guard.head.find(':'));
      EXPECT_FALSE(guard.code.empty()) << guard.head;
      EXPECT_EQ(num_places(test_support::read_file(root / file), guard.code), 1)
          << list << ": " << guard.head << "; write there what the code is now";
    }
  }
}

}  // namespace guard_lists_test
}  // namespace jnd::architecture
