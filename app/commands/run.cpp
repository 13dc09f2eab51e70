#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <thread>

#include "app/command_line/command.h"
#include "app/command_line/open_window.h"
#include "app/command_line/option_checks.h"
#include "app/command_line/progress_bar.h"
#include "app/command_line/stop_signals.h"
#include "app/command_line/usage_message.h"
#include "app/commands/device_problems.h"
#include "app/commands/field_options.h"
#include "app/commands/fitting_option.h"
#include "app/commands/marker_options.h"
#include "app/commands/profile_option.h"
#include "app/commands/release_stop_option.h"
#include "app/commands/sound_option.h"
#include "app/commands/stream_options.h"
#include "app/operator/remembered_stop.h"
#include "app/profile/profile_choice.h"
#include "app/session/device_checks.h"
#include "app/session/laboratory_run.h"
#include "app/session/missing_force.h"
#include "app/session/pseudonym.h"
#include "app/session/session_setup.h"
#include "app/session/shipped_files.h"
#include "app/session/stored_session.h"
#include "core/error.h"
#include "core/safety/guard.h"
#include "device/haptic_device.h"
#include "device/registry/device_registry.h"
#include "experiments/protocol/study_reader.h"
#include "experiments/session/event.h"

namespace jnd::app {
namespace {

struct RunOptions {
  std::string file;
  std::string folder;
  std::string participant;
  std::string device = "lumped";
  std::string profile;  ///< A profile's file; if "", a real device's own is looked for.
  std::optional<std::uint64_t> seed;
  bool pilot = false;
  bool allow_no_realtime = false;
  bool headless = false;
  bool arm = false;
  bool releases_stop = false;
  bool shadow_guards = false;
  /// "" means the device's default for `run`, and the former laboratory for `resume`.
  std::string laboratory;
  bool realtime = false;
  bool acknowledge = false;
  std::string choose = "repeat";
  std::optional<std::int64_t> session;
  std::string language;              ///< "" for the study's first language.
  std::vector<std::string> fields;   ///< Such as "sex=female".
  std::vector<std::string> fitting;  ///< Such as "glove=M".
  /// How long to wait for a device that is elsewhere.
  double wait_s = 0.0;
  StreamOptions streams;
  MarkerOptions markers;
  std::string sound;             ///< "" for the machine's own output.
  std::string participant_stop;  ///< A key; "" for none.
  bool participant_holds = false;
};

/// " right" or " wrong", if the participant was told that of an answer; otherwise "".
std::string feedback_words(const core::EventRow& row) {
  const experiments::Event event = experiments::event_from_row(row);
  const auto* answer = std::get_if<experiments::TrialAnswered>(&event.data);
  if (answer == nullptr || !answer->feedback_right) return "";
  return *answer->feedback_right ? " right" : " wrong";
}

/// Prints `EVENT SEQUENCE KIND` for each commit until nobody reads it any more. An answer with
/// feedback is followed by `right` or `wrong`.
class Acknowledgements {
 public:
  explicit Acknowledgements(bool wanted) : wanted_(wanted) {}

  void tell(const core::EventRow& event) {
    if (!wanted_ || unheard_) return;
    unheard_ = std::printf("EVENT %lld %s%s\n", static_cast<long long>(event.sequence),
                           event.kind.c_str(), feedback_words(event).c_str()) < 0 ||
               std::fflush(stdout) != 0;
  }
  /// True if a line could not be delivered. The session then has to stop, because somebody
  /// relies on the lines.
  [[nodiscard]] bool unheard() const noexcept { return unheard_; }

 private:
  bool wanted_;
  bool unheard_ = false;
};

std::string how_to_go_on(const RunOptions& options, std::int64_t session) {
  return "`jnd resume " + options.folder + " --session " + std::to_string(session) +
         " --headless" + (options.realtime ? " --realtime" : "") + "` goes on from there";
}

/// Waits, as long as `wait_s` says, until a device that is elsewhere comes back and its link is
/// good. It says what it waits for once, and again if that changes.
class DeviceWait {
 public:
  explicit DeviceWait(double wait_s)
      : give_up_(Clock::now() + std::chrono::milliseconds(std::llround(1e3 * wait_s))) {}

