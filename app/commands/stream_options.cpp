#include "app/commands/stream_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>

#include "app/command_line/command.h"
#include "core/error.h"
#include "core/storage/study_store.h"

namespace jnd::app {
namespace {

/// Names liblsl's file, for people who always want to use it.
constexpr char kLibraryVariable[] = "JND_LIBLSL";

bool hides_levels(const experiments::Study& study, const std::filesystem::path& folder) {
  if (study.blinding != experiments::Blinding::kDouble) return false;
  if (!std::filesystem::exists(folder / "study.sqlite")) return true;
  return !core::StudyStore(folder, core::StudyStore::Mode::kReadOnly).unblinded();
}

std::string listed(const std::vector<std::string>& words) {
  return fmt::format("{}", fmt::join(words, ", "));
}

}  // namespace

void add_stream_options(CLI::App& command, StreamOptions& options) {
  command
      .add_option("--lsl-out", options.out,
                  "Streams to other recorders by the Lab Streaming Layer: markers, samples or "
                  "both with a comma")
      ->delimiter(',')
      ->type_name("STREAMS")
      ->check(CLI::IsMember({"markers", "samples"}));
  command
      .add_option("--lsl-channel", options.channels,
                  "Of samples this one alone, as hand_force_z_n or position_m; may be given "
                  "several times. Default: position, velocity and force of the hand")
      ->type_name("NAME")
      ->allow_extra_args(false);
  command
      .add_option("--lsl-in", options.in,
                  "Record streams of others with the session, as type=EEG, or by name, "
                  "source_id or hostname; may be given several times")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command
      .add_option("--lsl-peer", options.peers,
                  "A machine whose streams are looked for although no broadcast reaches it; "
                  "may be given several times")
      ->type_name("HOST")
      ->allow_extra_args(false);
  command
      .add_option("--lsl-library", options.library,
                  "A liblsl of your own that carries the streams; default: jnd itself")
      ->type_name("FILE")
      ->envname(kLibraryVariable);
}

WantedStreams streams_given(const StreamOptions& options) {
  WantedStreams wanted{.channels = options.channels,
                       .inlets = options.in,
                       .peers = options.peers,
                       .library = options.library};
  for (const std::string& stream : options.out) {
    (stream == "markers" ? wanted.markers : wanted.samples) = true;
  }
  if (!wanted.any()) return {};
  try {
    require_possible(wanted, /*hides_levels=*/false);
  } catch (const core::Error& error) {
    throw UsageError(error.what());
  }
  return wanted;
}

void require_streams_fit(const WantedStreams& wanted, bool is_realtime,
                         const experiments::Study& study, const std::filesystem::path& folder) {
  if (!wanted.any()) return;
  if (!is_realtime) {
    throw UsageError(
        "--lsl-out, --lsl-in: expected a session in real time, for others record "
        "by the clock, found one in simulated time; add --realtime");
  }
  try {
    require_possible(wanted, hides_levels(study, folder));
  } catch (const core::Error& error) {
    throw UsageError(error.what());
  }
  std::vector<std::string> out;
  if (wanted.markers) out.emplace_back("markers");
  if (wanted.samples) out.emplace_back("samples");
  std::fprintf(stderr, "jnd: streams: out: %s; in: %s; carried by %s\n",
               out.empty() ? "none" : listed(out).c_str(),
               wanted.inlets.empty() ? "none" : listed(wanted.inlets).c_str(),
               wanted.library.empty() ? "jnd itself" : wanted.library.c_str());
}

}  // namespace jnd::app
