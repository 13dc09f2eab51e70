#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace jnd::app {

inline std::string joined(const std::vector<std::string>& words) {
  std::string text = "jnd";
  for (const std::string& word : words) text += " " + word;
  return text;
}

/// Returns "" if the text is one sentence for a person, and else what is wrong with it. The
/// text must be one line after "jnd: ", contain no words of SQL or of a library, and contain
/// each of `parts`.
inline std::string sentence_flaw(const std::string& text,
                                 const std::vector<std::string>& parts = {}) {
  if (!text.starts_with("jnd: ")) return "does not begin with `jnd: `:\n" + text;
  if (std::count(text.begin(), text.end(), '\n') != 1 || !text.ends_with("\n")) {
    return "is not one line:\n" + text;
  }
  for (const char* word :
       {"SELECT", "INSERT", "PRAGMA", "BEGIN", "COMMIT", "UPDATE", "bind", "SQL ",
        "std::", "terminate", "what()", "parse_error", "json.exception", "CLI",
        "filesystem error", "INT:", "basic_string"}) {
    if (text.find(word) != std::string::npos) {
      return "has the word `" + std::string(word) + "`:\n" + text;
    }
  }
  for (const std::string& part : parts) {
    if (text.find(part) == std::string::npos) return "lacks `" + part + "`:\n" + text;
  }
  return "";
}

}  // namespace jnd::app
