#include <gtest/gtest.h>

#include <regex>
#include <set>
#include <sstream>

#include "app/commands/command_fixture.h"
#include "app/tiny_study.h"
#include "support/program.h"

// A report in German has no English sentence, beside the names that a study's file gives and
// the works that it cites.
namespace jnd::app {
namespace german_report_test {

class GermanReportTest : public CommandTest {
 protected:
  void run(const std::vector<std::string>& arguments) {
    const test_support::ProgramOutcome outcome = test_support::run_program(
        arguments, {.folder = temporary_.path(), .environment = {{"PATH", "/nowhere"}}});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  }
};

/// The study in which every sentence is said to be German.
std::string german_study() {
  return std::regex_replace(kTinyStudy, std::regex(R"("en")"), R"("de")");
}

/// The lines of a page's text, without its style.
std::vector<std::string> lines_of(const std::string& html) {
  std::string text = html.substr(html.find("</style>"));
  text = std::regex_replace(text,
                            std::regex("</?(wbr|b|i|em|sub|sup|span|strong|a)( [^<>]*)?>"), "");
  text = std::regex_replace(text, std::regex("<[^<>]*>"), "\n");
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

TEST_F(GermanReportTest, HasNoEnglishSentence) {
  write_file(path("tiny.json"), german_study());
  run({"simulate", "tiny.json", "--participants", "3", "--study", "t.study"});
  run({"report", "t.study", "--out", "out", "--language", "de", "--resamples", "100"});
  const std::regex english(
      R"(\b(the|of|with|between|people|person|trials|each|is|are|for|from|by|every|only|than|)"
      R"(free|own|paired|expected|found|answers|planned|has|have|one)\b)");
  // A work in the list of works, such as "Holm, S. (1979). A ...", and the name of a medium.
  const std::regex cited(R"(\([12][0-9]{3}\)\. .*\.$|^free space$)");
  std::set<std::string> found;
  for (const char* page : {"out/report.html", "out/supplement.html"}) {
    const std::string html = read_file(path(page));
    EXPECT_NE(html.find("Versuchsperson"), std::string::npos) << page;
    for (const std::string& line : lines_of(html)) {
      if (!std::regex_search(line, english) || std::regex_search(line, cited)) continue;
      found.insert(line);
    }
  }
  for (const std::string& line : found) ADD_FAILURE() << line;
}

}  // namespace german_report_test
}  // namespace jnd::app
