#include <chrono>
#include <csignal>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>

#include "chaos/door_devices.h"
#include "chaos/told_events.h"
#include "chaos/worlds.h"
#include "support/files.h"
#include "support/places.h"
#include "support/temporary_folder.h"

namespace jnd::chaos {
namespace {

namespace fs = std::filesystem;
using test_support::ProgramOutcome;
using test_support::RunningProgram;

/// A machine that is too busy for real time interrupts a session as well. But this many times
/// in a row without another answer are no longer a machine's fault.
constexpr int kMostTries = 20;
constexpr int kEnvironmentLacks = 3;  ///< Exit code if this machine or device lacks something.
/// Time until a program that was started gives force.
constexpr std::chrono::seconds kLongestWait(30);

/// Two trials of some seconds. Ticks that a busy machine misses are no reason to repeat one.
constexpr const char* kStudy = R"({
  "format": 1, "name": "doors", "languages": ["en"], "title": {"en": "Doors"},
  "description": {"en": "A session of seconds."}, "authors": ["jnd"],
  "device": {"min_contact_points": 1, "rate_hz": 1000, "ramp_s": 0.05, "max_missed_ratio": 1},
  "stages": [
    {"kind": "block", "name": "estimation", "title": {"en": "Estimate"},
     "procedure": "magnitude_estimation", "medium": "viscous", "viscosity_pa_s": [8, 20],
     "repetitions": 1, "expected_trial_s": 2,
     "instruction": {"en": "Estimate."}, "question": {"en": "How strong?"}}]})";

/// Returns a person with less patience than the shipped one. The person makes one short stroke,
/// and does not wait long for a hand that does not report its strokes, as behind a server.
std::string hasty_laboratory(Door door) {
  auto laboratory = nlohmann::ordered_json::parse(
      std::ifstream(test_support::source_folder() / "data/laboratories/thesis.json"));
  laboratory["arm"]["home_s"]["value"] = 0.2;
  auto& strokes = laboratory["strokes"]["magnitude_estimation"];
  strokes["amplitude_m"]["value"] = door == Door::kServedDriver ? 0.02 : 0.06;
  strokes["strokes_per_presentation"]["value"] = 1;
  return laboratory.dump();
}

