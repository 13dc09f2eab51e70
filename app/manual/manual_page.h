#pragma once

#include <string>
#include <vector>

#include "app/manual/command_tree.h"

namespace jnd::app {

/// A call that shows what a command is for.
struct ManualExample {
  std::string call;     ///< Such as "jnd validate my_study.json".
  std::string meaning;  ///< One phrase.
};

/// The examples of the command with this name, such as "jnd fit weber"; empty if it has none.
[[nodiscard]] std::vector<ManualExample> manual_examples(const std::string& name);

/// The name of the command's page, such as "jnd-fit-weber.1".
[[nodiscard]] std::string manual_file_name(const ManualCommand& command);

/// The command's page in the macros of man(7). `root` is the whole tree.
[[nodiscard]] std::string manual_page(const ManualCommand& command, const ManualCommand& root,
                                      const std::string& version);

}  // namespace jnd::app