  /// Returns after a second. Throws the problem when the time is over or the program has to
  /// stop.
  void over(const device::DeviceUnreachable& problem) {
    if (Clock::now() >= give_up_ || stop_requested()) throw problem;
    if (told_ != problem.what()) {
      told_ = problem.what();
      const auto left =
          std::chrono::duration_cast<std::chrono::seconds>(give_up_ - Clock::now());
      std::fprintf(stderr, "jnd: waiting for the device, for %lld s at most: %s\n",
                   static_cast<long long>(left.count()) + 1, told_.c_str());
    }
    std::this_thread::sleep_for(std::chrono::seconds(1));
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point give_up_;
  std::string told_;
};

/// Tells what each guard would have done to the session.
void tell_guards(const core::GuardCounts& guards) {
  for (std::size_t i = 0; i < core::kGuards.size(); ++i) {
    std::fprintf(stderr,
                 "jnd: guard %s: would have ended the force %u times, warned %u times\n",
                 std::string(core::name(core::kGuards[i])).c_str(), guards.num_shadowed[i],
                 guards.num_warnings[i]);
  }
}

/// Tells that the port has failed; the session goes on.
void tell_of_markers(const core::EventRow& row) {
  if (row.kind != "markers_failed") return;
  const experiments::Event event = experiments::event_from_row(row);
  std::fprintf(stderr, "jnd: markers: %s; the session goes on without them\n",
               std::get<experiments::MarkersFailed>(event.data).problem.c_str());
}

/// As soon as it is known, and once: what is felt may be nothing from here on.
class MissingForce {
 public:
  void tell(const core::EventRow& row) {
    if (is_told_ || row.kind != "force_missing") return;
    is_told_ = true;
    const experiments::Event event = experiments::event_from_row(row);
    const auto& missing = std::get<experiments::ForceMissing>(event.data);
    std::fprintf(stderr, "jnd: CAUTION, trial %lld: %s; the session goes on\n",
                 static_cast<long long>(missing.trial),
                 missing_force_words(1, missing.cause).c_str());
  }

