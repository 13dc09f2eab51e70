#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <regex>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "support/files.h"
#include "support/places.h"

// Tests that every language has every sentence of the window, with the same values to fill in.

namespace translations_test {

namespace fs = std::filesystem;

/// A sentence of a catalogue, in all of its forms.
struct Message {
  std::string english, plural;     ///< It is "" if the sentence has no plural.
  std::vector<std::string> words;  ///< The translation in each of its forms.
  bool is_fuzzy = false;           ///< Whether a program guessed the translation.
};

/// Returns the quoted text at the end of a line, without its quotes.
std::string quoted_in(const std::string& line) {
  const std::size_t from = line.find('"'), to = line.rfind('"');
  return from == to ? "" : line.substr(from + 1, to - from - 1);
}

/// Reads a catalogue in the format of gettext's manual, "The Format of PO Files". The
/// description of the catalogue is the message of "".
std::vector<Message> read_catalogue(const std::string& text) {
  std::vector<Message> all;
  std::string* target = nullptr;
  bool is_fuzzy = false;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("#~")) continue;
    if (line.starts_with("#,")) is_fuzzy |= line.find("fuzzy") != line.npos;
    if (line.starts_with("msgid ")) {
      all.push_back({.english = "", .plural = "", .words = {}, .is_fuzzy = is_fuzzy});
      is_fuzzy = false;
      target = &all.back().english;
    } else if (line.starts_with("msgid_plural ")) {
      target = &all.back().plural;
    } else if (line.starts_with("msgstr")) {
      target = &all.back().words.emplace_back();
    } else if (!line.starts_with('"')) {
      continue;
    }
    if (target != nullptr) *target += quoted_in(line);
  }
  return all;
}

/// Returns what fmt fills in, each with its number: "{} of {:.1f}" has 0 and 1.
std::multimap<std::size_t, std::string> holes_of(const std::string& sentence) {
  static const std::regex kHole(R"(\{(\d*)(:[^}]*)?\})");
  std::multimap<std::size_t, std::string> holes;
  std::size_t next = 0;
  for (std::sregex_iterator at(sentence.begin(), sentence.end(), kHole), end; at != end; ++at) {
    const std::string number = (*at)[1].str();
    holes.emplace(number.empty() ? next++ : std::stoul(number), (*at)[2].str());
  }
  return holes;
}

/// Returns the number of blanks at the beginning and at the end, where the sentence is joined
/// with others.
std::pair<std::size_t, std::size_t> blanks_around(const std::string& sentence) {
  const std::size_t first = sentence.find_first_not_of(' ');
  if (first == sentence.npos) return {sentence.size(), 0};
  return {first, sentence.size() - 1 - sentence.find_last_not_of(' ')};
}

/// Returns what is wrong with one form of a translation, or "" if nothing is.
std::string problem_of(const std::string& english, const std::string& words) {
  if (words.empty()) return "it is not translated";
  if (holes_of(english) != holes_of(words)) return "what is filled in is not the same";
  if (blanks_around(english) != blanks_around(words)) return "the blanks around it differ";
  if (std::ranges::count(english, '*') != std::ranges::count(words, '*')) {
    return "its stars are not as many";
  }
  return "";
}

/// Returns every problem of a catalogue, compared with the English one.
std::vector<std::string> problems_of(const std::vector<Message>& english,
                                     const std::vector<Message>& translated) {
  std::map<std::string, Message> known;
  std::size_t num_forms = 1;
  for (const Message& message : translated) {
    known[message.english] = message;
    num_forms = std::max(num_forms, message.words.size());
  }
  std::vector<std::string> problems;
  for (const Message& message : english) {
    if (message.english.empty()) continue;
    const auto found = known.find(message.english);
    if (found == known.end() || found->second.plural != message.plural) {
      problems.push_back(message.english + ": it is not in the file");
      continue;
    }
    const Message& its = found->second;
    if (its.is_fuzzy)
      problems.push_back(message.english + ": it is fuzzy, and nobody shows it");
    if (!message.plural.empty() && its.words.size() != num_forms) {
      problems.push_back(message.english + ": it lacks a plural form");
    }
    for (const std::string& words : its.words) {
      const std::string problem = problem_of(message.english, words);
      if (!problem.empty()) problems.push_back(message.english + ": " + problem + ": " + words);
    }
  }
  return problems;
}

