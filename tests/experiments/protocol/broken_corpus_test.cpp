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

// tests/experiments/protocol/broken holds, for each rule, a broken study NAME.json and in
// NAME.txt what the reader must say of it, in folders by what is broken. Its README says how to
// make a new pair.

namespace jnd::experiments {
namespace broken_corpus_test {

namespace fs = std::filesystem;
using test_support::read_file;

fs::path source(const std::string& name) { return test_support::source_folder() / name; }

/// The files with this extension in a folder and the folders in it, in order.
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
  // Some values occur only in device profiles, not in studies.
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

/// The string literals of a C++ source. Literals that stand side by side count as one.
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

// The reader's fixed words are read from its sources: every literal that begins a message has
// to stand in the corpus at least once. So a rule without an example is found, whoever adds it.
TEST(BrokenCorpus, HoldsEveryMessageThatTheReaderCanGive) {
  const std::string all = all_expected_messages();
  // These messages are not about a text of the corpus's kind. The comments name their tests.
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
      // The reader searches for these words in the parser's messages and does not say them
      // itself.
      if (words == "expected ") continue;
      ++num_messages;
      EXPECT_NE(all.find(words), std::string::npos)
          << name << ".cpp can say `" << words << "`, and no study in " << kFolder
          << " shows it";
    }
  }
  EXPECT_GT(num_messages, 40);
}

/// The kinds of value that a pointer's last key has, in any table.
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
