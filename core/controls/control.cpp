#include "core/controls/control.h"

#include <algorithm>
#include <cctype>

#include "core/error.h"

namespace jnd::core {
namespace {

/// Returns the name without the numbers of maker and model.
std::string_view plain_device(std::string_view device) {
  constexpr std::size_t kNumbers = 9;  // "0c45:7403"
  const bool has_numbers =
      device.size() > kNumbers + 1 && device[4] == ':' && device[kNumbers] == ' ';
  return has_numbers ? device.substr(kNumbers + 1) : device;
}

/// Returns "B" for "KEY_B", "Left shift" for "KEY_LEFT_SHIFT", "Hat 0X-" for "ABS_HAT0X-".
std::string plain_control(std::string_view name) {
  if (name.starts_with("ABS_HAT")) return "Hat " + std::string(name.substr(7));
  for (const std::string_view prefix : {"KEY_", "BTN_"}) {
    if (name.starts_with(prefix)) name.remove_prefix(prefix.size());
  }
  std::string words(name);
  for (std::size_t i = 1; i < words.size(); ++i) {
    words[i] = words[i] == '_'
                   ? ' '
                   : static_cast<char>(std::tolower(static_cast<unsigned char>(words[i])));
  }
  return words;
}

}  // namespace

std::string words_of(const Control& control) {
  return std::string(plain_device(control.device)) + ": " + plain_control(control.name);
}

std::string stored_words(const Control& control) { return control.device + '/' + control.name; }

void ControlMap::set(const std::string& action, const Control& control) {
  if (std::ranges::find(kControlActions, action) == kControlActions.end()) {
    throw Error("controls: expected an action such as `first`, found `" + action.substr(0, 60) +
                "`");
  }
  std::erase_if(rows_,
                [&](const Row& row) { return row.action == action || row.control == control; });
  rows_.push_back({action, control});
}

void ControlMap::forget(const std::string& action) {
  std::erase_if(rows_, [&](const Row& row) { return row.action == action; });
}

std::string ControlMap::action_of(const Control& control) const {
  const auto found = std::ranges::find(rows_, control, &Row::control);
  return found == rows_.end() ? "" : found->action;
}

const Control* ControlMap::control_of(std::string_view action) const {
  const auto found = std::ranges::find(rows_, action, &Row::action);
  return found == rows_.end() ? nullptr : &found->control;
}

bool ControlMap::names(const std::string& device) const {
  return std::ranges::any_of(rows_,
                             [&](const Row& row) { return row.control.device == device; });
}

}  // namespace jnd::core
