#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "app/commands/command_fixture.h"
#include "app/json_document.h"
#include "app/sentence.h"
#include "app/tiny_study.h"
#include "support/program.h"

namespace jnd::app {
namespace bad_study_test {

namespace fs = std::filesystem;
using test_support::ProgramOutcome;

class BadStudyTest : public CommandTest {
 protected:
  /// Expects that every command that reads `study.json` refuses it, and that `validate` names
  /// `pointer` and `parts`.
  void expect_refused(const std::string& pointer, const std::vector<std::string>& parts) {
    const ProgramOutcome json = jnd({"validate", "study.json", "--json"});
    EXPECT_EQ(json.exit_code, 1);
    // `document` is not used here, because a study may contain the word NaN.
    const auto problems = nlohmann::json::parse(json.out)["problems"];
    const bool named = std::any_of(problems.begin(), problems.end(), [&](const auto& problem) {
      const std::string message = problem["message"];
      return problem["pointer"] == pointer &&
             std::all_of(parts.begin(), parts.end(), [&](const std::string& part) {
               return message.find(part) != std::string::npos;
             });
    });
    EXPECT_TRUE(named) << pointer << " in " << problems.dump(2);
    const std::size_t num_problems = problems.size();
    for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
             {"plan", "study.json"},
             {"new", "copy", "--from", "study.json"},
             {"simulate", "study.json", "--participants", "1", "--study", "s.study"},
             {"run", "study.json", "--study", "s.study", "--participant", "P01",
              "--headless"}}) {
      const ProgramOutcome outcome = jnd(words);
      EXPECT_EQ(outcome.exit_code, 1) << joined(words);
      EXPECT_EQ(outcome.out, "") << joined(words);
      EXPECT_TRUE(outcome.err.starts_with("jnd: study.json")) << outcome.err;
      // The command prints one line for each problem, and nothing else.
      EXPECT_EQ(
          static_cast<std::size_t>(std::count(outcome.err.begin(), outcome.err.end(), '\n')),
          num_problems)
          << outcome.err;
      EXPECT_FALSE(fs::exists(path("s.study"))) << "a folder was made for nothing";
      EXPECT_FALSE(fs::exists(path("copy.json")));
    }
  }
};

struct Change {
  std::string from, to;
  std::string pointer;
  std::vector<std::string> parts;
};

TEST_F(BadStudyTest, EveryMistakeIsToldAtItsPlaceByEveryReader) {
  const std::string values = "[4, 16]";
  const std::string first = "/stages/6/viscosity_pa_s/0";
  for (const Change& change : std::vector<Change>{
           {"\"stages\": [", "\"stages\": [,", "/stages/0", {"expected a value", "`,`"}},
           {"\"format\": 1,", "\"format\" 1,", "/format", {"expected"}},
           {"\"repetitions\": 2",
            "\"repetitions\": \"2\"",
            "/stages/3/repetitions",
            {"expected a whole number", "the text \"2\""}},
           {"\"repetitions\": 2", "\"repetitions\": 1.5", "/stages/3/repetitions", {"1.5"}},
           {"\"repetitions\": 2", "\"repetitions\": 0", "/stages/3/repetitions", {"found 0"}},
           {"\"repetitions\": 2", "\"repetitions\": 1e9", "/stages/3/repetitions", {"1000"}},
           {"\"viscosity_pa_s\"",
            "\"viscosity_mpa_s\"",
            "/stages/6/viscosity_mpa_s",
            {"unknown key", "did you mean `viscosity_pa_s`?"}},
           {values, "[NaN, 16]", first, {"`NaN`"}},
           {values, "[Infinity, 16]", first, {"`Infinity`"}},
           {values, "[-Infinity, 16]", first, {"expected"}},
           {values, "[1e999, 16]", first, {"1e999"}},
           {values, "[-4, 16]", first, {"expected a number > 0", "found -4"}},
           {values, "[0, 16]", first, {"expected a number > 0", "found 0"}},
           {values, "[null, 16]", first, {"expected a number"}},
           {values, "[]", "/stages/6/viscosity_pa_s", {"one or more", "an empty list"}},
           {values, "4", "/stages/6/viscosity_pa_s", {"expected a list"}},
           {values, "[4, 4]", "/stages/6/viscosity_pa_s/1", {"each value once"}},
           {"\"name\": \"production\"",
            "\"name\": \"estimation\"",
            "/stages/4/name",
            {"a name of its own", "`estimation`"}},
           {"\"name\": \"tiny\"", "\"name\": \"ti\\u0000ny\"", "/name", {"expected a name"}},
           {"\"name\": \"tiny\"", "\"name\": \"../tiny\"", "/name", {"expected a name"}},
           {"\"format\": 1,", "\"format\": 1, \"format\": 1,", "/format", {"once"}},
           {"\"format\": 1", "\"format\": 99", "/format", {"expected 1, found 99"}},
           {"\"rate_hz\": 1000", "\"rate_hz\": 0", "/device/rate_hz", {"found 0"}},
           {"\"procedure\": \"constant_stimuli\"",
            "\"procedure\": \"constant_stimulus\"",
            "/stages/6/procedure",
            {"did you mean `constant_stimuli`?"}},
       }) {
    SCOPED_TRACE(change.to);
    write_file(path("study.json"), replaced(kTinyStudy, change.from, change.to));
    expect_refused(change.pointer, change.parts);
  }
}

