#pragma once

#include <string>
#include <vector>

#include "app/manual/command_tree.h"

namespace jnd::app {

/// Scripts with which a shell completes the commands, options and values of the tree.
[[nodiscard]] std::string bash_completion(const ManualCommand& root, const CommandWords& words);
[[nodiscard]] std::string zsh_completion(const ManualCommand& root, const CommandWords& words);
[[nodiscard]] std::string fish_completion(const ManualCommand& root, const CommandWords& words);

/// The list with this name, as in `ManualOption::words`.
[[nodiscard]] const std::vector<std::string>& words_named(const CommandWords& words,
                                                          const std::string& list);

/// The last word of a command's name.
[[nodiscard]] std::string last_word(const ManualCommand& command);

}  // namespace jnd::app
