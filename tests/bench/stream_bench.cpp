#include <benchmark/benchmark.h>
#include <poll.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "core/clock_offsets.h"
#include "core/storage/study_store.h"
#include "core/streams/loopback_network.h"
#include "core/streams/stream_messages.h"
#include "core/streams/stream_outlet.h"
#include "core/streams/stream_search.h"
#include "support/places.h"
#include "support/program.h"
#include "support/temporary_folder.h"

namespace jnd {
namespace {

int stream_seconds(int usual) {
  const char* text = std::getenv("JND_BENCH_SECONDS");
  return std::max(text == nullptr ? usual : std::atoi(text), 1);
}

double percentile(std::vector<double> values, double ratio) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  const auto place = static_cast<std::size_t>(ratio * static_cast<double>(values.size() - 1));
  return values[place];
}

core::StreamInfo bench_stream() {
  return {.name = "bench",
          .type = "Bench",
          .channel_count = 10,
          .nominal_rate_hz = 1000.0,
          .format = core::ChannelFormat::kFloat32};
}

/// Carries datagrams between an inlet and the clock of an outlet, with a separate delay in each
/// direction: 50 us and an exponential part.
class JitteringWay {
 public:
  JitteringWay(std::uint16_t service_port, double mean_delay_s)
      : to_(*core::numeric_address("127.0.0.1", service_port)), delay_(1.0 / mean_delay_s) {
    thread_ = std::thread([this] { carry(); });
  }
  ~JitteringWay() {
    is_ending_ = true;
    thread_.join();
  }
  JitteringWay(const JitteringWay&) = delete;
  JitteringWay& operator=(const JitteringWay&) = delete;
  [[nodiscard]] std::uint16_t port() const noexcept { return near_.port(); }

 private:
  struct Letter {
    std::string bytes;
    bool is_question = false;
  };

  void carry() {
    core::StreamAddress asker;
    std::multimap<double, Letter> under_way;
    while (!is_ending_) {
      const double now_s = core::stream_clock_s();
      while (!under_way.empty() && under_way.begin()->first <= now_s) {
        const Letter& letter = under_way.begin()->second;
        (void)core::send_datagram(letter.is_question ? far_ : near_, letter.bytes,
                                  letter.is_question ? to_ : asker);
        under_way.erase(under_way.begin());
      }
      for (const bool is_question : {true, false}) {
        while (const auto came = core::receive_datagram(is_question ? near_ : far_)) {
          if (is_question) asker = came->from;
          under_way.emplace(core::stream_clock_s() + 50e-6 + delay_(random_),
                            Letter{came->bytes, is_question});
        }
      }
      std::this_thread::sleep_for(std::chrono::microseconds(20));
    }
  }

