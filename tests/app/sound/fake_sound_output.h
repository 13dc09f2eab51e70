#pragma once

#include <chrono>
#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/error.h"
#include "device/sound/sound_output.h"

namespace jnd::app {

/// What a fake output has played, and what it shall do. It outlives the output.
struct FakeSound {
  double rate_hz = 8000.0, latency_s = 0.02;
  std::string refuses;  ///< Why it cannot be opened; "" if it can.
  device::SoundOutputState state{.scheduler = "SCHED_OTHER"};
  core::SoundSource* source = nullptr;  ///< Set while it plays.
  std::vector<float> heard;
  std::vector<std::string> opened;  ///< Opened names, in order.
  std::int64_t first_ns = 0;
  std::function<void()> on_open;  ///< It may be empty.

  /// Plays this many samples, in periods of 64, as fast as it can.
  void play(std::size_t num_samples) {
    std::vector<float> period(64);
    for (std::size_t i = 0; i < num_samples && source != nullptr; i += period.size()) {
      if (heard.empty()) {
        first_ns = std::chrono::duration_cast<std::chrono::nanoseconds>(
                       std::chrono::steady_clock::now().time_since_epoch())
                       .count();
      }
      const auto since_s = static_cast<double>(heard.size()) / rate_hz;
      source->render(period, first_ns + std::llround(1e9 * since_s));
      heard.insert(heard.end(), period.begin(), period.end());
    }
  }
};

/// An output without a thread, which the test plays.
class FakeSoundOutput final : public device::SoundOutput {
 public:
  FakeSoundOutput(FakeSound& fake, const std::string& name) : fake_(fake) {
    fake_.opened.push_back(name);
    if (fake_.on_open) fake_.on_open();
    if (!fake_.refuses.empty()) throw core::Error(fake_.refuses);
  }
  ~FakeSoundOutput() override { stop(); }
  FakeSoundOutput(const FakeSoundOutput&) = delete;
  FakeSoundOutput& operator=(const FakeSoundOutput&) = delete;
  [[nodiscard]] double rate_hz() const noexcept override { return fake_.rate_hz; }
  [[nodiscard]] double longest_latency_s() const noexcept override { return fake_.latency_s; }
  [[nodiscard]] std::string words() const override { return "a fake"; }
  void start(core::SoundSource& source) override { fake_.source = &source; }
  void stop() noexcept override { fake_.source = nullptr; }
  [[nodiscard]] device::SoundOutputState state() const override { return fake_.state; }

 private:
  FakeSound& fake_;
};

inline device::OpenSoundOutput fake_output(FakeSound& fake) {
  return [&fake](const std::string& name) -> std::unique_ptr<device::SoundOutput> {
    return std::make_unique<FakeSoundOutput>(fake, name);
  };
}

}  // namespace jnd::app
