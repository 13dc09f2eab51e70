#include "app/session/pseudonym.h"

#include <algorithm>
#include <cstdio>

namespace jnd::app {
namespace {

constexpr std::size_t kMostLetters = 64;

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

/// The letters in lower case, and the numbers without leading zeros. A separator between two
/// numbers is kept, so that they do not merge.
std::string bare(const std::string& participant) {
  std::string bare;
  bool in_number = false;
  bool between = false;
  for (std::size_t i = 0; i < participant.size(); ++i) {
    const char c = participant[i];
    if (!is_digit(c) && !is_letter(c)) {
      between = true;
      in_number = false;
      continue;
    }
    if (is_digit(c)) {
      const bool leads =
          !in_number && c == '0' && i + 1 < participant.size() && is_digit(participant[i + 1]);
      if (leads) continue;
      if (between && !bare.empty() && is_digit(bare.back())) bare += '-';
    }
    in_number = is_digit(c);
    between = false;
    bare += lower(c);
  }
  return bare;
}

}  // namespace

std::string pseudonym_words() {
  return "at most " + std::to_string(kMostLetters) + " letters, digits, _, - and .";
}

bool is_pseudonym(const std::string& text) {
  return !text.empty() && text.size() <= kMostLetters &&
         std::all_of(text.begin(), text.end(), [](char c) {
           return is_letter(c) || is_digit(c) || c == '_' || c == '-' || c == '.';
         });
}

std::string lookalike(const std::string& participant, const std::vector<std::string>& taken) {
  const std::string own = bare(participant);
  for (const std::string& other : taken) {
    if (other != participant && bare(other) == own) return other;
  }
  return "";
}

std::vector<std::string> next_participants(const core::StudyStore& store, int count) {
  std::set<std::string> taken;
  for (const core::SessionRow& row : store.sessions()) taken.insert(row.participant);
  for (const core::WithdrawalRow& gone : store.withdrawals()) taken.insert(gone.participant);
  return next_participants(taken, count);
}

std::vector<std::string> next_participants(const std::set<std::string>& taken, int count) {
  std::vector<std::string> names;
  for (int number = 1; static_cast<int>(names.size()) < count; ++number) {
    char name[16];
    std::snprintf(name, sizeof name, "P%02d", number);
    if (!taken.contains(name)) names.emplace_back(name);
  }
  return names;
}

}  // namespace jnd::app