 private:
  bool is_told_ = false;
};

int run_session(const RunOptions& options, core::StudyStore& store,
                const experiments::Study& study, const experiments::Laboratory& laboratory,
                std::int64_t session) {
  stop_on_signals();
  Acknowledgements acknowledgements(options.acknowledge);
  const std::string device = store.session(session).device;
  LaboratoryRunResult result;
  MissingForce missing_force;
  DeviceWait wait(options.wait_s);
  bool has_begun = false;
  ProgressBar bar(study.name);
  const auto run = [&] {
    return run_laboratory(
        {.study = study,
         .laboratory = laboratory,
         .store = store,
         .session = session,
         .realtime = options.realtime,
         .allow_no_realtime = options.allow_no_realtime,
         .arm = options.arm,
         .before_arming =
             [&] {
               if (options.releases_stop) forget_stop(stops_folder(), device);
             },
         .shadow_guards = options.shadow_guards,
         .choice = options.choose,
         .language = options.language,
         .fitting = fitting_given(options.fitting),
         .streams = streams_given(options.streams),
         .markers = markers_given(options.markers),
         .on_event =
             [&](const core::EventRow& event) {
               has_begun = true;
               tell_of_markers(event);
               missing_force.tell(event);
               acknowledgements.tell(event);
             },
         .on_progress = [&](double done) { bar.show(done); },
         .is_cancelled = [&] { return stop_requested() || acknowledgements.unheard(); }});
  };
  try {
    for (bool is_there = false; !is_there;) {
      try {
        result = run();
        is_there = true;
      } catch (const device::DeviceUnreachable& problem) {
        if (has_begun) throw;
        wait.over(problem);
      }
    }
  } catch (const core::Error& error) {
    std::string what = error.what();
    if (what.ends_with('.')) what.pop_back();
    throw core::Error(what + "; " + how_to_go_on(options, session));
  }
  const std::string unheard =
      "stdout: expected a reader of --acknowledge, found that it takes no more lines; ";
  for (const std::string& caution : result.cautions) {
    std::fprintf(stderr, "jnd: CAUTION, %s\n", caution.c_str());
  }
  if (options.shadow_guards) tell_guards(result.guards);
  if (!result.ended) {
    std::fprintf(stderr, "jnd: %s%s\n",
                 acknowledgements.unheard() ? unheard.c_str()
                                            : "stopped; every answer so far is on disk, and ",
                 how_to_go_on(options, session).c_str());
    return acknowledgements.unheard() ? kEnvironmentLacks : kDone;
  }
  if (acknowledgements.unheard()) {
    std::fprintf(stderr, "jnd: %sthe session is finished and on disk\n", unheard.c_str());
    return kEnvironmentLacks;
  }
  std::fprintf(options.acknowledge ? stderr : stdout,
               "session %lld: %s, %lld samples, loop %s\n", static_cast<long long>(session),
               result.ended_early ? "ended early" : "finished",
               static_cast<long long>(result.num_ticks), result.realtime.c_str());
  return kDone;
}

void require_pseudonym(const std::string& participant) {
  if (is_pseudonym(participant)) return;
  throw UsageError("--participant: expected a pseudonym of " + pseudonym_words() + ", found `" +
                   one_line(participant.substr(0, 64)) + "`");
}

/// Requires a language of the study's texts; "" stands for the first one.
void require_language(const experiments::Study& study, const std::string& language) {
  const auto& all = study.languages;
  if (language.empty() || std::find(all.begin(), all.end(), language) != all.end()) return;
  std::string words;
  for (const std::string& one : all) words += (words.empty() ? "" : ", ") + one;
  throw UsageError("--language: expected one that " + study.name + " has (" + words +
                   "), found `" + one_line(language.substr(0, 64)) + "`");
}

/// Warns of similar pseudonyms, so that one person's two visits do not count as two people's.
/// A session goes on where the device cuts a stimulus, as its limits say; who runs it is told.
void warn_of_device_problems(const std::filesystem::path& study_file, const std::string& device,
                             const std::optional<KnownProfile>& profile) {
  constexpr double kStrokeSpeed_m_per_s = 0.5;
  const std::vector<experiments::StudyProblem> problems =
      device_problems(study_file, device, profile, kStrokeSpeed_m_per_s);
  if (problems.empty()) return;
  std::fprintf(stderr, "jnd: caution: %s; the session goes on, and the force is cut\n",
               to_string(problems.front()).c_str());
  if (problems.size() == 1) return;
  std::fprintf(stderr,
               "jnd: caution: %zu more of these; `jnd validate --device %s` tells all\n",
               problems.size() - 1, device.c_str());
}

void warn_of_lookalike(const core::StudyStore& store, const std::string& participant) {
  std::vector<std::string> taken;
  for (const core::SessionRow& row : store.sessions()) taken.push_back(row.participant);
  const std::string like = lookalike(participant, taken);
  if (like.empty()) return;
  std::fprintf(stderr,
               "jnd: --participant: %s looks like %s, who has a session in this study; if it "
               "is the same person, exclude this one's trials\n",
               participant.c_str(), like.c_str());
}

/// Nothing arms a real device but somebody who says so, and nobody does whose stop is pressed.
void require_arming(const RunOptions& options, const std::string& device, double rate_hz) {
  if (device::make_device(device, rate_hz)->capabilities().simulated) return;
  if (options.arm) return require_stop_released(stops_folder(), device, options.releases_stop);
  throw UsageError(
      "--device " + device +
      ": expected --arm for a device that can hurt somebody, found none; it starts "
      "disarmed");
}

int run_run(RunOptions options) {
  (void)fitting_given(options.fitting);
  require_device(options.device);
  require_pseudonym(options.participant);
  const std::filesystem::path file = user_or_shipped(options.file, "protocols");
  const experiments::Study study = experiments::read_study(file);
  require_language(study, options.language);
  const WantedStreams streams = streams_given(options.streams);
  if (!options.headless) {
    require_sound_fits(study, options.sound);
    require_streams_fit(streams, /*is_realtime=*/true, study, options.folder);
    require_markers_fit(options.markers, /*is_realtime=*/true, /*has_window=*/true);
    return open_window({.study_folder = options.folder,
                        .study_file = file,
                        .participant = options.participant,
                        .device = options.device,
                        .device_profile = options.profile,
                        .seed = options.seed,
                        .pilot = options.pilot,
                        .allow_no_realtime = options.allow_no_realtime,
                        .language = options.language,
                        .fields = fields_or_none(study, options.fields),
                        .fitting = fitting_given(options.fitting),
                        .participant_stop = options.participant_stop,
                        .participant_holds = options.participant_holds,
                        .streams = streams,
                        .markers = markers_given(options.markers),
                        .answer_port = options.markers.answer_port,
                        .answer_baud = options.markers.answer_baud,
                        .sound_output = options.sound});
  }
  experiments::FieldValues fields = fields_given(study, options.fields);
  require_device_moves_by_itself(options.device, "--device " + options.device);
  require_device_holds(options.device, study.device.rate_hz, study.device.min_contact_points);
  require_arming(options, options.device, study.device.rate_hz);
  require_device_starts(options.device, study.device.rate_hz);
  const std::optional<KnownProfile> profile =
      profile_for(options.device, options.profile, study);
  warn_of_device_problems(file, options.device, profile);
  options.realtime |= has_own_clock(options.device);
  require_streams_fit(streams, options.realtime, study, options.folder);
  require_markers_fit(options.markers, options.realtime, /*has_window=*/false);
  const experiments::Laboratory laboratory = experiments::read_laboratory(user_or_shipped(
      options.laboratory.empty() ? default_laboratory(options.device) : options.laboratory,
      "data/laboratories"));
  core::StudyStore store(options.folder, core::StudyStore::Mode::kCreate);
  warn_of_lookalike(store, options.participant);
  if (const std::string remark = ended_study_remark(store); !options.pilot && !remark.empty()) {
    std::fprintf(stderr, "jnd: %s\n", remark.c_str());
  }
  const std::vector<std::int64_t> sessions =
      add_sessions(store,
                   {.study = study,
                    .laboratory = &laboratory,
                    .study_file = file,
                    .device = options.device,
                    .profile = profile ? &*profile : nullptr,
                    .seed = options.seed.value_or(std::random_device{}()),
                    .pilot = options.pilot,
                    .realtime = options.realtime,
                    .allow_no_realtime = options.allow_no_realtime,
                    .fields = std::move(fields)},
                   {options.participant});
  return run_session(options, store, study, laboratory, sessions.front());
}

/// The session that was asked for, or the open one; none if everything is finished.
std::optional<core::SessionRow> session_to_resume(const core::StudyStore& store,
                                                  const RunOptions& options) {
  if (options.session) {
    core::SessionRow row = store.session(*options.session);
    return store.finished(row.session) ? std::nullopt : std::optional(std::move(row));
  }
  std::optional<core::SessionRow> open;
  std::string others;
  for (core::SessionRow& row : store.sessions()) {
    if (store.finished(row.session)) continue;
    if (open) others += ", " + std::to_string(row.session) + " (" + row.participant + ")";
    if (!open) open = std::move(row);
  }
  if (others.empty()) return open;
  throw UsageError("resume: expected --session to say which, found several that are open in " +
                   options.folder + ": " + std::to_string(open->session) + " (" +
                   open->participant + ")" + others);
}

/// The session's own laboratory, because a session of two laboratories would have no valid
/// result.
experiments::Laboratory laboratory_of(const RunOptions& options, const core::SessionRow& row) {
  if (!options.laboratory.empty()) {
    const experiments::Laboratory asked =
        experiments::read_laboratory(user_or_shipped(options.laboratory, "data/laboratories"));
    if (asked.text != row.laboratory) {
      throw core::Error(options.laboratory + ": expected the laboratory that session " +
                        std::to_string(row.session) +
                        " was begun in, found another or a changed one; leave --laboratory "
                        "away");
    }
  }
  return experiments::parse_laboratory(row.laboratory, options.folder + ": laboratory");
}

/// Waits until the device tells what it can do.
void wait_for_device(const RunOptions& options, const core::SessionRow& row) {
  DeviceWait wait(options.wait_s);
  stop_on_signals();
  while (true) {
    try {
      (void)device::make_device(row.device, row.rate_hz);
      return;
    } catch (const device::DeviceUnreachable& problem) {
      try {
        wait.over(problem);
      } catch (const device::DeviceUnreachable& at_last) {
        throw EnvironmentError(at_last.what());
      }
    }
  }
}

/// Requires the same profile, except for a session that is only to be ended, which needs
/// nothing of its device.
void require_same_profile(const RunOptions& options, const core::StudyStore& store,
                          const core::SessionRow& row, const experiments::Study& study) {
  if (options.choose == "end") return;
  const DeviceOfProfile device = device_of_profile(row.device, row.rate_hz);
  const std::string refused = refused_resume_words(store, row, study, device, options.profile,
                                                   profile_folders(), today());
  if (!refused.empty()) throw core::Error(refused);
}

int resume_headless(RunOptions options, core::StudyStore& store, const core::SessionRow& row) {
  const experiments::Study study = stored_study(store, row.session);
  wait_for_device(options, row);
  require_same_profile(options, store, row, study);
  require_arming(options, row.device, row.rate_hz);
  require_device_starts(row.device, row.rate_hz);
  require_device_moves_by_itself(row.device, "session " + std::to_string(row.session));
  options.realtime |= has_own_clock(row.device);
  require_streams_fit(streams_given(options.streams), options.realtime, study, options.folder);
  require_markers_fit(options.markers, options.realtime, /*has_window=*/false);
  if (const std::string remark = changed_study_remark(store, row); !remark.empty()) {
    std::fprintf(stderr, "jnd: %s\n", remark.c_str());
  }
  const experiments::Laboratory laboratory = laboratory_of(options, row);
  return run_session(options, store, study, laboratory, row.session);
}

int resume(const RunOptions& options) {
  std::optional<core::StudyStore> store(std::in_place, options.folder,
                                        core::StudyStore::Mode::kReadWrite);
  const std::optional<core::SessionRow> row = session_to_resume(*store, options);
  if (!row) {
    // A program that reads acknowledgements must read nothing else.
    std::fprintf(options.acknowledge ? stderr : stdout,
                 "%s: nothing to resume, every session is finished\n", options.folder.c_str());
    return kDone;
  }
  if (options.headless) return resume_headless(options, *store, *row);
  const WantedStreams streams = streams_given(options.streams);
  require_sound_fits(stored_study(*store, row->session), options.sound);
  require_streams_fit(streams, /*is_realtime=*/true, stored_study(*store, row->session),
                      options.folder);
  require_markers_fit(options.markers, /*is_realtime=*/true, /*has_window=*/true);
  // The window opens the study itself.
  store.reset();
  return open_window({.study_folder = options.folder,
                      .device_profile = options.profile,
                      .participant_stop = options.participant_stop,
                      .participant_holds = options.participant_holds,
                      .streams = streams,
                      .markers = markers_given(options.markers),
                      .answer_port = options.markers.answer_port,
                      .answer_baud = options.markers.answer_baud,
                      .sound_output = options.sound,
                      .resume_session = row->session});
}

void add_participant_stop(CLI::App& command, RunOptions& options) {
  CLI::Option* key = command.add_option(
      "--participant-stop", options.participant_stop,
      "In the window: key, or pedal or button that counts as one, that the participant presses "
      "to stop");
  key->check(CLI::IsMember({"F10", "F11", "F12"}))->excludes("--headless");
  command
      .add_flag("--participant-holds", options.participant_holds,
                "Force only while the participant holds it down")
      ->needs(key);
}

/// These options need --headless, because in a window the experimenter arms a real device by a
/// key.
void add_headless_options(CLI::App& command, RunOptions& options) {
  CLI::Option* headless = command.add_flag("--headless", options.headless,
                                           "Without a window, participant simulated");
  command.add_flag("--arm", options.arm,
                   "With --headless: a real device may give force, and somebody is beside it");
  add_release_stop_option(command, options.releases_stop);
  command
      .add_flag("--shadow-guards", options.shadow_guards,
                "With --headless: guards of the loop only count what they would have done; "
                "energy that a real device gives stays a fault")
      ->needs(headless);
}

}  // namespace

HelpPlace place_of_run() { return {HelpGroup::kRunning, 10}; }

void add_run(CLI::App& program, Invocation& invocation) {
  CLI::App* command = program.add_subcommand("run", "Run a session");
  invocation.examples[command] = {
      {"jnd run my_study.json --study my_study.study --participant P01",
       "opens the window at the preparation of this session"},
      {"jnd run short_tour --study tour.study --participant P01 --headless",
       "one session without a window, the participant simulated"}};
  const auto options = std::make_shared<RunOptions>();
  command->add_option("FILE", options->file, "Study file, or the name of a shipped study")
      ->required();
  command->add_option("--study", options->folder, "Study folder, NAME.study, made if absent")
      ->required();
  command->add_option("--participant", options->participant, "Pseudonym, for example P01")
      ->required();
  command->add_option("--device", options->device, "See `jnd devices`")->capture_default_str();
  add_profile_option(*command, options->profile);
  command->add_option("--seed", options->seed, "Of the study; drawn if not given")
      ->check(seed_number());
  add_field_option(*command, options->fields,
                   "What the participant brings, as the study's participant_fields ask");
  add_fitting_option(*command, options->fitting);
  command->add_option("--language", options->language,
                      "Of the texts, for example de; default: the study's first");
  command->add_flag("--pilot", options->pilot, "Marked as pilot and left out of results");
  command->add_flag("--allow-no-realtime", options->allow_no_realtime,
                    "Run a real device without real-time rights");
  add_headless_options(*command, *options);
  add_participant_stop(*command, *options);
  add_stream_options(*command, options->streams);
  add_sound_option(*command, options->sound)->excludes("--headless");
  add_marker_options(*command, options->markers);
  command->add_option("--laboratory", options->laboratory,
                      "Of the simulated participant; default: thesis, or thesis_exoskeleton "
                      "with that device");
  command->add_flag("--realtime", options->realtime,
                    "Paced by the clock, not as fast as it goes");
  command->add_flag("--acknowledge", options->acknowledge,
                    "Print EVENT SEQUENCE KIND after each durable commit");
  command->callback(
      [&invocation, options] { invocation.run = [options] { return run_run(*options); }; });
}

HelpPlace place_of_resume() { return {HelpGroup::kRunning, 30}; }

void add_resume(CLI::App& program, Invocation& invocation) {
  CLI::App* command =
      program.add_subcommand("resume", "Go on with a session that was interrupted");
  invocation.examples[command] = {
      {"jnd resume my_study.study", "goes on with the trial that was interrupted"}};
  const auto options = std::make_shared<RunOptions>();
  options->laboratory.clear();
  options->wait_s = 60.0;
  command
      ->add_option(
          "--wait-s", options->wait_s,
          "With --headless: how long to wait for a device that is elsewhere to be there "
          "and for its link to be good")
      ->check(number_between(0.0, 86'400.0))
      ->capture_default_str();
  command->add_option("DIR", options->folder, "Study folder, NAME.study")
      ->required()
      ->check(CLI::ExistingDirectory);
  add_profile_option(*command, options->profile);
  command->add_option("--session", options->session, "Default: the open one")
      ->check(whole_number(1, std::numeric_limits<std::int64_t>::max()));
  command
      ->add_option("--choose", options->choose,
                   "repeat the interrupted trial, restart its block, or end the session")
      ->check(CLI::IsMember({"repeat", "restart", "end"}))
      ->capture_default_str();
  add_headless_options(*command, *options);
  add_participant_stop(*command, *options);
  add_stream_options(*command, options->streams);
  add_sound_option(*command, options->sound)->excludes("--headless");
  add_marker_options(*command, options->markers);
  command->add_option("--laboratory", options->laboratory,
                      "Of the simulated participant; default: the session's own");
  command->add_flag("--realtime", options->realtime, "Paced by the clock");
  command->add_flag("--acknowledge", options->acknowledge,
                    "Print EVENT SEQUENCE KIND after each durable commit");
  command->callback(
      [&invocation, options] { invocation.run = [options] { return resume(*options); }; });
}

}  // namespace jnd::app
