#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "app/commands/command_fixture.h"
#include "app/commands/listed_commands.h"
#include "app/manual/manual_page.h"
#include "app/sentence.h"

namespace jnd::app {
namespace man_pages_test {

namespace fs = std::filesystem;

class ManPagesTest : public CommandTest {
 protected:
  void SetUp() override { ASSERT_EQ(jnd({"man-pages", "man"}).exit_code, 0); }

  [[nodiscard]] std::string page(const std::vector<std::string>& words) const {
    std::string name = "jnd";
    for (const std::string& word : words) name += "-" + word;
    std::ifstream file(path("man") / (name + ".1"));
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
  }
};

/// Returns the option as the page writes it.
std::string typed(const std::string& option) {
  return std::regex_replace(option, std::regex("-"), "\\-");
}

TEST_F(ManPagesTest, EveryCommandHasAPageWithEveryOptionOfItsHelp) {
  std::set<std::string> files;
  for (const ListedCommand& command : listed_commands()) {
    const std::string text = page(command.words);
    EXPECT_NE(text.find(".SH SYNOPSIS"), std::string::npos) << joined(command.words);
    for (const std::string& option : command.options) {
      EXPECT_NE(text.find("\\fB" + typed(option) + "\\fR"), std::string::npos)
          << joined(command.words) << ' ' << option;
    }
    for (const std::string& argument : command.arguments) {
      EXPECT_NE(text.find(".TP\n\\fI" + typed(argument) + "\\fR"), std::string::npos)
          << joined(command.words) << ' ' << argument;
    }
  }
  const auto num_files = std::distance(fs::directory_iterator(path("man")), {});
  EXPECT_EQ(static_cast<std::size_t>(num_files), listed_commands().size());
}

TEST_F(ManPagesTest, WhatHelpHidesHasNoPage) {
  EXPECT_EQ(page({"man-pages"}), "");
  EXPECT_EQ(jnd({"--help"}).out.find("man-pages"), std::string::npos);
}

TEST_F(ManPagesTest, ManReadsEveryPageWithoutAWarning) {
  if (test_support::run_program({"--version"},
                                {.folder = {}, .environment = {}, .program = "man"})
          .exit_code != 0) {
    GTEST_SKIP() << "man is not installed";
  }
  for (const auto& entry : fs::directory_iterator(path("man"))) {
    const auto outcome = test_support::run_program(
        {"--warnings", "-E", "UTF-8", "-l", entry.path().string()},
        {.folder = {},
         .environment = {{"MANROFFSEQ", ""}, {"MANWIDTH", "80"}, {"LC_ALL", "C.UTF-8"}},
         .program = "man"});
    EXPECT_EQ(outcome.exit_code, 0) << entry.path();
    EXPECT_EQ(outcome.err, "") << entry.path();
    EXPECT_NE(outcome.out.find("SYNOPSIS"), std::string::npos) << entry.path();
  }
}

TEST_F(ManPagesTest, APageIsTheSameOnEveryMachine) {
  const std::string before = page({"demo"});
  EXPECT_NE(before.find("one for each processor"), std::string::npos) << before;
  ASSERT_EQ(jnd({"man-pages", "again"}).exit_code, 0);
  for (const auto& entry : fs::directory_iterator(path("man"))) {
    std::ifstream one(entry.path()), other(path("again") / entry.path().filename());
    std::ostringstream first, second;
    first << one.rdbuf();
    second << other.rdbuf();
    EXPECT_EQ(first.str(), second.str()) << entry.path();
  }
}

// Each example calls the command that it belongs to, with options that the command has.
TEST_F(ManPagesTest, EveryCommandHasExamplesOfOptionsThatItHas) {
  static const std::regex kOption("--[a-z][a-z0-9-]*");
  for (const ListedCommand& command : listed_commands()) {
    std::string name = "jnd";
    for (const std::string& word : command.words) name += " " + word;
    const std::vector<ManualExample> examples = manual_examples(name);
    EXPECT_FALSE(examples.empty()) << name;
    for (const ManualExample& example : examples) {
      EXPECT_NE(example.call.find(name), std::string::npos) << example.call;
      // The examples of the program and of a group call one of their commands.
      if (command.words.empty() || command.words == std::vector<std::string>{"fit"}) continue;
      const std::set<std::string> known(command.options.begin(), command.options.end());
      for (std::sregex_iterator match(example.call.begin(), example.call.end(), kOption), end;
           match != end; ++match) {
        EXPECT_TRUE(known.contains(match->str())) << example.call;
      }
    }
  }
}

}  // namespace man_pages_test
}  // namespace jnd::app
