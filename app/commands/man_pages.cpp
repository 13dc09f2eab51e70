#include <CLI/CLI.hpp>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>

#include "app/command_line/command.h"
#include "app/manual/command_tree.h"
#include "app/manual/manual_page.h"
#include "core/error.h"

namespace jnd::app {
namespace {

int write_man_pages(const CLI::App& program, const std::filesystem::path& folder) {
  const ManualCommand root = command_tree(program);
  std::filesystem::create_directories(folder);
  for (const ManualCommand* command : all_commands(root)) {
    const std::filesystem::path path = folder / manual_file_name(*command);
    std::ofstream file(path);
    file << manual_page(*command, root, JND_VERSION);
    file.close();
    if (!file) {
      throw core::Error(path.string() +
                        ": expected to be written in full, found that it was not; make room "
                        "there or name another folder");
    }
  }
  return kDone;
}

}  // namespace

/// This command is for people who make packages, so `--help` does not list it.
void add_man_pages(CLI::App& program, Invocation& invocation) {
  CLI::App* command =
      program.add_subcommand("man-pages", "Writes a manual page for each command")->group("");
  const auto folder = std::make_shared<std::string>();
  command->add_option("DIR", *folder, "Folder to write to, made if absent")->required();
  command->callback([&program, &invocation, folder] {
    invocation.run = [&program, folder] { return write_man_pages(program, *folder); };
  });
}

}  // namespace jnd::app
