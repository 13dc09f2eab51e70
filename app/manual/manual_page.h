#pragma once

#include <string>
#include <vector>

#include "app/manual/command_tree.h"

namespace jnd::app {

/// A call that shows what a command is for.
struct ManualExample {
  std::string call;     ///< "jnd validate my_study.json"
  std::string meaning;  ///< One phrase.
};

/// Those of the command of this name, "jnd fit weber"; none if it has none.
[[nodiscard]] std::vector<ManualExample> manual_examples(const std::string& name);

/// "jnd-fit-weber.1"
[[nodiscard]] std::string manual_file_name(const ManualCommand& command);

/// The page of the command, in the macros of man(7). `root`: the whole tree.
[[nodiscard]] std::string manual_page(const ManualCommand& command, const ManualCommand& root,
                                      const std::string& version);

}  // namespace jnd::app
