#include <benchmark/benchmark.h>
#include <fcntl.h>
#include <unistd.h>

#include <string>
#include <vector>

#include "core/storage/sample_codec.h"
#include "core/storage/study_store.h"
#include "device/haptic_loop.h"
#include "device/lumped_hand_device.h"
#include "support/temporary_folder.h"

namespace jnd::core {
namespace {

/// Times an answer with its event, synced to disk.
void durable_commit(benchmark::State& state) {
  const test_support::TemporaryFolder folder;
  StudyStore store(folder.path() / "bench.study", StudyStore::Mode::kCreate);
  store.add_session({.participant = "P01", .protocol_sha256 = store.add_protocol("b", "{}")});
  std::int64_t sequence = 0;
  for (auto _ : state) {
    ++sequence;
    Commit commit{.event = {.session = 1, .sequence = sequence, .kind = "trial_answered"}};
    commit.trial = TrialRow{.session = 1, .trial = sequence, .sequence = sequence};
    store.append(commit);
  }
}
BENCHMARK(durable_commit)->Unit(benchmark::kMicrosecond);

/// Measures the reference in the same run: a bare fdatasync of one page on the same file
/// system.
void reference_fdatasync(benchmark::State& state) {
  const test_support::TemporaryFolder folder;
  const int file = ::open((folder.path() / "page").c_str(), O_CREAT | O_RDWR, 0600);
  const std::string page(4096, 'x');
  off_t offset = 0;
  for (auto _ : state) {
    if (::pwrite(file, page.data(), page.size(), offset) < 0) state.SkipWithError("write");
    ::fdatasync(file);
    offset += 4096;
  }
  ::close(file);
}
BENCHMARK(reference_fdatasync)->Unit(benchmark::kMicrosecond);

/// Encodes a chunk of what the loop records of the simulated hand that strokes through water.
/// Reports the bytes of a sample.
void encode_chunk(benchmark::State& state) {
  device::LumpedHandDevice hand({});
  LatestValue<HapticCommand> commands;
  LatestValue<Telemetry> telemetry;
  EmergencyStop stop;
  SpscQueue<Sample> queue(4096);
  device::HapticLoop loop({.starts_armed = true}, hand, {commands, telemetry, stop, &queue});
  hand.open();
  commands.publish({.sequence = 1, .medium = water({})});
  hand.simulated_hand()->begin_strokes({}, RandomStream(1, "bench"));
  for (int i = 0; i < 4096; ++i) loop.tick();
  std::vector<Sample> samples;
  queue.drain([&samples](const Sample& sample) { samples.push_back(sample); });
  std::size_t num_bytes = 0;
  for (auto _ : state) num_bytes = encode_samples(samples).size();
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(samples.size()));
  state.counters["bytes_per_sample"] =
      static_cast<double>(num_bytes) / static_cast<double>(samples.size());
}
BENCHMARK(encode_chunk)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace jnd::core
