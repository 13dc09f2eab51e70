#include "app/commands/participant_list.h"

#include <charconv>
#include <optional>
#include <string_view>

#include "app/command_line/command.h"
#include "app/command_line/usage_message.h"

namespace jnd::app {
namespace {

constexpr int kMostParticipants = 10000;
constexpr std::size_t kMostSizes = 1000;

std::optional<int> number_of(std::string_view word) {
  int value = 0;
  const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (word.empty() || stop != word.data() + word.size() || error != std::errc() || value < 1 ||
      value > kMostParticipants) {
    return std::nullopt;
  }
  return value;
}

[[noreturn]] void refuse(const std::string& place, const std::string& text) {
  throw UsageError(place +
                   ": expected numbers of participants from 1 to 10000 in ascending order, "
                   "such as 6,8,13 or 6,8..40 or 5..9, found `" +
                   one_line(text.substr(0, 80)) + "`");
}

}  // namespace

std::vector<int> participant_list(const std::string& text, const std::string& place) {
  std::vector<int> sizes;
  const auto add = [&](int size) {
    if ((!sizes.empty() && size <= sizes.back()) || sizes.size() == kMostSizes) {
      refuse(place, text);
    }
    sizes.push_back(size);
  };
  std::size_t begin = 0;
  while (true) {
    const std::size_t comma = text.find(',', begin);
    const std::string_view word = std::string_view(text).substr(begin, comma - begin);
    const std::size_t dots = word.find("..");
    const std::optional<int> first = number_of(word.substr(0, dots));
    if (!first) refuse(place, text);
    const int step = sizes.empty() ? 1 : *first - sizes.back();
    add(*first);
    if (dots != std::string_view::npos) {
      const std::optional<int> last = number_of(word.substr(dots + 2));
      if (!last || *last < *first) refuse(place, text);
      for (int size = *first + step; size <= *last; size += step) add(size);
    }
    if (comma == std::string::npos) return sizes;
    begin = comma + 1;
  }
}

}  // namespace jnd::app
