#include <gtest/gtest.h>

#include <filesystem>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "experiments/protocol/study_reader.h"
#include "experiments/protocol/study_table.h"
#include "experiments/study/parameter_table.h"
#include "support/files.h"
#include "support/places.h"

// The folder tests/experiments/protocol/broken holds a broken study NAME.json for each rule, in
// folders by what is broken. NAME.txt holds what the reader must say about it. The README of
// the folder says how to add a pair.

namespace jnd::experiments {
namespace broken_corpus_test {

namespace fs = std::filesystem;
using test_support::read_file;

fs::path source(const std::string& name) { return test_support::source_folder() / name; }

/// Returns the files in a folder and in its subfolders with this extension, in order.
std::vector<fs::path> files_in(const fs::path& folder, const std::string& extension) {
  std::set<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.path().extension() == extension) files.insert(entry.path());
  }
  return {files.begin(), files.end()};
}

const fs::path kFolder = "tests/experiments/protocol/broken";
const fs::path kProfiles = "tests/experiments/device_profile/broken";

std::string all_expected_messages() {
  std::string all;
  for (const fs::path& file : files_in(source(kFolder), ".txt")) all += read_file(file);
  // Profiles of devices have kinds of values that studies do not have.
  for (const fs::path& file : files_in(source(kProfiles), ".txt")) all += read_file(file);
  return all;
}

TEST(BrokenCorpus, EveryStudyGivesExactlyTheMessagesBesideIt) {
  int num_files = 0;
  for (const fs::path& file : files_in(source(kFolder), ".json")) {
    std::string lines;
    for (const StudyProblem& problem :
         study_text_problems(read_file(file), file.filename().string())) {
      lines += to_string(problem) + '\n';
    }
    fs::path expected = file;
    expected.replace_extension(".txt");
    EXPECT_NE(lines, "") << file << " is not broken";
    EXPECT_EQ(lines, read_file(expected)) << file;
    ++num_files;
  }
  EXPECT_GT(num_files, 50);
}

TEST(BrokenCorpus, HasAStudyForEveryMessages) {
  for (const fs::path& file : files_in(source(kFolder), ".txt")) {
    fs::path study = file;
    study.replace_extension(".json");
    EXPECT_TRUE(fs::exists(study)) << file;
  }
}

TEST(BrokenCorpus, NamesAStudyOnceWhateverItsFolder) {
  std::map<std::string, fs::path> seen;
  for (const fs::path& file : files_in(source(kFolder), ".json")) {
    const auto [first, is_new] = seen.emplace(file.filename().string(), file);
    EXPECT_TRUE(is_new) << file << " and " << first->second;
  }
}

/// Returns the literals of a C++ source. Adjacent literals count as one.
std::vector<std::string> literals_of(const std::string& code) {
  static const std::regex kLiteral(R"re("((?:[^"\\\n]|\\.)*)")re");
  std::vector<std::string> literals;
  std::size_t end_of_last = 0;
  for (std::sregex_iterator it(code.begin(), code.end(), kLiteral), none; it != none; ++it) {
    const auto begin = static_cast<std::size_t>(it->position());
    const std::string between = code.substr(end_of_last, begin - end_of_last);
    const bool goes_on =
        !literals.empty() && between.find_first_not_of(" \t\n") == std::string::npos;
    std::string words =
        std::regex_replace((*it)[1].str(), std::regex(R"re(\\(["\\]))re"), "$1");
    if (goes_on) {
      literals.back() += words;
    } else {
      literals.push_back(std::move(words));
    }
    end_of_last = begin + static_cast<std::size_t>(it->length());
  }
  return literals;
}

// Reads the reader's fixed words from its sources. Every literal that begins a message must
// occur in the corpus at least once, so this test finds each rule without an example.
TEST(BrokenCorpus, HoldsEveryMessageThatTheReaderCanGive) {
  const std::string all = all_expected_messages();
  // These messages are not about a text of the corpus's kind. The comments name the tests that
  // show them.
  const std::set<std::string> elsewhere = {
      "expected a study file that can be read, found ",  // The tests StudyReader show this one.
      // The tests HostileStudies show this one.
      "expected at most 4 MiB of text, found more; is this a study file?",
      "expected no more than ",  // The tests StudyReader show this one.
  };
  int num_messages = 0;
  for (const char* name :
       {"structure_check", "study_rules", "session_rules", "label_rules", "task_rules",
        "timing_rules", "order_rules", "participant_field_rules", "session_limit_rules",
        "standard_rules", "interleaved_rules", "sound_rules", "design_rules",
        "sequential_rules", "located_json", "study_reader"}) {
    const std::string code =
        read_file(source("experiments/protocol/" + std::string(name) + ".cpp"));
    ASSERT_NE(code, "") << name;
    for (const std::string& words : literals_of(code)) {
      if (!words.starts_with("expected ") || elsewhere.contains(words)) continue;
      // With these words, the reader looks for the parser's own words, and does not say them.
      if (words == "expected ") continue;
      ++num_messages;
      EXPECT_NE(all.find(words), std::string::npos)
          << name << ".cpp can say `" << words << "`, and no study in " << kFolder
          << " shows it";
    }
  }
  EXPECT_GT(num_messages, 40);
}

/// Returns the kinds of value that the last key of a pointer has in any table.
std::set<ValueKind> kinds_of(const std::string& pointer) {
  std::set<ValueKind> kinds;
  std::string key = pointer;
  while (!key.empty()) {
    const std::string token = key.substr(key.rfind('/') + 1);
    key.resize(key.rfind('/'));
    if (token.find_first_not_of("0123456789") == std::string::npos) continue;
    for (const ParameterTable* table : all_tables()) {
      if (const Parameter* parameter = table->find(token)) kinds.insert(parameter->kind);
    }
    if (!kinds.empty()) break;
  }
  return kinds;
}

TEST(BrokenCorpus, BreaksAValueOfEveryKind) {
  std::set<ValueKind> broken;
  for (const fs::path& file : files_in(source(kFolder), ".json")) {
    for (const StudyProblem& problem : study_text_problems(read_file(file), "x")) {
      broken.merge(kinds_of(problem.pointer));
    }
  }
  for (const ParameterTable* table : all_tables()) {
    for (const Parameter& parameter : table->parameters) {
      EXPECT_TRUE(broken.contains(parameter.kind))
          << table->name << ": " << parameter.key << ", a value of kind "
          << static_cast<int>(parameter.kind);
    }
  }
}

}  // namespace broken_corpus_test
}  // namespace jnd::experiments
