#include "app/session/fitting.h"

#include <algorithm>
#include <utility>

#include "app/command_line/usage_message.h"
#include "core/error.h"
#include "experiments/protocol/structure_check.h"

namespace jnd::app {
namespace {

std::string without_blanks(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

}  // namespace

std::map<std::string, std::string> fitting_of(const std::vector<std::string>& pairs,
                                              const std::string& place) {
  constexpr std::size_t kLongest = 200;
  std::map<std::string, std::string> fitting;
  for (const std::string& one : pairs) {
    const std::size_t divider = one.find('=');
    const std::string key = one.substr(0, divider);
    const std::string value =
        divider == std::string::npos ? "" : one_line(one.substr(divider + 1));
    if (!experiments::is_name(key) || value.empty() || value.size() > kLongest) {
      throw core::Error(
          place +
          ": expected KEY=VALUE, the key of lower-case letters, digits and _, the "
          "value of at most 200 letters, found `" +
          one_line(one.substr(0, 80)) + "`");
    }
    if (!fitting.emplace(key, value).second) {
      throw core::Error(place + ": expected each key once, found `" + key + "` a second time");
    }
  }
  return fitting;
}

std::map<std::string, std::string> fitting_in(const std::string& line,
                                              const std::string& place) {
  std::vector<std::string> pairs;
  for (std::size_t begin = 0; begin < line.size();) {
    const std::size_t comma = std::min(line.find(',', begin), line.size());
    std::string pair = without_blanks(line.substr(begin, comma - begin));
    const std::size_t divider = pair.find('=');
    if (divider != std::string::npos) {
      pair = without_blanks(pair.substr(0, divider)) + '=' +
             without_blanks(pair.substr(divider + 1));
    }
    if (!pair.empty()) pairs.push_back(std::move(pair));
    begin = comma + 1;
  }
  return fitting_of(pairs, place);
}

bool is_fitting(const std::string& line) {
  try {
    (void)fitting_in(line, "");
  } catch (const core::Error&) {
    return false;
  }
  return true;
}

std::string fitting_line(const std::map<std::string, std::string>& fitting) {
  std::string line;
  for (const auto& [key, value] : fitting) {
    line += (line.empty() ? "" : ", ") + key + '=' + value;
  }
  return line;
}

}  // namespace jnd::app
