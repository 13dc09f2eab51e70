#pragma once

#include <string>

#include "app/manual/command_tree.h"

namespace jnd::app {

/// "jnd-fit-weber.1"
[[nodiscard]] std::string manual_file_name(const ManualCommand& command);

/// The command's page in the macros of man(7). `root` is the whole tree.
[[nodiscard]] std::string manual_page(const ManualCommand& command, const ManualCommand& root,
                                      const std::string& version);

}  // namespace jnd::app