  core::StreamAddress to_;
  core::StreamSocket near_ = core::datagram_socket(), far_ = core::datagram_socket();
  std::mt19937 random_{1};
  std::exponential_distribution<double> delay_;
  std::atomic<bool> is_ending_{false};
  std::thread thread_;
};

/// The clock of the other machine is fast by 40 ppm. Every datagram is late by 50 us and 0.4 ms
/// on average, in each direction separately. Measures the error of corrected times in every
/// hundredth of a second of JND_BENCH_SECONDS (default 120). The goal is a p99 of at most 0.2
/// ms.
void clock_synchronisation(benchmark::State& state) {
  constexpr double kDrift = 40e-6;
  constexpr double kMeanDelay_s = 0.4e-3;
  const double begun_s = core::stream_clock_s();
  const auto theirs = [begun_s](double ours_s) {
    return 777.0 + (ours_s - begun_s) * (1.0 + kDrift);
  };
  core::StreamNetwork there = core::loopback_network();
  there.clock_s = [theirs] { return theirs(core::stream_clock_s()); };
  core::StreamNetwork here = there;
  here.clock_s = core::stream_clock_s;
  for (auto _ : state) {
    const auto outlet = core::open_own_outlet(bench_stream(), there);
    core::StreamInfo info = outlet->info();
    const JitteringWay way(info.v4_service_port, kMeanDelay_s);
    info.v4_address = "127.0.0.1";
    info.v4_service_port = way.port();
    const auto inlet = core::open_own_inlet(info, here);
    const int seconds = stream_seconds(120);
    const double first_s = core::stream_clock_s();
    std::vector<core::ClockOffset> offsets;
    while (core::stream_clock_s() < first_s + seconds) {
      std::this_thread::sleep_for(std::chrono::milliseconds(500));
      for (const core::ClockOffset& one : inlet->take_offsets()) offsets.push_back(one);
    }
    const core::ClockCorrection correction(offsets);
    std::vector<double> corrected_ms, single_ms;
    for (double ours_s = first_s; ours_s < first_s + seconds; ours_s += 0.01) {
      corrected_ms.push_back(1e3 * std::abs(correction.corrected_s(theirs(ours_s)) - ours_s));
    }
    for (const core::ClockOffset& one : offsets) {
      const double ours_s = begun_s + (one.time_s - 777.0) / (1.0 + kDrift);
      single_ms.push_back(1e3 * std::abs(one.offset_s - (ours_s - one.time_s)));
    }
    state.counters["num_offsets"] = static_cast<double>(offsets.size());
    state.counters["error_p50_ms"] = percentile(corrected_ms, 0.5);
    state.counters["error_p99_ms"] = percentile(corrected_ms, 0.99);
    state.counters["error_max_ms"] = percentile(corrected_ms, 1.0);
    state.counters["single_error_p99_ms"] = percentile(single_ms, 0.99);
  }
}
BENCHMARK(clock_synchronisation)->Iterations(1)->Unit(benchmark::kSecond)->UseRealTime();

/// Sends an hour of samples at 1 kHz with ten channels from an outlet to an inlet on this
/// machine, as fast as possible. The goal is nothing lost and nothing out of order.
void an_hour_of_samples(benchmark::State& state) {
  constexpr std::int64_t kNumSamples = 3'600'000;
  constexpr std::int64_t kBatch = 100;
  // This is less than what is kept for a slow consumer.
  constexpr std::int64_t kAhead = 20'000;
  const core::StreamNetwork network = core::loopback_network();
  for (auto _ : state) {
    const auto outlet = core::open_own_outlet(bench_stream(), network);
    core::StreamInfo info = outlet->info();
    info.v4_address = "127.0.0.1";
    const auto inlet = core::open_own_inlet(info, network);
    if (!core::comes_about([&] { return outlet->num_consumers() == 1; })) {
      state.SkipWithError("the inlet did not come to the outlet");
      return;
    }
    std::int64_t num_came = 0, num_wrong = 0;
    const auto take = [&] {
      for (const core::StreamSample& one : inlet->take_samples()) {
        if (std::llround(1e3 * one.time_s) != num_came++) ++num_wrong;
      }
    };
    for (std::int64_t next = 0; next < kNumSamples;) {
      std::vector<core::StreamSample> batch;
      for (std::int64_t i = 0; i < kBatch; ++i, ++next) {
        batch.push_back({.time_s = 1e-3 * static_cast<double>(next),
                         .values = std::string(40, static_cast<char>(next)),
                         .texts = {}});
      }
      outlet->push(batch);
      while (next - num_came > kAhead) {
        take();
        std::this_thread::sleep_for(std::chrono::microseconds(200));
      }
    }
    (void)core::comes_about([&] {
      take();
      return num_came >= kNumSamples;
    });
    state.counters["sent"] = static_cast<double>(kNumSamples);
    state.counters["lost"] = static_cast<double>(kNumSamples - num_came);
    state.counters["out_of_place"] = static_cast<double>(num_wrong);
    state.counters["dropped"] =
        static_cast<double>(outlet->num_dropped() + inlet->num_dropped());
  }
}
BENCHMARK(an_hour_of_samples)->Iterations(1)->Unit(benchmark::kSecond)->UseRealTime();

struct SessionLateness {
  std::vector<std::pair<double, double>> buckets_us;  ///< Upper end and count.
  double missed = 0.0;
};

/// Runs a session of this many seconds and returns its stored punctuality.
std::optional<SessionLateness> run_session(int seconds, bool has_streams) {
  const test_support::TemporaryFolder folder;
  std::ofstream(folder.path() / "move.json")
      << R"({"format": 1, "name": "move", "languages": ["en"], "title": {"en": "Move"},
             "authors": ["A. Author"],
             "device": {"min_contact_points": 1, "rate_hz": 1000, "ramp_s": 0.05},
             "stages": [{"kind": "explore", "name": "free", "instruction": {"en": "Move."},
                         "media": [{"medium": "free_space", "duration_s": )"
      << seconds << "}]}]}";
  std::vector<std::string> words = {"run",        "move.json",     "--study",
                                    "a.study",    "--participant", "P01",
                                    "--headless", "--realtime",    "--acknowledge"};
  if (has_streams) {
    for (const char* word : {"--lsl-out", "markers,samples", "--lsl-peer", "127.0.0.1"}) {
      words.emplace_back(word);
    }
  }
  test_support::RunningProgram program(words, {.folder = folder.path(), .environment = {}});
  if (!program.read_line()) return std::nullopt;
  std::vector<std::unique_ptr<core::StreamInlet>> inlets;
  if (has_streams) {
    core::StreamNetwork network = core::loopback_network();
    network.session_id = "default";
    for (const core::StreamInfo& info : core::find_streams(
             network, core::query_for(network, "hostname", core::own_hostname()), 2.0, 2)) {
      inlets.push_back(core::open_own_inlet(info, network));
    }
  }
  while (program.read_line()) {
    for (const auto& inlet : inlets) (void)inlet->take_samples();
  }
  if (program.wait().exit_code != 0) return std::nullopt;
  SessionLateness lateness;
  const core::StudyStore store(folder.path() / "a.study", core::StudyStore::Mode::kReadOnly);
  for (const core::EventRow& event : store.events(1)) {
    if (event.kind != "loop_measured") continue;
    const auto data = nlohmann::json::parse(event.data);
    lateness = {};
    for (const auto& bucket : data.at("lateness_ns")) {
      lateness.buckets_us.emplace_back(1e-3 * bucket.at(0).get<double>(), bucket.at(1));
    }
    lateness.missed = data.at("missed_ticks");
  }
  return lateness;
}

double bucket_percentile_us(const SessionLateness& run, double ratio) {
  double total = 0.0, seen = 0.0;
  for (const auto& [us, count] : run.buckets_us) total += count;
  for (const auto& [us, count] : run.buckets_us) {
    seen += count;
    if (seen >= ratio * total) return us;
  }
  return 0.0;
}

/// Measures how late the loop is in a session without streams, and with markers and samples
/// that somebody records, alternating, in three rounds of JND_BENCH_SECONDS (default 20).
/// Reports medians of the rounds.
void loop_with_and_without_streams(benchmark::State& state) {
  constexpr int kNumRounds = 3;
  const int seconds = stream_seconds(20);
  for (auto _ : state) {
    std::map<std::string, std::vector<double>> found;
    for (int round = 0; round < kNumRounds; ++round) {
      for (const bool has_streams : {false, true}) {
        const auto run = run_session(seconds, has_streams);
        if (!run) {
          state.SkipWithError("jnd run failed");
          return;
        }
        const std::string which = has_streams ? "with_" : "without_";
        found[which + "p50_us"].push_back(bucket_percentile_us(*run, 0.5));
        found[which + "p99_us"].push_back(bucket_percentile_us(*run, 0.99));
        found[which + "p999_us"].push_back(bucket_percentile_us(*run, 0.999));
        found[which + "missed"].push_back(run->missed);
      }
    }
    for (auto& [name, values] : found) state.counters[name] = percentile(values, 0.5);
    state.counters["seconds_a_round"] = seconds;
  }
}
BENCHMARK(loop_with_and_without_streams)
    ->Iterations(1)
    ->Unit(benchmark::kSecond)
    ->UseRealTime();

}  // namespace
}  // namespace jnd
