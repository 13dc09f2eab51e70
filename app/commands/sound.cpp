#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include "app/command_line/command.h"
#include "app/command_line/json_text.h"
#include "app/command_line/option_checks.h"
#include "app/command_line/stop_signals.h"
#include "app/profile/known_profile.h"
#include "app/session/shipped_files.h"
#include "app/sound/sound_outputs.h"
#include "app/sound/sound_settings.h"
#include "app/sound/tried_sound.h"
#include "core/error.h"
#include "core/sound/sound_level.h"
#include "experiments/protocol/study_reader.h"
#include "experiments/study/sound.h"

namespace jnd::app {
namespace {

using namespace std::chrono_literals;
using experiments::MaskingNoise;

/// The level of a first try, which one hardly hears in most headphones.
constexpr double kQuiet_dbfs = -60.0;

struct SoundOptions {
  std::string play;    ///< "noise", "cues" or "both"; "" for nothing.
  std::string output;  ///< "" for the machine's own.
  std::string study;
  std::string kind = "pink";
  double low_hz = 200.0, high_hz = 4000.0;
  double cue_hz = 1000.0;
  std::optional<double> level_dbfs, level_db_spl;
  double duration_s = 10.0;
  std::optional<double> calibrate_db_spl;
  bool keep = false, json = false;
};

experiments::Sound sound_asked_for(const SoundOptions& options) {
  if (!options.study.empty()) {
    return experiments::read_study(user_or_shipped(options.study, "protocols")).sound;
  }
  experiments::SoundLevel level{.level_db_spl = options.level_db_spl,
                                .level_dbfs = options.level_dbfs};
  if (!level.level_db_spl && !level.level_dbfs) level.level_dbfs = kQuiet_dbfs;
  experiments::Sound sound;
  using Kind = MaskingNoise::Kind;
  if (options.play != "cues") {
    sound.masking_noise = {.kind = options.kind == "white"  ? Kind::kWhite
                                   : options.kind == "band" ? Kind::kBand
                                                            : Kind::kPink,
                           .level = level,
                           .low_hz = options.low_hz,
                           .high_hz = options.high_hz};
  }
  if (options.play != "noise") {
    sound.cues.push_back({.frequency_hz = options.cue_hz, .level = level});
  }
  return sound;
}

std::string level_words(double level_dbfs, const std::optional<SoundCalibration>& known) {
  if (!known) return fmt::format("{:.1f} dB re full scale, not calibrated", level_dbfs);
  return fmt::format("{:.1f} dB re full scale, {:.1f} dB SPL", level_dbfs,
                     level_dbfs + known->full_scale_db_spl);
}

int list_outputs(const SoundSettings& settings, bool json) {
  const std::vector<KnownOutput> outputs = known_outputs(settings);
  if (json) {
    nlohmann::ordered_json document = nlohmann::ordered_json::array();
    for (const KnownOutput& one : outputs) {
      nlohmann::ordered_json entry = {{"name", one.name},
                                      {"description", one.description},
                                      {"is_chosen", one.is_chosen},
                                      {"full_scale_db_spl", nullptr},
                                      {"measured_on", nullptr}};
      if (one.calibration) {
        entry["full_scale_db_spl"] = one.calibration->full_scale_db_spl;
        entry["measured_on"] = one.calibration->measured_on;
      }
      document.push_back(std::move(entry));
    }
    fmt::print("{}\n", json_text(document));
    return kDone;
  }
  for (const KnownOutput& one : outputs) {
    fmt::print(
        "{}{}\n  {}\n  {}\n", one.name, one.is_chosen ? "  (sessions use it)" : "",
        one.description.empty() ? "no description" : one.description,
        one.calibration
            ? fmt::format("a sine of full scale is {:.1f} dB SPL, measured on {}",
                          one.calibration->full_scale_db_spl, one.calibration->measured_on)
            : std::string("not calibrated"));
  }
  return kDone;
}

/// Tells how many gaps there were; the exit code is 1 if there were any.
int tell_played(const TriedSound& sound, const std::string& output, bool json) {
  const device::SoundOutputState state = sound.state();
  if (json) {
    fmt::print("{}\n", json_text(nlohmann::ordered_json{{"output", output},
                                                        {"words", sound.words()},
                                                        {"scheduler", state.scheduler},
                                                        {"num_frames", sound.num_frames()},
                                                        {"num_underruns", state.num_underruns},
                                                        {"num_limited", sound.num_limited()},
                                                        {"max_latency_s", state.max_latency_s},
                                                        {"problem", state.problem}}));
  } else {
    fmt::print(
        "{}\n{}; {} samples, {} gaps, {} samples turned down by the limiter, at most {:.1f} ms "
        "from a sample's computation to its being heard\n",
        sound.words(), state.scheduler, sound.num_frames(), state.num_underruns,
        sound.num_limited(), 1e3 * state.max_latency_s);
  }
  if (!state.problem.empty()) throw EnvironmentError(state.problem);
  return state.num_underruns == 0 ? kDone : kHasProblems;
}

int play_sound(const SoundOptions& options, const SoundSettings& settings,
               const std::string& output) {
  const std::optional<SoundCalibration> known = settings.calibration_of(output);
  const experiments::Sound wanted = sound_asked_for(options);
  if (wanted.is_silent()) {
    throw UsageError(
        "--sound-of: expected a study with masking_noise or cues beside its "
        "stages, found none in " +
        options.study);
  }
  stop_on_signals();
  std::optional<TriedSound> sound;
  try {
    sound.emplace(
        TriedSound::Parameters{.output = output, .calibration = known, .sound = wanted});
  } catch (const core::Error& error) {
    throw EnvironmentError(error.what());
  }
  if (const std::optional<double> level_dbfs = sound->noise_level_dbfs()) {
    std::fprintf(stderr, "jnd: noise at %s, on %s; it comes up over %.0f s, Ctrl-C ends it\n",
                 level_words(*level_dbfs, known).c_str(), output.c_str(), TriedSound::kRise_s);
  }
  const auto begun = std::chrono::steady_clock::now();
  const std::chrono::duration<double> whole(options.duration_s);
  auto next_cue = begun + 1s;
  while (!stop_requested() && sound->state().problem.empty() &&
         std::chrono::steady_clock::now() - begun < whole) {
    std::this_thread::sleep_for(20ms);
    if (std::chrono::steady_clock::now() < next_cue) continue;
    sound->give_next_cue();
    next_cue += 1s;
  }
  sound->end();
  while (sound->state().problem.empty() && !sound->is_over()) std::this_thread::sleep_for(20ms);
  return tell_played(*sound, output, options.json);
}

int calibrate(const SoundOptions& options, const SoundSettings& settings,
              const std::string& output) {
  if (!options.level_dbfs) {
    throw UsageError(
        "--calibrate: expected --level-dbfs, the level that was played while the meter showed "
        "this, found none");
  }
  const SoundCalibration known{
      .output = output,
      .full_scale_db_spl = *options.calibrate_db_spl - *options.level_dbfs,
      .measured_on = today()};
  settings.add(known);
  fmt::print(
      "{}: {:.1f} dB SPL at {:.1f} dB re full scale, so a sine of full scale is {:.1f} "
      "dB SPL; kept in {}\n",
      output, *options.calibrate_db_spl, *options.level_dbfs, known.full_scale_db_spl,
      settings.file().string());
  return kDone;
}

int run_sound(const SoundOptions& options) {
  const SoundSettings settings;
  if (options.level_dbfs && options.level_db_spl) {
    throw UsageError("--level-db-spl: expected one level, found --level-dbfs as well");
  }
  const std::string output = options.output.empty() ? settings.output() : options.output;
  if (options.keep) {
    if (options.output.empty()) {
      throw UsageError(
          "--keep: expected --output, the one that sessions are to use, found none");
    }
    settings.choose(output);
    fmt::print(options.json ? stderr : stdout, "sessions use {}; kept in {}\n", output,
               settings.file().string());
  }
  if (options.calibrate_db_spl) return calibrate(options, settings, output);
  if (!options.play.empty() || !options.study.empty()) {
    return play_sound(options, settings, output);
  }
  return options.keep ? int{kDone} : list_outputs(settings, options.json);
}

}  // namespace

HelpPlace place_of_sound() { return {HelpGroup::kApparatus, 120}; }

void add_sound(CLI::App& program, Invocation& invocation) {
  const auto options = std::make_shared<SoundOptions>();
  CLI::App* command = program.add_subcommand(
      "sound",
      "Lists outputs of sound, plays masking noise and cues, and keeps how loud they are");
  invocation.examples[command] = {
      {"jnd sound", "outputs of this machine, and which are calibrated"},
      {"jnd sound --play noise --level-dbfs -50 --seconds 60",
       "a minute of pink noise for the meter, and how many gaps it had"}};
  CLI::Option* play =
      command
          ->add_option("--play", options->play,
                       "noise, cues (one a second) or both, from silence up over three seconds")
          ->check(CLI::IsMember({"noise", "cues", "both"}));
  command
      ->add_option("--sound-of", options->study,
                   "Play what this study has beside its stages: a file, or a shipped study")
      ->type_name("STUDY")
      ->excludes(play);
  command
      ->add_option("--output", options->output,
                   "As listed without options; default: the one that sessions use")
      ->type_name("NAME");
  command->add_option("--kind", options->kind, "Of the noise")
      ->check(CLI::IsMember({"white", "pink", "band"}))
      ->capture_default_str();
  command->add_option("--low-hz", options->low_hz, "Where a band begins")
      ->check(number_between(20.0, 20000.0))
      ->capture_default_str();
  command->add_option("--high-hz", options->high_hz, "Where a band ends")
      ->check(number_between(20.0, 20000.0))
      ->capture_default_str();
  command->add_option("--cue-hz", options->cue_hz, "Frequency of the cue")
      ->check(number_between(100.0, 8000.0))
      ->capture_default_str();
  command
      ->add_option("--level-dbfs", options->level_dbfs,
                   "Level of noise and cue, where a sine of full scale has 0; default: -60")
      ->check(number_between(-120.0, core::kLoudestNoise_dbfs));
  command
      ->add_option("--level-db-spl", options->level_db_spl,
                   "The same as sound pressure level, on an output that is calibrated")
      ->check(number_between(0.0, core::kLoudest_db_spl));
  command->add_option("--seconds", options->duration_s, "How long it plays; gaps are counted")
      ->check(number_between(0.1, 86'400.0))
      ->capture_default_str();
  command
      ->add_option("--calibrate", options->calibrate_db_spl,
                   "Keep that the meter showed this many dB SPL at --level-dbfs")
      ->check(number_between(0.0, 140.0))
      ->type_name("DB_SPL");
  command->add_flag("--keep", options->keep, "Sessions use --output from now on");
  command->add_flag("--json", options->json, "Print one JSON document");
  command->callback(
      [options, &invocation] { invocation.run = [options] { return run_sound(*options); }; });
}

}  // namespace jnd::app
