// Runs a session in real time with streams, pulses, a pedal and sound at once, and alternately
// the same session alone. Everything else of a laboratory is imitated here: a recorder of
// streams, an amplifier whose stream is recorded, a box of pulses and a box of answers at
// pseudo-terminals, and ALSA's output `null`. Prints JSON. The exit code is 0 if everything
// held, 1 if something did not, and 2 for wrong usage or if a session could not be run.

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "bench/laboratory_session.h"
#include "core/clock_offsets.h"
#include "core/storage/recording.h"
#include "core/storage/stream_file.h"
#include "core/storage/study_store.h"
#include "core/streams/loopback_network.h"
#include "core/streams/stream_outlet.h"
#include "core/streams/stream_search.h"
#include "support/files.h"
#include "support/program.h"
#include "support/pseudo_terminal.h"
#include "support/temporary_folder.h"

namespace jnd::bench {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test_support::PseudoTerminal;
using test_support::RunningProgram;

constexpr double kMostLatenessRatio = 1.05;
constexpr double kMostTimeError_s = 0.0002;
constexpr double kAmplifierRate_hz = 500.0;
constexpr std::int64_t kAmplifierBatch = 10;

double steady_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

void sleep_until_s(double time_s) {
  const double left_s = time_s - steady_s();
  if (left_s > 0.0) std::this_thread::sleep_for(std::chrono::duration<double>(left_s));
}

double percentile(std::vector<double> values, double ratio) {
  if (values.empty()) return 0.0;
  std::ranges::sort(values);
  return values[static_cast<std::size_t>(ratio * static_cast<double>(values.size() - 1))];
}

json summary_ms(const std::vector<double>& values_s) {
  return {{"number", values_s.size()},
          {"p50_ms", 1e3 * percentile(values_s, 0.5)},
          {"p99_ms", 1e3 * percentile(values_s, 0.99)},
          {"max_ms", 1e3 * percentile(values_s, 1.0)}};
}

/// How late ticks were, as sessions store it: upper ends of buckets, and counts.
struct Lateness {
  std::map<double, double> num_up_to_us;
  double missed_ticks = 0.0, dropped_samples = 0.0;

  void add(const Lateness& other) {
    for (const auto& [us, count] : other.num_up_to_us) num_up_to_us[us] += count;
    missed_ticks += other.missed_ticks;
    dropped_samples += other.dropped_samples;
  }
  [[nodiscard]] double percentile_us(double ratio) const {
    double total = 0.0, seen = 0.0;
    for (const auto& [us, count] : num_up_to_us) total += count;
    for (const auto& [us, count] : num_up_to_us) {
      seen += count;
      if (seen >= ratio * total) return us;
    }
    return 0.0;
  }
  [[nodiscard]] json told() const {
    return {{"p50_us", percentile_us(0.5)},
            {"p99_us", percentile_us(0.99)},
            {"p999_us", percentile_us(0.999)},
            {"missed_ticks", missed_ticks},
            {"dropped_samples", dropped_samples}};
  }
};

/// The findings of rounds with everything; sums and lists over rounds.
struct Findings {
  std::int64_t num_recorded = 0, num_streamed = 0, num_lost_streamed = 0, num_unrecorded = 0;
  std::vector<double> stream_errors_s;  ///< Largest error of each second.
  std::int64_t num_markers = 0;
  std::int64_t num_pulses_stored = 0, num_pulses_received = 0;
  std::vector<double> pulse_delays_s;  ///< Delay from the stored beginning of the writing.
  std::int64_t num_amplified = 0, num_lost_amplified = 0;
  std::vector<double> amplifier_errors_s;
  std::vector<double> press_to_read_s, press_to_stored_s;
  std::int64_t num_sound_gaps = 0, num_lost_cues = 0;
  std::int64_t num_sound_frames = 0;
  std::vector<std::string> problems;
};

/// Repeats something in a thread until it is destroyed.
class Beside {
 public:
  explicit Beside(std::function<void()> once)
      : thread_([once = std::move(once)](const std::stop_token& stop) {
          while (!stop.stop_requested()) once();
        }) {}