std::int64_t now_ns() {
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  return std::int64_t{1'000'000'000} * now.tv_sec + now.tv_nsec;
}

void pause(int milliseconds) {
  std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
}

/// Plays one session of the real program in real time, on a device in another process.
class DoorWorld {
 public:
  explicit DoorWorld(const DoorSchedule& schedule)
      : schedule_(schedule), device_(schedule, temporary_.path()) {
    test_support::write_file(temporary_.path() / "doors.json", kStudy);
    test_support::write_file(temporary_.path() / "laboratory.json",
                             hasty_laboratory(schedule.door));
  }

  Outcome play() {
    if (is_networked(schedule_.door)) serve();
    for (const DoorEvent& event : schedule_.events) {
      if (!violation_.empty()) break;
      if (event.is_at_once ? !is_running() : !comes_to_force(event.after_ms)) continue;
      meet(event);
    }
    if (schedule_.wrong.empty()) {
      while (violation_.empty() && !is_complete_) run_to_its_end();
      judge_study();
    }
    return judged_forces();
  }

 private:
  [[nodiscard]] fs::path study() const { return temporary_.path() / "a.study"; }
  [[nodiscard]] bool is_running() const { return program_ && !program_->has_ended(); }

  [[nodiscard]] std::vector<std::string> next_words() const {
    // A session that was begun is resumed, as a person would do.
    if (told_.has_session()) {
      return {"resume", study(), "--headless", "--acknowledge", "--realtime", "--wait-s", "10"};
    }
    const fs::path& folder = temporary_.path();
    return {"run",           folder / "doors.json",
            "--study",       study(),
            "--participant", "P01",
            "--seed",        std::to_string(schedule_.seed % 1'000'000),
            "--laboratory",  folder / "laboratory.json",
            "--headless",    "--acknowledge",
            "--realtime",    "--device",
            device_.words()};
  }

  void start() {
    look_after_server();
    had_force_ = false;
    device_.await_force();
    happenings_.program_starts_ns.push_back(now_ns());
    note("the program was started");
    program_.emplace(next_words(), device_.options());
  }

  /// Call it after the program has ended by itself or was killed.
  void take_end(bool was_killed) {
    const ProgramOutcome ended = program_->wait();
    program_.reset();
    const std::size_t num_told = told_.size();
    told_.take(ended);
    note("the program ended with " + std::to_string(ended.exit_code) + ", signal " +
         std::to_string(ended.signal) + ", after " + std::to_string(told_.size()) +
         " events: " + ended.err);
    const bool may_go_on = ended.exit_code == 1 || ended.exit_code == kEnvironmentLacks;
    if (ended.exit_code == 0) {
      is_complete_ = true;
    } else if (!was_killed && !may_go_on) {
      violated("it ended with " + std::to_string(ended.exit_code) + ", signal " +
               std::to_string(ended.signal) + ": " + ended.err);
    } else {
      num_tries_ = told_.size() > num_told + kEventsOfAStart ? 0 : num_tries_ + 1;
      if (num_tries_ > kMostTries) violated("it does not come to its end: " + ended.err);
    }
  }

  /// Waits until a running program gives force, and for this long after that. Returns false if
  /// the session is over.
  bool comes_to_force(int and_then_ms) {
    auto deadline = std::chrono::steady_clock::now() + kLongestWait;
    while (violation_.empty()) {
      if (!program_) {
        if (is_complete_) return false;
        start();
        deadline = std::chrono::steady_clock::now() + kLongestWait;
      }
      if (program_->has_ended()) {
        take_end(false);
      } else if (device_.has_new_force()) {
        had_force_ = true;
        pause(and_then_ms);
        if (is_running()) return true;
      } else if (std::chrono::steady_clock::now() >= deadline) {
        violated("there was no force, and no end");
      } else {
        look_after_server();
        pause(1);
      }
    }
    return false;
  }

  void run_to_its_end() {
    if (!program_) start();
    while (!program_->has_ended()) {
      look_after_server();
      pause(5);
    }
    take_end(false);
  }

  /// A server that finds its driver gone or unplugged may end and say so. Then somebody starts
  /// it again.
  void look_after_server() {
    const std::optional<ProgramOutcome> ended = device_.ended_server();
    if (!ended) return;
    note("the server ended: " + ended->err);
    if (ended->exit_code != kEnvironmentLacks || schedule_.door != Door::kServedDriver) {
      violated("the server ended with " + std::to_string(ended->exit_code) + ", signal " +
               std::to_string(ended->signal) + ": " + ended->err);
    }
    serve();
  }

  void meet(const DoorEvent& event) {
    met_ = name(event.what);
    note(met_);
    switch (event.what) {
      case DoorTrouble::kProgramKilled:
        return kill_program(event);
      case DoorTrouble::kProgramStopped:
        return stop_program(event);
      case DoorTrouble::kServerKilled:
        return kill_server(event);
      case DoorTrouble::kServerStopped:
        return stop_server(event);
      case DoorTrouble::kHostKilled:
        return kill_host(event);
      case DoorTrouble::kHostStopped:
        return stop_host(event);
      case DoorTrouble::kUnplugged:
        return unplug(event);
      case DoorTrouble::kAllStopped:
        return stop_all(event);
    }
  }

  void kill_program(const DoorEvent& event) {
    program_->send_signal(SIGKILL);
    take_end(true);
    revoke({.cause = "the program was killed",
            .from_ns = now_ns(),
            .within_ms = device_.force_ends_within_ms(),
            .clock = clock_of_the_door()});
    if (!event.is_resumed_at_once) {
      pause(device_.force_ends_within_ms() + 100 + event.lasts_ms / 4);
    }
  }

  void stop_program(const DoorEvent& event) {
    program_->send_signal(SIGSTOP);
    const std::int64_t from_ns = now_ns();
    pause(event.lasts_ms);
    const std::int64_t until_ns = now_ns();
    program_->send_signal(SIGCONT);
    revoke_of_this_program({.cause = "the program was stopped",
                            .from_ns = from_ns,
                            .within_ms = device_.force_ends_within_ms(),
                            .clock = clock_of_the_door(),
                            .over_by_ns = until_ns});
  }

  void kill_server(const DoorEvent& event) {
    if (!device_.is_served()) return;
    device_.kill_server();
    // A driver outlives its server for a moment, and ends the force by itself.
    revoke_of_this_program(
        {.cause = "the server was killed",
         .from_ns = now_ns(),
         .within_ms = has_driver(schedule_.door) ? device_.driver_force_ends_within_ms() : 0});
    pause(event.lasts_ms);
    serve();
  }

  void stop_server(const DoorEvent& event) {
    if (!device_.is_served()) return;
    device_.signal_server(SIGSTOP);
    const std::int64_t from_ns = now_ns();
    pause(event.lasts_ms);
    const std::int64_t until_ns = now_ns();
    device_.signal_server(SIGCONT);
    if (until_ns - from_ns < 1'000'000ll * device_.longest_pause_ms()) return;
    revoke_of_this_program({.cause = "the server stood still",
                            .from_ns = until_ns,
                            .clock = Revocation::Clock::kRecords});
  }

  void kill_host(const DoorEvent& event) {
    const pid_t host = device_.host();
    if (host < 0) return;
    ::kill(host, SIGKILL);
    while (device_.host() == host) pause(1);
    revoke_of_this_program({.cause = "the driver's process was killed", .from_ns = now_ns()});
    pause(event.lasts_ms);
  }

  void stop_host(const DoorEvent& event) {
    const pid_t host = device_.host();
    if (host < 0) return;
    ::kill(host, SIGSTOP);
    const std::int64_t from_ns = now_ns();
    pause(event.lasts_ms);
    const std::int64_t until_ns = now_ns();
    ::kill(host, SIGCONT);
    if (until_ns - from_ns < 1'000'000ll * device_.driver_force_ends_within_ms()) return;
    // This leaves some moments for its threads to wake.
    revoke_of_this_program(
        {.cause = "the driver's process stood still", .from_ns = until_ns, .within_ms = 10});
  }

  /// Whichever runs first afterwards finds what the other said before.
  void stop_all(const DoorEvent& event) {
    const pid_t host = device_.host();
    const auto signal_device = [&](int number) {
      if (host > 0) ::kill(host, number);
      if (device_.is_served()) device_.signal_server(number);
    };
    program_->send_signal(SIGSTOP);
    signal_device(SIGSTOP);
    const std::int64_t from_ns = now_ns();
    pause(event.lasts_ms);
    const std::int64_t until_ns = now_ns();
    if (event.is_resumed_at_once) program_->send_signal(SIGCONT);
    signal_device(SIGCONT);
    program_->send_signal(SIGCONT);
    if (until_ns - from_ns < 1'000'000ll * device_.force_ends_within_ms()) return;
    revoke_of_this_program({.cause = "everything stood still",
                            .from_ns = until_ns,
                            .within_ms = has_driver(schedule_.door) ? 10 : 0,
                            .clock = clock_of_the_door()});
  }

  void unplug(const DoorEvent& event) {
    device_.plug_in(false);
    const std::int64_t from_ns = now_ns();
    pause(event.lasts_ms);
    const std::int64_t until_ns = now_ns();
    device_.plug_in(true);
    revoke_of_this_program({.cause = "the device was unplugged",
                            .from_ns = from_ns,
                            .within_ms = device_.driver_force_ends_within_ms(),
                            .over_by_ns = until_ns});
  }

  /// Behind a server, the driver's process runs on although the server may not.
  [[nodiscard]] Revocation::Clock clock_of_the_door() const {
    return schedule_.door == Door::kServedDriver ? Revocation::Clock::kRecords
                                                 : Revocation::Clock::kBeats;
  }

  void revoke(const Revocation& revocation) { happenings_.revocations.push_back(revocation); }
  /// A program that has not given force yet may begin to after whatever happened to the device.
  void revoke_of_this_program(const Revocation& revocation) {
    if (had_force_) revoke(revocation);
  }

  void serve() {
    for (int i = 0; i < kMostTries; ++i) {
      if (device_.serve()) return;
      pause(50);
    }
    violated("the server did not start");
  }

  void judge_study() {
    if (!violation_.empty()) return;
    const std::string problem = told_.problem(device_.options());
    if (!problem.empty()) return violated(problem);
    if (!told_.session_is_complete()) violated("the session has no end");
  }

  Outcome judged_forces() {
    Happenings happenings = device_.promised();
    happenings.program_starts_ns = happenings_.program_starts_ns;
    happenings.revocations = happenings_.revocations;
    Outcome outcome{.violation = violation_};
    for (const ForceLog& log : device_.logs()) {
      outcome.num_milliseconds_with_force += milliseconds_with_force(log);
      if (outcome.violation.empty()) outcome.violation = judged(log, happenings);
    }
    outcome.story = story_;
    return outcome;
  }

  /// If a schedule is played again, that is another run. So the report includes what happened
  /// in this one.
  void note(std::string what) {
    while (what.ends_with('\n')) what.pop_back();
    const std::int64_t since_ns =
        happenings_.program_starts_ns.empty() ? 0 : now_ns() - happenings_.program_starts_ns[0];
    story_ += "  " + std::to_string(since_ns / 1'000'000) + " ms: " + what + "\n";
  }

  void violated(const std::string& what) {
    if (violation_.empty()) violation_ = "the program after " + met_ + ": " + what;
  }

  /// A program reports this many even if it gets no further.
  static constexpr std::size_t kEventsOfAStart = 3;

  const DoorSchedule& schedule_;
  test_support::TemporaryFolder temporary_{test_support::memory_folder()};
  DoorDevice device_;
  ToldEvents told_{study()};
  std::optional<RunningProgram> program_;
  Happenings happenings_;
  bool had_force_ = false;  ///< Whether this program had force.
  bool is_complete_ = false;
  int num_tries_ = 0;
  std::string met_ = "nothing", story_;
  std::string violation_;
};

}  // namespace

Outcome played_through_a_door(const DoorSchedule& schedule) {
  if (!DoorTools::here().has(schedule.door)) return {.was_played = false};
  return DoorWorld(schedule).play();
}

}  // namespace jnd::chaos
