#include "analysis/report/estimate_title.h"

#include <algorithm>
#include <string_view>
#include <utility>
#include <vector>

#include "analysis/words/said.h"
#include "analysis/words/said_composed.h"

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

// What the parts of names come to by `in_phrases`. This list puts them into the catalogue.
[[maybe_unused]] constexpr const char* kTitlesOfNames[] = {
    said_later("pse, median person"),
    said_later("pse, median person, without degenerate"),
    said_later("PSE, median person, without degenerate"),
    said_later("Weber fraction, median person at reference"),
    said_later("Weber fraction, median person, PSE free"),
    said_later("Weber fraction, PSE free"),
    said_later("Weber fraction order effect ln"),
    said_later("order effect ln"),
    said_later("interval bias"),
    said_later("slope sd between people"),
    said_later("individual Weber fractions mean"),
    said_later("individual Weber fractions mean, PSE free"),
    said_later("individual Weber fractions mean at reference"),
    said_later("individual Weber fractions median"),
    said_later("individual Weber fractions median, PSE free"),
    said_later("individual Weber fractions median at reference"),
    said_later("individual Weber fractions sd"),
    said_later("individual Weber fractions lsq mean"),
    said_later("individual Weber fractions lsq sd"),
    said_later("individual Weber fractions sd, PSE free"),
    said_later("individual Weber fractions sd at reference"),
    said_later("individual Weber fractions robust sd"),
    said_later("individual Weber fractions robust sd, PSE free"),
    said_later("individual Weber fractions robust sd at reference"),
    said_later("individual Weber fractions beyond stimuli"),
    said_later("individual Weber fractions beyond stimuli, PSE free"),
    said_later("individual Weber fractions beyond stimuli at reference"),
    said_later("staircase threshold"),
    said_later("staircase threshold sd ln"),
    said_later("staircase target probability"),
    said_later("staircase Weber fraction"),
    said_later("quest plus Weber fraction"),
    said_later("quest plus pse"),
    said_later("without affected trials"),
    said_later("without degenerate"),
    said_later("with excluded trials"),
    said_later("num catch trials"),
    said_later("catch test chosen rate"),
    said_later("catch second chosen rate"),
    said_later("spread ln"),
    said_later("spread ln sd ln"),
    said_later("right ratio"),
    said_later("chosen first ratio"),
    said_later("chosen second ratio"),
    said_later("chosen third ratio"),
    said_later("stroke width"),
    said_later("max speed"),
    said_later("equal intervals"),
    said_later("PSE free"),
    said_later("question"),
    said_later("when wrong"),
    said_later("when right"),
    said_later("right minus wrong"),
    said_later("rank correlation"),
    said_later("rank correlation with difference"),
    said_later("area under the type 2 curve"),
    said_later("mean"),
    said_later("median"),
    said_later("sd"),
    said_later("mean at {}"),
    said_later("median at {}"),
    said_later("geometric mean at {}"),
    said_later("individual a mean"),
    said_later("drift per ten trials"),
    said_later("ratio to standard"),
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

/// The words of "group_d_minus_group_e", if both are stages: "Group D minus Group E".
std::string difference_title(const StudyTitles& titles, const std::string& part) {
  constexpr std::string_view kMinus = "_minus_";
  const std::size_t at = part.find(kMinus);
  if (at == std::string::npos) return "";
  const std::string first = part.substr(0, at), second = part.substr(at + kMinus.size());
  if (!titles.stages.contains(first) || !titles.stages.contains(second)) return "";
  return said("{} minus {}", titles.short_title_of(first), titles.short_title_of(second));
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
    if (const std::string difference = difference_title(titles, part); !difference.empty()) {
      words += (words.empty() ? "" : ", ") + difference;
      continue;
    }
    if (!ending.empty() && part.ends_with(ending) && part.size() > ending.size()) {
      part.resize(part.size() - ending.size());
    }
    words += (words.empty() ? "" : ", ") + said_composed(in_phrases(in_words(part)));
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