 private:
  std::jthread thread_;
};

/// The recorder and the instruments around a session.
class Laboratory {
 public:
  Laboratory()
      : name_("amplifier " + core::new_stream_uid()),
        amplifier_(core::open_own_outlet({.name = name_,
                                          .type = "EEG",
                                          .channel_count = 8,
                                          .nominal_rate_hz = kAmplifierRate_hz,
                                          .format = core::ChannelFormat::kInt32,
                                          .source_id = name_},
                                         network())) {
    network_ = network();
    next_sent_s_ = core::stream_clock_s();
    amplifying_ = std::make_unique<Beside>([this] { amplify(); });
    pulsed_ = std::make_unique<Beside>([this] { take_pulse(); });
  }

  [[nodiscard]] std::vector<std::string> words() const {
    return {markers_.path(), answers_.path(), name_};
  }
  /// Called when the session has begun: recording begins and pedals are pressed.
  void begin(const std::string& study_id) {
    begun_s_ = steady_s() + 1.0;
    samples_ = listen("samples", study_id);
    marker_stream_ = listen("markers", study_id);
    recording_ = std::make_unique<Beside>([this] { record(); });
    pressing_ = std::make_unique<Beside>([this] { press(); });
  }
  void end() {
    pressing_.reset();
    recording_.reset();
    take_samples();
    amplifying_.reset();
    pulsed_.reset();
  }

  [[nodiscard]] const std::vector<double>& answers_s() const noexcept { return answers_s_; }
  [[nodiscard]] const std::vector<std::pair<int, double>>& pulses() const noexcept {
    return pulses_;
  }
  /// Returns times of samples by our clock, as a reader of the recorder's file would get them.
  [[nodiscard]] std::vector<double> streamed_s() const {
    const core::ClockCorrection correction(offsets_);
    std::vector<double> times_s = streamed_s_;
    for (double& time_s : times_s) time_s = correction.corrected_s(time_s);
    return times_s;
  }
  [[nodiscard]] std::int64_t num_markers() const noexcept { return num_markers_; }

