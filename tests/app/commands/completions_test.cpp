#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "app/commands/command_fixture.h"
#include "app/commands/listed_commands.h"
#include "app/sentence.h"

namespace jnd::app {
namespace completions_test {

class CompletionsTest : public CommandTest {
 protected:
  void SetUp() override {
    for (const char* shell : {"bash", "zsh", "fish"}) {
      const auto outcome = jnd({"completions", shell});
      ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
      std::ofstream(path(shell)) << outcome.out;
    }
  }

  [[nodiscard]] test_support::ProgramOutcome run(const std::string& program,
                                                 const std::vector<std::string>& words) const {
    return test_support::run_program(
        words, {.folder = temporary_.path(), .environment = {}, .program = program});
  }

  /// Returns what bash offers for the last of these words, one offer in each line.
  [[nodiscard]] std::string offered(const std::vector<std::string>& words) const {
    std::string line = "jnd";
    for (const std::string& word : words) line += " '" + word + "'";
    const auto outcome = run("bash", {"-c", ". ./bash; COMP_WORDS=(" + line + "); COMP_CWORD=" +
                                                std::to_string(words.size()) +
                                                "; _jnd; printf '%s\\n' \"${COMPREPLY[@]}\""});
    EXPECT_EQ(outcome.exit_code, 0) << joined(words);
    EXPECT_EQ(outcome.err, "") << joined(words);
    return outcome.out;
  }

  [[nodiscard]] bool has(const std::string& program) const {
    return run("sh", {"-c", "command -v " + program}).exit_code == 0;
  }

  [[nodiscard]] std::string script(const std::string& shell) const {
    std::ifstream file(path(shell));
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
  }
};

TEST_F(CompletionsTest, BashCompletesCommandsOptionsAndValues) {
  EXPECT_EQ(offered({"fit", "psy"}), "psychometric\n");
  EXPECT_EQ(offered({"fit", "psychometric", "--fam"}), "--family\n");
  EXPECT_EQ(offered({"fit", "psychometric", "--family", "log"}), "logistic\n");
  EXPECT_EQ(offered({"fit", "psychometric", "--family", "=", "rev"}), "reversed_gumbel\n");
  EXPECT_EQ(offered({"fit", "psychometric", "--axis", "="}), "linear\nlog\n");
  EXPECT_EQ(offered({"simu"}), "simulate\n");
  EXPECT_EQ(offered({"run", "short_"}), "short_tour\n");
  EXPECT_EQ(offered({"run", "short_tour", "--device", "exo"}), "exoskeleton\n");
  EXPECT_EQ(offered({"run", "--laboratory", "misspec"}), "misspecified\n");
  EXPECT_EQ(offered({"export", "hd"}), "hdf5\n");
  EXPECT_EQ(offered({"completions", "fi"}), "fish\n");
  EXPECT_EQ(offered({"run", "short_tour", "--seed", ""}), "\n") << "nobody knows which number";
}

TEST_F(CompletionsTest, BashOffersFilesAndFoldersWithBlanksInTheirNames) {
  std::ofstream(path("my answers.csv")) << "a,b\n";
  std::filesystem::create_directory(path("my study.study"));
  EXPECT_EQ(offered({"fit", "weber", "--csv", "my a"}), "my answers.csv\n");
  EXPECT_EQ(offered({"results", "my"}), "my study.study\n");
}

// An argument may have the name of a command.
TEST_F(CompletionsTest, OnlyWhatIsACommandThereIsOne) {
  EXPECT_EQ(offered({"run", "fit", "--headl"}), "--headless\n");
  EXPECT_EQ(offered({"validate", "demo", "--js"}), "--json\n");
}

TEST_F(CompletionsTest, EveryCommandAndOptionIsInEveryScript) {
  for (const ListedCommand& command : listed_commands()) {
    std::string all;
    for (const std::string& one : command.options) all += one + "\n";
    std::vector<std::string> words = command.words;
    words.emplace_back("-");
    const std::string told = offered(words);
    for (const std::string& option : command.options) {
      EXPECT_NE(("\n" + told).find("\n" + option + "\n"), std::string::npos)
          << joined(words) << option;
    }
    std::string name;
    for (const std::string& word : command.words) name += (name.empty() ? "" : " ") + word;
    for (const std::string& option : command.options) {
      const std::string zsh = script("zsh");
      const std::size_t branch = zsh.find("    ('" + name + "')\n");
      ASSERT_NE(branch, std::string::npos) << name;
      const std::string until_next = zsh.substr(branch, zsh.find(";;", branch) - branch);
      EXPECT_NE(until_next.find(option), std::string::npos) << name << option;
      const bool is_long = option.starts_with("--");
      const std::string fish_name =
          is_long ? " -l " + option.substr(2) : " -s " + option.substr(1);
      const std::string fish = script("fish");
      bool found = false;
      std::istringstream lines(fish);
      for (std::string line; std::getline(lines, line);) {
        found = found || (line.find("'__jnd_in " + name + "'") != std::string::npos &&
                          (line + " ").find(fish_name + " ") != std::string::npos);
      }
      EXPECT_TRUE(found) << name << option;
    }
  }
}

TEST_F(CompletionsTest, FishCompletesThem) {
  if (!has("fish")) GTEST_SKIP() << "fish is not installed";
  const auto offers = [&](const std::string& line) {
    return run("fish", {"--no-config", "-c", "source ./fish; complete -C '" + line + "'"}).out;
  };
  EXPECT_TRUE(offers("jnd fit psy").starts_with("psychometric\t"));
  EXPECT_TRUE(offers("jnd fit psychometric --fam").starts_with("--family\t"));
  EXPECT_TRUE(offers("jnd fit psychometric --family logi").starts_with("logistic"));
  EXPECT_TRUE(offers("jnd simu").starts_with("simulate\t"));
}

TEST_F(CompletionsTest, ZshReadsItsScript) {
  if (!has("zsh")) GTEST_SKIP() << "zsh is not installed";
  const auto outcome = run("zsh", {"-f", "-n", "./zsh"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
}

TEST_F(CompletionsTest, AnotherShellIsWrongUsage) {
  EXPECT_EQ(jnd({"completions", "tcsh"}).exit_code, 2);
  EXPECT_EQ(jnd({"completions"}).exit_code, 2);
}

}  // namespace completions_test
}  // namespace jnd::app
