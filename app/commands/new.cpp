#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>

#include "app/command_line/command.h"
#include "app/command_line/json_text.h"
#include "app/command_line/usage_message.h"
#include "app/session/shipped_files.h"
#include "core/error.h"
#include "experiments/protocol/schema_writer.h"
#include "experiments/protocol/starter_study.h"
#include "experiments/protocol/structure_check.h"
#include "experiments/protocol/study_reader.h"

namespace jnd::app {
namespace {

namespace fs = std::filesystem;

struct NewOptions {
  std::string name;
  std::string from;
  bool json = false;
};

/// Writes a file that does not exist yet. Throws `Error` if it does, or if the disk refuses.
void write_new_file(const fs::path& file, const std::string& text) {
  std::FILE* stream = std::fopen(file.c_str(), "wx");
  if (stream == nullptr) {
    throw core::Error(file.string() + ": expected a new file, found " +
                      (errno == EEXIST
                           ? std::string("one of that name; nothing was overwritten")
                           : "that it cannot be made: " + std::string(std::strerror(errno))));
  }
  const bool written = std::fwrite(text.data(), 1, text.size(), stream) == text.size();
  const bool closed = std::fclose(stream) == 0;
  if (!written || !closed) {
    const std::string reason = std::strerror(errno);
    std::error_code ignored;
    // Half a study is of no use.
    fs::remove(file, ignored);
    throw core::Error(file.string() +
                      ": expected to be written, found that it cannot be: " + reason);
  }
}

enum class Schema { kWritten, kThereAlready, kAnother };

/// Puts the schema beside a study, where its `$schema` finds it, so that editors need no
/// network. A file of that name is left as it is.
Schema write_schema_beside(const fs::path& study) {
  const fs::path file = study.parent_path() / experiments::kSchemaFileName;
  const std::string schema = experiments::study_schema();
  std::error_code ignored;
  if (!fs::exists(file, ignored)) {
    write_new_file(file, schema);
    return Schema::kWritten;
  }
  std::ifstream stream(file, std::ios::binary);
  const std::string found{std::istreambuf_iterator<char>(stream), {}};
  return found == schema ? Schema::kThereAlready : Schema::kAnother;
}

void print(const fs::path& file, Schema schema) {
  const fs::path beside = file.parent_path() / experiments::kSchemaFileName;
  if (schema == Schema::kWritten) {
    fmt::print("{}: written; editors complete and explain the study's keys from it\n",
               beside.string());
  } else if (schema == Schema::kAnother) {
    fmt::print("{}: left as it is, though not of this version; `jnd schema > {}` renews it\n",
               beside.string(), beside.string());
  }
  fmt::print("{}: written; `jnd validate {}` tells its problems while you edit it\n",
             file.string(), file.string());
}

int run_new(const NewOptions& options) {
  fs::path file = options.name;
  if (file.extension() != ".json") file += ".json";
  const std::string name = file.stem().string();
  if (!experiments::is_name(name)) {
    throw UsageError("NAME: expected lower-case letters, digits and _, found `" +
                     one_line(name) + "`");
  }
  const std::string text =
      options.from.empty()
          ? experiments::starter_study(name)
          : experiments::renamed_study(
                experiments::read_study(user_or_shipped(options.from, "protocols")).text,
                options.from, name);
  write_new_file(file, text);
  const Schema schema = write_schema_beside(file);
  if (options.json) {
    fmt::print("{}\n",
               json_text(nlohmann::ordered_json{
                   {"file", file.string()},
                   {"name", name},
                   {"schema", (file.parent_path() / experiments::kSchemaFileName).string()}}));
  } else {
    print(file, schema);
  }
  return kDone;
}

}  // namespace

HelpPlace place_of_new() { return {HelpGroup::kWriting, 30}; }

void add_new(CLI::App& program, Invocation& invocation) {
  CLI::App* command = program.add_subcommand("new", "Write a commented starter study");
  invocation.examples[command] = {{"jnd new my_study --from viscosity_staircase",
                                   "writes my_study.json, which begins as the shipped study"}};
  const auto options = std::make_shared<NewOptions>();
  command
      ->add_option("NAME", options->name,
                   "Name of the study; NAME.json is written, never over "
                   "another file")
      ->required();
  command->add_option("--from", options->from, "Study to copy, a file or a shipped one");
  command->add_flag("--json", options->json, "Print one JSON document");
  command->callback(
      [&invocation, options] { invocation.run = [options] { return run_new(*options); }; });
}

}  // namespace jnd::app