 private:
  static core::StreamNetwork network() {
    core::StreamNetwork network = core::loopback_network();
    network.session_id = "default";
    return network;
  }
  [[nodiscard]] std::unique_ptr<core::StreamInlet> listen(const std::string& kind,
                                                          const std::string& id) const {
    const auto found = core::find_streams(
        network_, core::query_for(network_, "source_id", "jnd-" + kind + "-" + id + "-1"), 10.0,
        1);
    if (found.empty()) throw std::runtime_error("the stream of " + kind + " was not found");
    return core::open_own_inlet(found[0], network_);
  }
  void amplify() {
    std::vector<core::StreamSample> batch;
    for (std::int64_t i = 0; i < kAmplifierBatch; ++i, ++num_sent_) {
      const auto number = static_cast<std::int32_t>(num_sent_);
      std::string values(8 * sizeof number, '\0');
      std::memcpy(values.data(), &number, sizeof number);
      batch.push_back({.time_s = next_sent_s_, .values = std::move(values), .texts = {}});
      next_sent_s_ += 1.0 / kAmplifierRate_hz;
    }
    amplifier_->push(batch);
    sleep_until_s(next_sent_s_);
  }
  void take_pulse() {
    pollfd waits{.fd = markers_.descriptor(), .events = POLLIN, .revents = 0};
    if (::poll(&waits, 1, 50) <= 0) return;
    unsigned char byte = 0;
    // The other end is not open yet, or no longer.
    if (::read(markers_.descriptor(), &byte, 1) != 1) {
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    } else if (byte != 0) {
      pulses_.emplace_back(byte, steady_s());
    }
  }
  void record() {
    take_samples();
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  void take_samples() {
    for (const core::StreamSample& one : samples_->take_samples()) {
      streamed_s_.push_back(one.time_s);
    }
    for (const core::ClockOffset& offset : samples_->take_offsets()) offsets_.push_back(offset);
    num_markers_ += static_cast<std::int64_t>(marker_stream_->take_samples().size());
    (void)marker_stream_->take_offsets();
  }
  void press() {
    const auto& next = kLaboratoryPresses[num_presses_ % std::size(kLaboratoryPresses)];
    const auto cycle = static_cast<double>(num_presses_ / std::size(kLaboratoryPresses));
    const double due_s = begun_s_ + cycle * kLaboratoryCycle_s + next.at_s;
    if (steady_s() < due_s) {
      sleep_until_s(std::min(due_s, steady_s() + 0.05));
      return;
    }
    ++num_presses_;
    if (std::string_view(next.action) == kAnswerAction) answers_s_.push_back(steady_s());
    answers_.send({next.byte});
  }

  PseudoTerminal markers_, answers_;
  std::string name_;
  core::StreamNetwork network_;
  std::unique_ptr<core::StreamOutlet> amplifier_;
  double next_sent_s_ = 0.0, begun_s_ = 0.0;
  std::int64_t num_sent_ = 0, num_markers_ = 0;
  std::size_t num_presses_ = 0;
  std::unique_ptr<core::StreamInlet> samples_, marker_stream_;
  std::vector<double> streamed_s_, answers_s_;
  std::vector<core::ClockOffset> offsets_;
  std::vector<std::pair<int, double>> pulses_;  ///< Code, and time of arrival.
  std::unique_ptr<Beside> amplifying_, pulsed_, recording_, pressing_;
};

/// Returns what the session stored about its loop and its rights.
Lateness stored_lateness(const core::StudyStore& store, std::string& scheduler) {
  Lateness lateness;
  for (const core::EventRow& event : store.events(1)) {
    if (event.kind == "loop_started") {
      scheduler = json::parse(event.data).at("scheduler").get<std::string>();
    }
    if (event.kind != "loop_measured") continue;
    const json told = json::parse(event.data);
    lateness = {.num_up_to_us = {},
                .missed_ticks = told.at("missed_ticks"),
                .dropped_samples = told.at("num_dropped_samples")};
    for (const json& bucket : told.at("lateness_ns")) {
      lateness.num_up_to_us[1e-3 * bucket.at(0).get<double>()] += bucket.at(1).get<double>();
    }
  }
  return lateness;
}

/// Compares the recorder's samples with our own recording, tick by tick.
void compare_streamed(const core::StudyStore& store, const Laboratory& laboratory,
                      Findings& found) {
  const core::RecordingReader recording(store.recording_file(1));
  std::vector<double> recorded_s;
  recording.read(0, recording.last_tick(), [&](const core::Sample& sample) {
    recorded_s.push_back(1e-9 * static_cast<double>(sample.monotonic_ns));
  });
  found.num_recorded += static_cast<std::int64_t>(recorded_s.size());
  found.num_unrecorded += recording.missing_ticks();
  const std::vector<double> streamed_s = laboratory.streamed_s();
  found.num_streamed += static_cast<std::int64_t>(streamed_s.size());
  if (streamed_s.empty() || recorded_s.empty()) {
    found.problems.emplace_back("streams: expected samples of the hand, found none");
    return;
  }
  const auto nearest = [&](double time_s) {
    auto at = std::ranges::lower_bound(recorded_s, time_s);
    if (at == recorded_s.end() ||
        (at != recorded_s.begin() && time_s - *(at - 1) < *at - time_s)) {
      --at;
    }
    return at;
  };
  double largest_s = 0.0;
  constexpr std::size_t kSamplesOfASecond = 1000;
  for (std::size_t i = 0; i < streamed_s.size(); ++i) {
    largest_s = std::max(largest_s, std::abs(*nearest(streamed_s[i]) - streamed_s[i]));
    if ((i + 1) % kSamplesOfASecond == 0) {
      found.stream_errors_s.push_back(std::exchange(largest_s, 0.0));
    }
  }
  // The count begins at the first sample for which the recorder was there.
  const auto expected =
      nearest(streamed_s.back()) - nearest(streamed_s.front()) + std::ptrdiff_t{1};
  found.num_lost_streamed +=
      std::abs(expected - static_cast<std::ptrdiff_t>(streamed_s.size()));
  found.num_markers += laboratory.num_markers();
}

void compare_pulses(const core::StudyStore& store, const Laboratory& laboratory,
                    Findings& found) {
  std::vector<std::pair<int, double>> stored;
  for (const core::EventRow& event : store.events(1)) {
    if (event.kind != "markers_sent") continue;
    const json sent = json::parse(event.data);
    for (const json& pulse : sent.at("pulses")) {
      stored.emplace_back(pulse.at(1), pulse.at(2));
    }
  }
  const auto& received = laboratory.pulses();
  found.num_pulses_stored += static_cast<std::int64_t>(stored.size());
  found.num_pulses_received += static_cast<std::int64_t>(received.size());
  for (std::size_t i = 0; i < std::min(stored.size(), received.size()); ++i) {
    if (stored[i].first != received[i].first) {
      found.problems.push_back("pulse " + std::to_string(i) + ": expected the stored code " +
                               std::to_string(stored[i].first) + ", found " +
                               std::to_string(received[i].first));
      return;
    }
    found.pulse_delays_s.push_back(received[i].second - stored[i].second);
  }
}

void compare_amplified(const core::StudyStore& store, Findings& found) {
  for (const fs::path& file : core::stream_files(store.recording_file(1))) {
    const core::StreamFileReader reader(file);
    const core::ClockCorrection correction(reader.offsets());
    std::int64_t first = -1, last = -1, num = 0;
    reader.read([&](const core::StreamSample& sample) {
      std::int32_t number = 0;
      std::memcpy(&number, sample.values.data(), sizeof number);
      if (first < 0) first = number;
      last = number;
      ++num;
      // Both clocks are this machine's, so any correction is an error.
      found.amplifier_errors_s.push_back(
          std::abs(correction.corrected_s(sample.time_s) - sample.time_s));
    });
    found.num_amplified += num;
    found.num_lost_amplified += num == 0 ? 0 : last - first + 1 - num;
  }
}

void compare_answers(const core::StudyStore& store, const Laboratory& laboratory,
                     const std::vector<double>& stored_s, Findings& found) {
  const std::vector<double>& pressed_s = laboratory.answers_s();
  const auto press_before = [&](double time_s) {
    const auto at = std::ranges::upper_bound(pressed_s, time_s);
    return at == pressed_s.begin() ? time_s : *(at - 1);
  };
  for (const core::TrialRow& trial : store.trials(1)) {
    if (!trial.measures.control_monotonic_s) continue;
    const double read_s = *trial.measures.control_monotonic_s;
    found.press_to_read_s.push_back(read_s - press_before(read_s));
  }
  for (const double time_s : stored_s) {
    found.press_to_stored_s.push_back(time_s - press_before(time_s));
  }
}

void look_at_sound(const core::StudyStore& store, Findings& found) {
  json newest;
  for (const core::EventRow& event : store.events(1)) {
    if (event.kind == "sound_measured") newest = json::parse(event.data);
    if (event.kind == "sound_missing") found.problems.push_back("sound: " + event.data);
    if (event.kind == "stream_failed" || event.kind == "markers_failed") {
      found.problems.push_back(event.kind + ": " + event.data);
    }
  }
  if (newest.is_null()) {
    found.problems.emplace_back("sound: expected that it was played, found nothing of it");
    return;
  }
  found.num_sound_gaps += newest.at("num_underruns").get<std::int64_t>();
  found.num_lost_cues += newest.at("num_lost_cues").get<std::int64_t>();
  found.num_sound_frames += newest.at("num_frames").get<std::int64_t>();
}

/// Runs one session, and reports the findings if it ran with everything.
Lateness run_round(double duration_s, Findings* found, std::string& scheduler) {
  const test_support::TemporaryFolder folder(test_support::memory_folder());
  test_support::write_file(folder.path() / "alsa.conf", "pcm.headphones { type null }\n");
  std::vector<std::string> words = {"--session", folder.path().string(),
                                    std::to_string(duration_s)};
  std::unique_ptr<Laboratory> laboratory;
  if (found != nullptr) {
    laboratory = std::make_unique<Laboratory>();
    for (const std::string& word : laboratory->words()) words.push_back(word);
  }
  RunningProgram session(
      words, {.folder = folder.path(),
              .environment = {{"ALSA_CONFIG_PATH", (folder.path() / "alsa.conf").string()},
                              {"JND_SOUND_FILE", (folder.path() / "sound.json").string()},
                              {"XDG_STATE_HOME", folder.path().string()}},
              .program = fs::read_symlink("/proc/self/exe").string()});
  std::vector<double> stored_s;
  while (const auto line = session.read_line()) {
    if (laboratory && line->starts_with("SESSION ")) laboratory->begin(line->substr(8));
    if (!line->starts_with("STORED ")) continue;
    stored_s.push_back(1e-9 * std::stod(line->substr(line->find(' ', 7) + 1)));
  }
  const test_support::ProgramOutcome outcome = session.wait();
  if (laboratory) laboratory->end();
  if (outcome.exit_code != 0) throw std::runtime_error("the session failed: " + outcome.err);
  const core::StudyStore store(folder.path() / "a.study", core::StudyStore::Mode::kReadOnly);
  if (found != nullptr) {
    if (!outcome.err.empty()) found->problems.push_back(outcome.err);
    compare_streamed(store, *laboratory, *found);
    compare_pulses(store, *laboratory, *found);
    compare_amplified(store, *found);
    compare_answers(store, *laboratory, stored_s, *found);
    look_at_sound(store, *found);
  }
  return stored_lateness(store, scheduler);
}

/// Returns what should hold and does not.
std::vector<std::string> judge(const Findings& found, double lateness_ratio) {
  std::vector<std::string> problems = found.problems;
  const auto expect = [&](bool holds, const std::string& words) {
    if (!holds) problems.push_back(words);
  };
  const auto none = [&](const char* what, std::int64_t number) {
    expect(number == 0, std::string(what) + ": expected none, found " + std::to_string(number));
  };
  expect(lateness_ratio <= kMostLatenessRatio,
         "lateness of 99.9 % of ticks: expected at most 1.05 times that of a session alone, "
         "found " +
             std::to_string(lateness_ratio) + " times");
  none("samples that the recorder lost", found.num_lost_streamed);
  none("ticks that our recording lacks", found.num_unrecorded);
  none("samples of the amplifier that were lost", found.num_lost_amplified);
  none("gaps of the sound", found.num_sound_gaps);
  none("cues that were not heard", found.num_lost_cues);
  expect(found.num_pulses_stored == found.num_pulses_received,
         "pulses: expected as many as were stored, " + std::to_string(found.num_pulses_stored) +
             ", found " + std::to_string(found.num_pulses_received));
  for (const auto& [what, errors_s] :
       {std::pair{"the recorder's times", &found.stream_errors_s},
        std::pair{"the amplifier's times", &found.amplifier_errors_s}}) {
    const double worst_s = percentile(*errors_s, 1.0);
    expect(!errors_s->empty() && worst_s <= kMostTimeError_s,
           std::string(what) + ": expected within 0.2 ms of our own, found " +
               std::to_string(1e3 * worst_s) + " ms");
  }
  expect(!found.press_to_stored_s.empty(), "answers: expected some by the pedal, found none");
  return problems;
}

int measure(double minutes, int num_rounds) {
  Lateness with, without;
  Findings found;
  std::string scheduler;
  std::vector<double> ratios;
  for (int round = 0; round < num_rounds; ++round) {
    const double duration_s = 60.0 * minutes / num_rounds;
    Lateness one, alone;
    const auto run_with = [&] { one = run_round(duration_s, &found, scheduler); };
    const auto run_alone = [&] { alone = run_round(duration_s, nullptr, scheduler); };
    // The order alternates, so that neither always comes first, whatever else the machine does.
    if (round % 2 == 0) run_with();
    run_alone();
    if (round % 2 != 0) run_with();
    with.add(one);
    without.add(alone);
    ratios.push_back(one.percentile_us(0.999) / alone.percentile_us(0.999));
  }
  const double ratio = with.percentile_us(0.999) / without.percentile_us(0.999);
  const std::vector<std::string> problems = judge(found, ratio);
  double load = 0.0;
  (void)::getloadavg(&load, 1);
  const json told = {{"minutes_of_each", minutes},
                     {"rounds", num_rounds},
                     {"scheduler", scheduler},
                     {"load_average", load},
                     {"loop_with", with.told()},
                     {"loop_without", without.told()},
                     {"lateness_p999_ratio", ratio},
                     {"lateness_p999_ratio_by_round", ratios},
                     {"hand_stream",
                      {{"recorded", found.num_recorded},
                       {"received", found.num_streamed},
                       {"lost", found.num_lost_streamed},
                       {"recording_lacks", found.num_unrecorded},
                       {"time_error_of_each_second", summary_ms(found.stream_errors_s)}}},
                     {"markers_received", found.num_markers},
                     {"amplifier",
                      {{"recorded", found.num_amplified},
                       {"lost", found.num_lost_amplified},
                       {"time_error", summary_ms(found.amplifier_errors_s)}}},
                     {"pulses",
                      {{"stored", found.num_pulses_stored},
                       {"received", found.num_pulses_received},
                       {"stored_to_received", summary_ms(found.pulse_delays_s)}}},
                     {"pedal",
                      {{"press_to_read", summary_ms(found.press_to_read_s)},
                       {"press_to_stored", summary_ms(found.press_to_stored_s)}}},
                     {"sound",
                      {{"frames", found.num_sound_frames},
                       {"gaps", found.num_sound_gaps},
                       {"lost_cues", found.num_lost_cues}}},
                     {"problems", problems}};
  std::printf("%s\n", told.dump(1).c_str());
  return problems.empty() ? 0 : 1;
}

double positive_number(const std::string& word) {
  char* end = nullptr;
  const double number = std::strtod(word.c_str(), &end);
  if (end == word.c_str() || *end != '\0' || !(number > 0.0)) {
    throw std::runtime_error("expected [MINUTES [ROUNDS]], numbers above 0, found `" + word +
                             "`; try `./dev bench laboratory 2 1`");
  }
  return number;
}

int run(const std::vector<std::string>& words) {
  if (words.size() >= 3 && words[0] == "--session") {
    LaboratorySession session{.folder = words[1], .duration_s = positive_number(words[2])};
    if (words.size() >= 6) {
      session.has_everything = true;
      session.marker_port = words[3];
      session.answer_port = words[4];
      session.stream_name = words[5];
    }
    return run_laboratory_session(session);
  }
  const double minutes = words.empty() ? 60.0 : positive_number(words[0]);
  const double rounds = words.size() < 2 ? 1.0 : positive_number(words[1]);
  return measure(minutes, static_cast<int>(std::ceil(rounds)));
}

}  // namespace
}  // namespace jnd::bench

int main(int argc, char** argv) {
  try {
    return jnd::bench::run({argv + 1, argv + argc});
  } catch (const std::exception& error) {
    std::fprintf(stderr, "jnd_laboratory_bench: %s\n", error.what());
    return 2;
  }
}
