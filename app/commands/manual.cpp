#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "app/command_line/command.h"
#include "app/command_line/json_text.h"
#include "app/manual/manual_place.h"
#include "app/operator/open_outside.h"
#include "app/session/shipped_files.h"
#include "experiments/study/study_problem.h"

namespace jnd::app {
namespace {

struct ManualOptions {
  std::string page;
  bool lists = false, opens = false, json = false;
};

/// The names by which pages are called, in small letters.
std::vector<std::string> names_of_pages(const std::vector<std::string>& pages) {
  std::vector<std::string> names;
  for (const std::string& page : pages) {
    std::string name = std::filesystem::path(page).stem().string();
    std::ranges::transform(name, name.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    names.push_back(std::move(name));
  }
  return names;
}

std::string chosen_page(const std::vector<std::string>& pages, const std::string& name) {
  if (name.empty()) return std::string(kFirstManualPage);
  std::string page = manual_page_named(pages, name);
  if (!page.empty()) return page;
  const std::string near = experiments::did_you_mean(name, names_of_pages(pages));
  throw UsageError("manual: expected the name of a page, found `" + name + "`" +
                   (near.empty() ? "; see `jnd manual --list`" : near));
}

int run_manual(const ManualOptions& options) {
  const std::filesystem::path shipped = shipped_folder();
  const std::vector<std::string> pages = manual_pages(shipped);
  if (pages.empty()) {
    throw EnvironmentError(
        "manual: expected docs/README.md beside the program or in the source tree, found it in "
        "neither; install the package, or set JND_SHARE to the source tree");
  }
  if (options.lists) {
    if (options.json) {
      std::puts(json_text(nlohmann::json{{"pages", pages}}).c_str());
    } else {
      for (const std::string& page : pages) std::puts(page.c_str());
    }
    return kDone;
  }
  const ManualPlace place = manual_place(shipped, chosen_page(pages, options.page));
  if (options.json) {
    std::puts(json_text(nlohmann::json{{"page", place.page},
                                       {"place", place.file.string()},
                                       {"is_site", place.is_site}})
                  .c_str());
  } else {
    std::puts(place.file.c_str());
  }
  if (!options.opens) return kDone;
  const std::string problem = open_outside(place.file);
  if (!problem.empty()) throw EnvironmentError("manual: " + problem);
  return kDone;
}

}  // namespace

HelpPlace place_of_manual() { return {HelpGroup::kProgram, 10}; }

void add_manual(CLI::App& program, Invocation& invocation) {
  CLI::App* command =
      program.add_subcommand("manual", "Where a page of the manual is, and opens it");
  invocation.examples[command] = {
      {"jnd manual run_a_session --open",
       "opens the page about sessions, in the browser where the site is there"},
      {"jnd manual --list", "the names of all pages"}};
  const auto options = std::make_shared<ManualOptions>();
  command->add_option(
      "PAGE", options->page,
      "A page by its name, such as run_a_session or safety; default: the first");
  CLI::Option* list = command->add_flag("--list", options->lists, "The names of all pages");
  command->add_flag("--open", options->opens, "Open it with the program of the desktop")
      ->excludes(list);
  command->add_flag("--json", options->json, "One JSON document on stdout");
  command->callback(
      [&invocation, options] { invocation.run = [options] { return run_manual(*options); }; });
}

}  // namespace jnd::app
