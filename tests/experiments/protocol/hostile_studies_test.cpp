#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "support/sanitizer.h"
#include "support/temporary_folder.h"
#include "tests/experiments/protocol/broken_study.h"

// Tests files that nobody wrote by hand: too large for the corpus, too large for the memory, or
// without an end. Each must give a sentence, after reading no more than a study may have.

namespace jnd::experiments {
namespace hostile_studies_test {

constexpr const char* kTooLarge =
    "x.json: expected at most 4 MiB of text, found more; is this a study file?";

std::string repeated(const std::string& piece, std::size_t num_bytes) {
  std::string text;
  text.reserve(num_bytes + piece.size());
  while (text.size() < num_bytes) text += piece;
  return text;
}

TEST(HostileStudies, AHundredMegabytesOfNumbersAreTooMany) {
  EXPECT_EQ(problems_of("{\"stages\": [0" + repeated(",0", 100'000'000) + "]}"), kTooLarge);
}

TEST(HostileStudies, AMillionKeysAreTooMany) {
  std::string text = "{\"format\": 1";
  for (int i = 0; i < 1'000'000; ++i) text += ",\"k" + std::to_string(i) + "\":0";
  EXPECT_EQ(problems_of(text + "}"), kTooLarge);
}

TEST(HostileStudies, AsManyKeysAsFitAreToldInAThousandProblems) {
  std::string text = "{\"format\": 1";
  constexpr std::size_t kMost = test_support::kIsSanitized ? 1U << 18 : 4U << 20;
  for (int i = 0; text.size() < kMost - 40; ++i) {
    text += ",\"k" + std::to_string(i) + "\":0";
  }
  EXPECT_EQ(study_text_problems(text + "}", "x.json").size(), 1001U);
}

TEST(HostileStudies, AsManyValuesAsFitAreOneProblem) {
  const std::string text = broken("[0, 1, 2]", "[0" + repeated(",0", 4'000'000) + "]");
  EXPECT_EQ(problems_of(text),
            "x.json:14:34: /stages/1/scale: expected a list of at most 200, found a list of "
            "2000001");
}

TEST(HostileStudies, AHundredThousandLevelsAreOneProblem) {
  for (const std::string open : {"[", "{\"a\":"}) {
    const std::string problems = problems_of(repeated(open, 100'000 * open.size()));
    EXPECT_NE(problems.find("expected at most 32 levels of brackets and braces, found more"),
              problems.npos)
        << problems;
  }
}

TEST(HostileStudies, AKeyThatStandsAThousandTimesIsToldEachTime) {
  std::string text = "{\"format\": 1";
  for (int i = 0; i < 900; ++i) text += ",\n\"format\": 1";
  const auto problems = study_text_problems(text + "}", "x.json");
  EXPECT_EQ(std::count_if(problems.begin(), problems.end(),
                          [](const StudyProblem& problem) {
                            return problem.message ==
                                   "expected each key once, found this one a second time";
                          }),
            900);
}

TEST(HostileStudies, AWordOfAMegabyteHasAShortMessage) {
  const std::string text = broken("\"sound\"", '"' + std::string(1'000'000, 'a') + '"');
  EXPECT_LT(problems_of(text).size(), 300U);
}

TEST(HostileStudies, AFileOfAHundredMegabytesIsNotReadToItsEnd) {
  const test_support::TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "large.json";
  std::ofstream(file) << kSoundStudy;
  std::filesystem::resize_file(file, 100'000'000);
  const auto problems = study_problems(file);
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(problems[0].message,
            "expected at most 4 MiB of text, found more; is this a study file?");
}

TEST(HostileStudies, AFileWithoutAnEndIsNotWaitedFor) {
  if (!std::filesystem::exists("/dev/zero")) GTEST_SKIP() << "no such device";
  const auto problems = study_problems("/dev/zero");
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(problems[0].message,
            "expected at most 4 MiB of text, found more; is this a study file?");
}

}  // namespace hostile_studies_test
}  // namespace jnd::experiments