TEST(Translations, EveryLanguageHasEverySentenceAndFillsInTheSame) {
  const fs::path folder = jnd::test_support::source_folder() / "data/languages";
  const std::vector<Message> english =
      read_catalogue(jnd::test_support::read_file(folder / "jnd.pot"));
  EXPECT_GT(english.size(), 1000U);
  std::vector<std::string> languages;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() != ".po") continue;
    languages.push_back(entry.path().stem().string());
    const std::vector<Message> translated =
        read_catalogue(jnd::test_support::read_file(entry.path()));
    for (const std::string& problem : problems_of(english, translated)) {
      ADD_FAILURE() << entry.path().filename().string() << ": " << problem
                    << "\n`./dev words` writes new sentences into it; translate them there";
    }
    ASSERT_FALSE(translated.empty());
    for (const char* field : {"Language: ", "X-Language-Name: ", "Plural-Forms: "}) {
      EXPECT_NE(translated.front().words.at(0).find(field), std::string::npos)
          << entry.path().filename().string() << " lacks the line \"" << field << "\"";
    }
  }
  EXPECT_NE(std::ranges::find(languages, "de"), languages.end());
}

TEST(Translations, EveryKindOfProblemIsSeen) {
  const std::vector<Message> english = read_catalogue(
      "msgid \"\"\nmsgstr \"\"\n\"Language: \\n\"\n\nmsgid \"{} of {:.1f}\"\nmsgstr \"\"\n\n"
      "msgid \" and \"\n\"more\"\nmsgstr \"\"\n\nmsgid \"{} trial\"\nmsgid_plural \"{} "
      "trials\"\n"
      "msgstr[0] \"\"\nmsgstr[1] \"\"\n");
  ASSERT_EQ(english.size(), 4U);
  EXPECT_EQ(english[2].english, " and more");
  const auto translated = [&](const std::string& text) {
    return problems_of(english, read_catalogue(text)).size();
  };
  const std::string of = "msgid \"{} of {:.1f}\"\nmsgstr \"{} von {:.1f}\"\n\n";
  const std::string more = "msgid \" and more\"\nmsgstr \" und mehr\"\n\n";
  const std::string trials =
      "msgid \"{} trial\"\nmsgid_plural \"{} trials\"\nmsgstr[0] \"{} Durchgang\"\n"
      "msgstr[1] \"{} Durchgänge\"\n";
  EXPECT_EQ(translated(of + more + trials), 0U);
  EXPECT_EQ(translated(""), 3U);
  EXPECT_EQ(translated("#, fuzzy\n" + of + more + trials), 1U);
  EXPECT_EQ(translated("msgid \" and more\"\nmsgstr \"\"\n\n" + of + trials), 1U);
  EXPECT_EQ(translated("msgid \" and more\"\nmsgstr \"und mehr\"\n\n" + of + trials), 1U);
  EXPECT_EQ(translated("msgid \" and more\"\nmsgstr \" *und* mehr\"\n\n" + of + trials), 1U);
  EXPECT_EQ(translated(of + more + "msgid \"{} trial\"\nmsgstr \"{} Durchgang\"\n"), 1U);
  const std::string beginning = "msgid \"{} of {:.1f}\"\nmsgstr \"";
  EXPECT_EQ(translated(beginning + "von {1:.1f} {0}\"\n\n" + more + trials), 0U);
  for (const char* wrong : {"{} von {}", "{:.1f} von {}", "{} von", "{} {} {:.1f}"}) {
    EXPECT_EQ(translated(beginning + wrong + "\"\n\n" + more + trials), 1U) << wrong;
  }
}

}  // namespace translations_test