TEST_F(BadStudyTest, WhatIsNoStudyAtAllIsToldAsSuch) {
  const std::string half = kTinyStudy.substr(0, kTinyStudy.size() / 2);
  std::string all_bytes;
  for (int byte = 0; byte < 256; ++byte) all_bytes += static_cast<char>(byte);
  for (const std::string& text : {std::string(), std::string("[]"), std::string("7"), half,
                                  all_bytes, std::string(200000, '['), kTinyStudy + "x",
                                  kTinyStudy + kTinyStudy, std::string("{}")}) {
    SCOPED_TRACE(text.substr(0, 40));
    write_file(path("study.json"), text);
    const ProgramOutcome json = jnd({"validate", "study.json", "--json"});
    EXPECT_EQ(json.exit_code, 1);
    EXPECT_FALSE(document(json.out)["problems"].empty());
    EXPECT_EQ(jnd({"plan", "study.json"}).exit_code, 1);
  }
}

TEST_F(BadStudyTest, FilesThatCannotBeReadAreToldInOneSentence) {
  fs::create_directory(path("folder.json"));
  const std::vector<std::vector<std::string>> names = {{"missing.json", "no such file"},
                                                       {"folder.json", "a folder"}};
  for (const auto& name : names) {
    for (std::vector<std::string> words : std::vector<std::vector<std::string>>{
             {"plan", name[0]},
             {"run", name[0], "--study", "s.study", "--participant", "P01", "--headless"},
             {"simulate", name[0], "--participants", "1", "--study", "s.study"}}) {
      const ProgramOutcome outcome = jnd(words);
      EXPECT_EQ(outcome.exit_code, 1) << joined(words);
      EXPECT_EQ(sentence_flaw(outcome.err, {name[0], "expected a study file", name[1]}), "");
    }
  }
  const ProgramOutcome laboratory =
      jnd({"run", "short_tour", "--study", "s.study", "--participant", "P01", "--headless",
           "--laboratory", "folder.json"});
  EXPECT_EQ(laboratory.exit_code, 1);
  EXPECT_EQ(sentence_flaw(laboratory.err, {"folder.json", "expected"}), "");
  EXPECT_FALSE(fs::exists(path("s.study")));
}

TEST_F(BadStudyTest, AFileOfSomebodyElseIsToldInOneSentence) {
  if (::geteuid() != 0) GTEST_SKIP() << "needs root, to become somebody else";
  write_file(path("mine.json"), kTinyStudy);
  fs::permissions(path("mine.json"), fs::perms::none);
  fs::permissions(temporary_.path(), fs::perms::all);
  test_support::ProgramOptions other = options_;
  other.wrapper = {"setpriv", "--reuid=65534", "--regid=65534", "--clear-groups"};
  try {
    if (test_support::run_program({"--version"}, other).exit_code != 0) {
      GTEST_SKIP() << "nobody else may run this program";
    }
  } catch (const std::runtime_error&) {
    GTEST_SKIP() << "setpriv is not installed";
  }
  const ProgramOutcome outcome = test_support::run_program({"plan", "mine.json"}, other);
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(sentence_flaw(outcome.err, {"mine.json", "Permission denied"}), "");
}

TEST_F(BadStudyTest, PathsThatTheSystemRefusesAreToldInOneSentence) {
  const std::string longest(5000, 'x');
  for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
           {"plan", longest},
           {"run", longest, "--study", "s.study", "--participant", "P01", "--headless"},
           {"run", "short_tour", "--study", longest, "--participant", "P01", "--headless"},
           {"simulate", "short_tour", "--study", longest, "--participants", "1"},
           {"plan", "short_tour", "--study", longest}}) {
    const ProgramOutcome outcome = jnd(words);
    EXPECT_EQ(outcome.exit_code, 1) << joined(words).substr(0, 40) << outcome.err;
    EXPECT_EQ(sentence_flaw(outcome.err, {"expected"}), "");
  }
}

TEST_F(BadStudyTest, ResumeGoesOnWithTheStudyAsItWasAndSaysThatTheFileChanged) {
  write_file(path("study.json"), kTinyStudy);
  {
    test_support::RunningProgram child({"run", "study.json", "--study", "a.study",
                                        "--participant", "P01", "--headless", "--acknowledge"},
                                       options_);
    for (int line = 0; line < 20; ++line) ASSERT_TRUE(child.read_line());
    child.send_signal(9);
    ASSERT_EQ(child.wait().signal, 9);
  }
  write_file(path("study.json"), replaced(kTinyStudy, "[4, 16]", "[5, 15]"));
  const ProgramOutcome outcome = jnd({"resume", "a.study", "--headless"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(sentence_flaw(outcome.err, {"study.json", "changed", "begun with"}), "");
  EXPECT_EQ(jnd({"verify", "a.study"}).exit_code, 0);
}

TEST_F(BadStudyTest, ResumeSaysNothingOfAFileThatIsAsItWasOrGone) {
  for (const bool gone : {false, true}) {
    const std::string study = gone ? "gone.study" : "same.study";
    write_file(path("study.json"), kTinyStudy);
    test_support::RunningProgram child({"run", "study.json", "--study", study, "--participant",
                                        "P01", "--headless", "--acknowledge"},
                                       options_);
    for (int line = 0; line < 20; ++line) ASSERT_TRUE(child.read_line());
    child.send_signal(9);
    ASSERT_EQ(child.wait().signal, 9);
    if (gone) fs::remove(path("study.json"));
    const ProgramOutcome outcome = jnd({"resume", study, "--headless"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
  }
}

}  // namespace bad_study_test
}  // namespace jnd::app
