#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "analysis/report/figure_files.h"
#include "analysis/report/report_document.h"
#include "app/command_line/command.h"
#include "app/command_line/json_text.h"
#include "app/command_line/option_checks.h"
#include "app/preregistration/preregistration.h"
#include "app/session/shipped_files.h"
#include "core/error.h"
#include "core/storage/sha256.h"
#include "core/storage/study_store.h"
#include "experiments/protocol/study_reader.h"

namespace jnd::app {
namespace {

namespace fs = std::filesystem;

struct PreregisterOptions {
  std::string file;
  PlannedConduct conduct;
  std::string power;   ///< The folder of `jnd power --out`.
  std::string folder;  ///< The study folder that stores the preregistration.
  std::string out;
  bool json = false;
};

/// The document of `jnd power`; null if none was asked for.
nlohmann::ordered_json power_of(const std::string& folder, const experiments::Study& study) {
  if (folder.empty()) return nullptr;
  const fs::path file = fs::path(folder) / "power.json";
  std::ifstream stream(file, std::ios::binary);
  auto json = nlohmann::ordered_json::parse(stream, nullptr, /*allow_exceptions=*/false);
  if (!json.is_object() || !json.contains("sizes") || !json.contains("study_sha256")) {
    throw core::Error(file.string() +
                      ": expected what `jnd power --out` writes, found something else or "
                      "nothing");
  }
  if (json.at("study_sha256") != core::sha256(study.text)) {
    throw core::Error(file.string() +
                      ": expected the power of this study file, found that of "
                      "another or of an earlier text of it; run `jnd power` "
                      "again");
  }
  return json;
}

int run_preregister(const PreregisterOptions& options) {
  if (options.out.empty() && options.folder.empty()) {
    throw UsageError(
        "expected --out, a new folder for the documents, or --study, the study "
        "folder that keeps the plan, found neither");
  }
  if (!options.out.empty()) analysis::require_free_folder(options.out);
  const fs::path file = user_or_shipped(options.file, "protocols");
  const experiments::Study study = experiments::read_study(file);
  if (study.sequential && options.conduct.num_participants != study.sequential->looks.back()) {
    throw UsageError("--participants: expected " +
                     std::to_string(study.sequential->looks.back()) +
                     ", the last of the study's looks, found " +
                     std::to_string(options.conduct.num_participants));
  }
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  const std::int64_t time_ns =
      std::chrono::duration_cast<std::chrono::nanoseconds>(now).count();
  const Preregistration plan =
      preregistration_of(study, file.filename().string(), options.conduct,
                         power_of(options.power, study), time_ns);
  const std::string text = json_text(plan) + "\n";
  if (!options.folder.empty()) {
    core::StudyStore store(options.folder, core::StudyStore::Mode::kCreate);
    keep_preregistration(store, text);
  }
  if (!options.out.empty()) {
    fs::create_directories(options.out);
    const fs::path out = options.out;
    analysis::write_text_file(out / kPreregistrationFile, text);
    analysis::write_text_file(out / "preregistration.md", preregistration_markdown(plan));
    analysis::write_text_file(out / "preregistration.html", preregistration_html(plan));
  }
  if (options.json) {
    std::fputs(text.c_str(), stdout);
    return kDone;
  }
  std::printf("%s: %d participants planned, %zu contrasts, SHA-256 of the plan %s\n",
              study.name.c_str(), options.conduct.num_participants, study.contrasts.size(),
              core::sha256(text).c_str());
  if (study.contrasts.empty()) {
    std::puts("The study file plans no contrast, so every comparison will be exploratory.");
  }
  if (!options.out.empty()) {
    std::printf("%s: written as JSON, Markdown and HTML; put it where its date can be proven\n",
                options.out.c_str());
  }
  if (!options.folder.empty()) {
    std::printf("%s: keeps the plan; results and report tell what deviates from it\n",
                options.folder.c_str());
  }
  return kDone;
}

}  // namespace

HelpPlace place_of_preregister() { return {HelpGroup::kWriting, 70}; }

void add_preregister(CLI::App& program, Invocation& invocation) {
  CLI::App* command = program.add_subcommand(
      "preregister", "Writes what is planned before anybody takes part, to hold the study to");
  invocation.examples[command] = {
      {"jnd preregister my_study.json --participants 24 --study my_study.study",
       "writes the plan and keeps it with the data"}};
  const auto options = std::make_shared<PreregisterOptions>();
  command->add_option("FILE", options->file, "Study file, or the name of a shipped study")
      ->required();
  command
      ->add_option("--participants", options->conduct.num_participants,
                   "How many complete sessions are planned; with looks, at the last of them")
      ->required()
      ->check(whole_number(1, 100000));
  command->add_option("--power", options->power, "Folder of `jnd power --out`: why so many")
      ->check(CLI::ExistingDirectory);
  command->add_option("--rationale", options->conduct.rationale, "Why so many, in words");
  command->add_option("--exclusions", options->conduct.exclusions,
                      "Which data will be left out, in words; default: none");
  command->add_option("--stopping", options->conduct.stopping,
                      "When the study ends, in words; default: by its looks where it plans "
                      "some, else with the last complete session");
  command->add_option("--device", options->conduct.device, "Device that all sessions run on");
  command->add_option("--out", options->out,
                      "New folder for preregistration.json, .md and .html");
  command->add_option("--study", options->folder,
                      "Study folder, made if absent, that keeps the plan: its results and "
                      "reports then list every deviation from it");
  command->add_flag("--json", options->json, "The plan as one JSON document on stdout");
  command->callback([&invocation, options] {
    invocation.run = [options] { return run_preregister(*options); };
  });
}

}  // namespace jnd::app
