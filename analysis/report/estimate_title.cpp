#include "analysis/report/estimate_title.h"

#include <algorithm>
#include <string_view>
#include <utility>
#include <vector>

namespace jnd::analysis {
namespace {

/// The ending that a unit has in names, such as "m_per_s" for "m/s".
std::string ending_of(const std::string& unit) {
  std::string ending;
  for (const char letter : unit) {
    if (letter == '/') {
      ending += "_per_";
    } else {
      ending += letter == ' ' ? '_' : letter;
    }
  }
  for (char& letter : ending) {
    if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
  }
  return ending;
}

/// Parts of names that are not words, or that need a comma before them. The longer ones come
/// first.
constexpr std::pair<std::string_view, std::string_view> kPhrases[] = {
    {"median person", ", median person"},
    {"mean person", ", mean person"},
    {"individual weber fraction", "individual Weber fractions"},
    {"weber", "Weber"},
    {"pse free", ", PSE free"},
    {"free pse", ", PSE free"},
    {"pse", "PSE"},
    {"jnd", "JND"},
    {"log mean", ", mean of logarithms"},
    {"log sd", ", standard deviation of logarithms"},
    {"type 2 auroc", "area under the type 2 curve"},
};

std::string in_phrases(std::string words) {
  for (const auto& [from, to] : kPhrases) {
    const std::size_t at = words.find(from);
    if (at == std::string::npos) continue;
    const std::size_t end = at + from.size();
    const bool is_whole =
        (at == 0 || words[at - 1] == ' ') && (end == words.size() || words[end] == ' ');
    if (!is_whole) continue;
    const bool has_comma = to.starts_with(", ");
    // There is no comma at the beginning.
    const std::size_t begin = has_comma && at > 0 ? at - 1 : at;
    words.replace(begin, end - begin, has_comma && at == 0 ? to.substr(2) : to);
  }
  return words;
}

}  // namespace

std::string estimate_title(const StudyTitles& titles, const std::string& name,
                           const std::string& unit) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin <= name.size();) {
    const std::size_t end = std::min(name.find('.', begin), name.size());
    parts.push_back(name.substr(begin, end - begin));
    begin = end + 1;
  }
  const std::string ending = unit.empty() || unit == "1" ? "" : "_" + ending_of(unit);
  std::string stage, words;
  for (std::string& part : parts) {
    if (titles.stages.contains(part)) {
      stage += (stage.empty() ? "" : ", ") + titles.short_title_of(part);
      continue;
    }
    if (!ending.empty() && part.ends_with(ending) && part.size() > ending.size()) {
      part.resize(part.size() - ending.size());
    }
    words += (words.empty() ? "" : ", ") + said_of(in_phrases(in_words(part)));
  }
  if (stage.empty()) {
    if (!words.empty() && words[0] >= 'a' && words[0] <= 'z') {
      words[0] = static_cast<char>(words[0] - 'a' + 'A');
    }
    return words;
  }
  return words.empty() ? stage : stage + ": " + words;
}

}  // namespace jnd::analysis
