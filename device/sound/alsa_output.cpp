#include "device/sound/alsa_output.h"

#include <alsa/asoundlib.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <thread>

#include "core/clock.h"
#include "core/error.h"
#include "device/realtime_report.h"

namespace jnd::device {
namespace {

using namespace std::chrono_literals;

/// Below the haptic loop (80) and its watchdog, so that sound never delays a force.
constexpr int kSoundPriority = 20;
constexpr unsigned kWantedRate_hz = 48000;
/// Four periods of 5 ms are short enough for a cue and long enough for a desktop.
constexpr snd_pcm_uframes_t kWantedPeriod = 256;
constexpr unsigned kWantedPeriods = 4;
/// A server or a card that accepts nothing for so long counts as dead.
constexpr int kPatience_ms = 2000;
/// An output that is further ahead of the clock has no clock of its own.
constexpr std::int64_t kMostAhead_ns = core::kNsPerS / 4;
constexpr snd_pcm_format_t kFormats[] = {SND_PCM_FORMAT_S32_LE, SND_PCM_FORMAT_S16_LE,
                                         SND_PCM_FORMAT_FLOAT_LE};

/// ALSA reports every plug-in that it misses on stderr, which belongs to the program.
void say_nothing(const char*, int, const char*, int, const char*, ...) {}

void hush_alsa() {
  static std::once_flag once;
  std::call_once(once, [] { snd_lib_error_set_handler(&say_nothing); });
}

std::int64_t monotonic_ns() noexcept {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

[[noreturn]] void fail_to_open(const std::string& name, const char* expected, int error) {
  throw core::Error("sound output " + name.substr(0, 80) + ": expected " + expected +
                    ", found: " + snd_strerror(error) +
                    "; `jnd sound` lists the outputs, and another program may hold this one");
}

/// Writes a sample in [-1, 1] in this format, rounded to the nearest step.
void write_sample(float sample, snd_pcm_format_t format, unsigned char* to) noexcept {
  const double x = std::clamp(static_cast<double>(sample), -1.0, 1.0);
  if (format == SND_PCM_FORMAT_S16_LE) {
    const auto value = static_cast<std::int16_t>(std::lrint(32767.0 * x));
    std::copy_n(reinterpret_cast<const unsigned char*>(&value), sizeof value, to);
  } else if (format == SND_PCM_FORMAT_S32_LE) {
    const auto value = static_cast<std::int32_t>(std::llrint(2147483647.0 * x));
    std::copy_n(reinterpret_cast<const unsigned char*>(&value), sizeof value, to);
  } else {
    const auto value = static_cast<float>(x);
    std::copy_n(reinterpret_cast<const unsigned char*>(&value), sizeof value, to);
  }
}

class AlsaOutput final : public SoundOutput {
 public:
  explicit AlsaOutput(const std::string& name) : name_(name) {
    hush_alsa();
    if (const int error =
            snd_pcm_open(&pcm_, name.c_str(), SND_PCM_STREAM_PLAYBACK, SND_PCM_NONBLOCK);
        error < 0) {
      fail_to_open(name, "an output that can be opened", error);
    }
    try {
      choose_format();
      choose_buffer();
    } catch (...) {
      snd_pcm_close(pcm_);
      throw;
    }
    samples_.resize(period_);
    frames_.resize(period_ * channels_ * sample_bytes_);
  }
  ~AlsaOutput() override {
    stop();
    snd_pcm_close(pcm_);
  }
  AlsaOutput(const AlsaOutput&) = delete;
  AlsaOutput& operator=(const AlsaOutput&) = delete;

  [[nodiscard]] double rate_hz() const noexcept override { return rate_; }
  [[nodiscard]] double longest_latency_s() const noexcept override {
    return static_cast<double>(buffer_ + period_) / rate_hz();
  }
  [[nodiscard]] std::string words() const override {
    return std::string("ALSA ") + snd_asoundlib_version() + ", " + name_ + ", " +
           std::to_string(rate_) + " Hz, " + std::to_string(channels_) + " channels, " +
           snd_pcm_format_name(format_) + ", buffer of " + std::to_string(buffer_) +
           " frames, periods of " + std::to_string(period_);
  }

  void start(core::SoundSource& source) override {
    if (thread_.joinable()) throw core::Error("sound output: expected to be started once");
    source_ = &source;
    thread_ = std::thread([this] { run(); });
  }

  void stop() noexcept override {
    is_ending_ = true;
    if (thread_.joinable()) thread_.join();
  }

  [[nodiscard]] SoundOutputState state() const override {
    SoundOutputState now{.num_underruns = num_underruns_,
                         .max_latency_s = static_cast<double>(max_delay_) / rate_hz()};
    if (const int priority = priority_; priority >= 0) {
      now.realtime_scheduler = priority > 0;
      now.scheduler =
          priority > 0 ? "SCHED_FIFO " + std::to_string(priority) : std::string("SCHED_OTHER");
    }
    if (const int error = error_; error != 0) {
      now.problem =
          "sound output " + name_ + ": expected to go on playing, found: " +
          (error == kNothingTaken ? "nothing was taken for 2 s" : snd_strerror(error));
    }
    return now;
  }

 private:
  static constexpr int kNothingTaken = 1;

  void choose_format() {
    snd_pcm_hw_params_t* hardware = nullptr;
    snd_pcm_hw_params_alloca(&hardware);
    const auto attempt = [&](const char* expected, int result) {
      if (result < 0) fail_to_open(name_, expected, result);
    };
    attempt("an output for playing", snd_pcm_hw_params_any(pcm_, hardware));
    attempt("interleaved samples",
            snd_pcm_hw_params_set_access(pcm_, hardware, SND_PCM_ACCESS_RW_INTERLEAVED));
    int result = -1;
    for (const snd_pcm_format_t format : kFormats) {
      result = snd_pcm_hw_params_set_format(pcm_, hardware, format);
      if (result < 0) continue;
      format_ = format;
      break;
    }
    attempt("samples of 16 or 32 bits", result);
    sample_bytes_ = static_cast<std::size_t>(snd_pcm_format_physical_width(format_)) / 8;
    channels_ = 2;
    attempt("a number of channels",
            snd_pcm_hw_params_set_channels_near(pcm_, hardware, &channels_));
    rate_ = kWantedRate_hz;
    attempt("a rate near 48000 Hz",
            snd_pcm_hw_params_set_rate_near(pcm_, hardware, &rate_, nullptr));
    period_ = kWantedPeriod * rate_ / kWantedRate_hz;
    attempt("a period",
            snd_pcm_hw_params_set_period_size_near(pcm_, hardware, &period_, nullptr));
    buffer_ = kWantedPeriods * period_;
    attempt("a buffer", snd_pcm_hw_params_set_buffer_size_near(pcm_, hardware, &buffer_));
    attempt("such a format", snd_pcm_hw_params(pcm_, hardware));
    attempt("a period", snd_pcm_hw_params_get_period_size(hardware, &period_, nullptr));
    attempt("a buffer", snd_pcm_hw_params_get_buffer_size(hardware, &buffer_));
    if (rate_ < 8000 || rate_ > 192000 || period_ == 0 || buffer_ < 2 * period_) {
      throw core::Error("sound output " + name_ +
                        ": expected 8000 to 192000 Hz and a buffer of two periods, found " +
                        words() + "; choose another output (`jnd sound`)");
    }
  }

  /// Playing begins once the buffer is full, so that it never begins with a gap.
  void choose_buffer() {
    snd_pcm_sw_params_t* software = nullptr;
    snd_pcm_sw_params_alloca(&software);
    const auto attempt = [&](int result) {
      if (result < 0) fail_to_open(name_, "an output that begins by itself", result);
    };
    attempt(snd_pcm_sw_params_current(pcm_, software));
    attempt(snd_pcm_sw_params_set_start_threshold(pcm_, software, buffer_ / period_ * period_));
    attempt(snd_pcm_sw_params_set_avail_min(pcm_, software, period_));
    attempt(snd_pcm_sw_params(pcm_, software));
  }

  void run() noexcept {
    RealtimeReport report;
    obtain_scheduler(kSoundPriority, report);
    flush_denormals();
    priority_ = report.realtime_scheduler ? report.priority : 0;
    const std::int64_t begun_ns = monotonic_ns();
    std::int64_t num_written = 0;
    bool is_endless = false;
    while (!is_ending_ && error_ == 0) {
      const snd_pcm_sframes_t waiting = frames_waiting();
      max_delay_ =
          std::max<std::int64_t>(max_delay_, waiting + static_cast<std::int64_t>(period_));
      source_->render(samples_, monotonic_ns() + to_ns(waiting));
      for (std::size_t frame = 0; frame < period_; ++frame) {
        for (std::size_t channel = 0; channel < channels_; ++channel) {
          write_sample(samples_[frame], format_,
                       &frames_[(frame * channels_ + channel) * sample_bytes_]);
        }
      }
      write_period();
      // A file and the output `null` accept everything at once, so the machine's clock paces
      // them. A card's own clock is never so far ahead of the machine's clock.
      num_written += static_cast<std::int64_t>(period_);
      const std::int64_t played_ns = to_ns(num_written - frames_waiting());
      const std::int64_t since_ns = monotonic_ns() - begun_ns;
      is_endless |= played_ns > since_ns + since_ns / 100 + kMostAhead_ns;
      if (is_endless && played_ns > since_ns) {
        std::this_thread::sleep_for(std::chrono::nanoseconds(played_ns - since_ns));
      }
    }
    if (error_ == 0) (void)snd_pcm_drop(pcm_);
  }

  /// The computation does not overflow, even after days.
  [[nodiscard]] std::int64_t to_ns(std::int64_t frames) const noexcept {
    const auto rate = static_cast<std::int64_t>(rate_);
    return frames / rate * core::kNsPerS + frames % rate * core::kNsPerS / rate;
  }

  /// Returns the frames that are written and not heard yet.
  [[nodiscard]] snd_pcm_sframes_t frames_waiting() noexcept {
    snd_pcm_sframes_t delay = 0;
    return snd_pcm_delay(pcm_, &delay) < 0 ? 0 : std::max<snd_pcm_sframes_t>(0, delay);
  }

  void write_period() noexcept {
    snd_pcm_uframes_t written = 0;
    int waited_ms = 0;
    while (written < period_ && !is_ending_ && error_ == 0) {
      const snd_pcm_sframes_t taken = snd_pcm_writei(
          pcm_, &frames_[written * channels_ * sample_bytes_], period_ - written);
      if (taken > 0) {
        written += static_cast<snd_pcm_uframes_t>(taken);
        waited_ms = 0;
      } else if (taken == 0 || taken == -EAGAIN) {
        constexpr int kOnce_ms = 100;
        const int ready = snd_pcm_wait(pcm_, kOnce_ms);
        if (ready == 0 && (waited_ms += kOnce_ms) >= kPatience_ms) error_ = kNothingTaken;
        if (ready < 0) recover(ready);
      } else {
        recover(static_cast<int>(taken));
      }
    }
  }

  /// Continues after a gap, or after the machine slept. Any other error ends the output.
  void recover(int error) noexcept {
    if (error == -EINTR || error == -EAGAIN) return;
    if (error == -EPIPE || error == -ESTRPIPE) ++num_underruns_;
    if (error == -ESTRPIPE) {
      // Waits until the system has its cards again. `snd_pcm_recover` would wait for ever.
      for (int i = 0; i < 20 && snd_pcm_resume(pcm_) == -EAGAIN && !is_ending_; ++i) {
        std::this_thread::sleep_for(100ms);
      }
      error = -EPIPE;
    }
    const int result = error == -EPIPE ? snd_pcm_prepare(pcm_) : error;
    if (result < 0) error_ = result;
  }

  std::string name_;
  snd_pcm_t* pcm_ = nullptr;
  snd_pcm_format_t format_ = SND_PCM_FORMAT_S16_LE;
  std::size_t sample_bytes_ = 2;
  unsigned rate_ = 0, channels_ = 0;
  snd_pcm_uframes_t period_ = 0, buffer_ = 0;
  std::vector<float> samples_;         ///< Of one period.
  std::vector<unsigned char> frames_;  ///< The same in the output's format.
  core::SoundSource* source_ = nullptr;
  std::atomic<bool> is_ending_{false};
  std::atomic<int> error_{0};
  std::atomic<int> priority_{-1};
  std::atomic<std::int64_t> num_underruns_{0}, max_delay_{0};
  std::thread thread_;
};

/// Whether it is one of ALSA's own plug-ins, which convert and mix and are no outputs.
bool is_plug_in(const std::string& name) {
  static const char* const kPlugIns[] = {
      "null",     "lavrate", "samplerate", "speexrate",   "speex",     "upmix",
      "vdownmix", "jack",    "oss",        "dmix",        "dsnoop",    "surround",
      "front:",   "rear:",   "side:",      "center_lfe:", "usbstream:"};
  return std::ranges::any_of(kPlugIns, [&](const char* one) { return name.starts_with(one); });
}

std::string hint_text(const void* hint, const char* key) {
  char* found = snd_device_name_get_hint(hint, key);
  if (found == nullptr) return "";
  std::string text = found;
  std::free(found);
  std::ranges::replace(text, '\n', ' ');
  return text;
}

}  // namespace

std::unique_ptr<SoundOutput> open_alsa_output(const std::string& name) {
  return std::make_unique<AlsaOutput>(name);
}

std::vector<SoundOutputEntry> alsa_outputs() {
  hush_alsa();
  std::vector<SoundOutputEntry> found;
  void** hints = nullptr;
  if (snd_device_name_hint(-1, "pcm", &hints) < 0) return found;
  for (void** hint = hints; *hint != nullptr; ++hint) {
    const std::string name = hint_text(*hint, "NAME");
    if (name.empty() || hint_text(*hint, "IOID") == "Input" || is_plug_in(name)) continue;
    found.push_back({name, hint_text(*hint, "DESC")});
  }
  snd_device_name_free_hint(hints);
  std::ranges::stable_sort(found, [](const SoundOutputEntry& a, const SoundOutputEntry& b) {
    return a.name == "default" && b.name != "default";
  });
  return found;
}

}  // namespace jnd::device
