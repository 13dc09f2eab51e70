#include "app/operator/scope_channels.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <sstream>
#include <utility>

#include "core/sample_table.h"

namespace jnd::app {
namespace {

// If an ending is also the end of another one, the longer one comes first.
constexpr std::array<std::pair<std::string_view, std::string_view>, 5> kUnits = {
    {{"_m_per_s", "m/s"}, {"_n_m", "N m"}, {"_rad", "rad"}, {"_n", "N"}, {"_m", "m"}}};

ScopeChannel channel_named(const std::string& name) {
  ScopeChannel channel{.name = name, .label = name};
  for (const auto& [ending, unit] : kUnits) {
    if (!name.ends_with(ending)) continue;
    channel.label.resize(name.size() - ending.size());
    channel.unit = unit;
    break;
  }
  std::ranges::replace(channel.label, '_', ' ');
  return channel;
}

std::string in_small_letters(std::string_view text) {
  std::string small(text);
  std::ranges::transform(small, small.begin(), [](unsigned char letter) {
    return static_cast<char>(std::tolower(letter));
  });
  return small;
}

}  // namespace

std::vector<ScopeChannel> scope_channels(bool with_joints) {
  std::vector<ScopeChannel> channels;
  for (const std::string& name : core::sample_column_names({.joints = with_joints})) {
    if (name != "tick") channels.push_back(channel_named(name));
  }
  return channels;
}

std::vector<ScopeChannel> channels_matching(const std::vector<ScopeChannel>& channels,
                                            std::string_view typed) {
  std::vector<ScopeChannel> matching;
  for (const ScopeChannel& channel : channels) {
    const std::string searched = in_small_letters(channel.label + " " + channel.unit);
    std::istringstream words(in_small_letters(typed));
    bool has_all = true;
    for (std::string word; words >> word;) {
      has_all = has_all && searched.find(word) != std::string::npos;
    }
    if (has_all) matching.push_back(channel);
  }
  return matching;
}

}  // namespace jnd::app
