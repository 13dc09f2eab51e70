#include <benchmark/benchmark.h>
#include <fcntl.h>
#include <unistd.h>

#include <cmath>
#include <string>

#include "core/storage/sample_codec.h"
#include "core/storage/study_store.h"
#include "support/temporary_folder.h"

namespace jnd::core {
namespace {

/// An answer with its event, synced to disk.
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

/// The reference of the same run: a bare fdatasync of one page on the same file system.
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

/// A chunk of a sweep, with bytes a sample.
void encode_chunk(benchmark::State& state) {
  std::vector<Sample> samples(4096);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double t = 0.001 * static_cast<double>(i);
    samples[i].tick = static_cast<std::int64_t>(i);
    for (int point = 0; point < kNumContactPoints; ++point) {
      samples[i].tip_position_m[point] = {0.13 * std::sin(3.4 * t), 0.0,
                                          0.02 * std::cos(3.4 * t)};
      samples[i].tip_velocity_m_per_s[point] = {0.44 * std::cos(3.4 * t), 0.0, 0.0};
      samples[i].tip_force_n[point] = {-1.2 * std::cos(3.4 * t), 0.0, 0.0};
    }
  }
  std::size_t num_bytes = 0;
  for (auto _ : state) num_bytes = encode_samples(samples).size();
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(samples.size()));
  state.counters["bytes_per_sample"] = static_cast<double>(num_bytes) / 4096.0;
}
BENCHMARK(encode_chunk)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace jnd::core
