#pragma once

#include <fcntl.h>
#include <linux/input.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <ctime>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/controls/control_source.h"
#include "core/controls/input_events.h"
#include "core/error.h"

namespace jnd::core {

inline std::int64_t test_clock_ns() {
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec * std::int64_t{1'000'000'000} + now.tv_nsec;
}

inline input_event test_event(unsigned type, unsigned code, int value, std::int64_t time_ns) {
  input_event event{};
  event.input_event_sec = time_ns / 1'000'000'000;
  event.input_event_usec = time_ns % 1'000'000'000 / 1'000;
  event.type = static_cast<std::uint16_t>(type);
  event.code = static_cast<std::uint16_t>(code);
  event.value = value;
  return event;
}

/// An input device whose kernel is the test. What is written into one end of a pipe is read
/// from the other, as `struct input_event`.
class PipedDevice {
 public:
  explicit PipedDevice(std::string name) : name_(std::move(name)) { plug_in(); }
  ~PipedDevice() {
    unplug();
    ::close(ends_[0]);
  }
  PipedDevice(const PipedDevice&) = delete;
  PipedDevice& operator=(const PipedDevice&) = delete;

  /// Presses or releases a key at this time of CLOCK_MONOTONIC, and sends the report that ends
  /// it.
  void key(unsigned code, bool is_down, std::int64_t time_ns = test_clock_ns()) {
    write(test_event(EV_KEY, code, is_down ? 1 : 0, time_ns));
    write(test_event(EV_SYN, SYN_REPORT, 0, time_ns));
  }
  void write(const input_event& event) {
    if (::write(ends_[1], &event, sizeof event) != sizeof event) {
      throw std::runtime_error("the pipe takes no event");
    }
  }
  void unplug() {
    if (ends_[1] >= 0) ::close(ends_[1]);
    ends_[1] = -1;
  }

  [[nodiscard]] std::unique_ptr<ControlSource> open() {
    return std::make_unique<Source>(*this);
  }
  [[nodiscard]] const std::string& name() const noexcept { return name_; }

  std::atomic<bool> is_ours{false};
  std::atomic<int> num_open{0};
  bool is_keyboard = false;

 private:
  void plug_in() {
    if (::pipe2(ends_, O_NONBLOCK | O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
  }

  class Source final : public ControlSource {
   public:
    explicit Source(PipedDevice& device) : device_(device), events_(device.name_) {
      ++device_.num_open;
    }
    ~Source() override {
      --device_.num_open;
      device_.is_ours = false;
    }
    Source(const Source&) = delete;
    Source& operator=(const Source&) = delete;
    [[nodiscard]] const std::string& device() const noexcept override { return device_.name_; }
    [[nodiscard]] int descriptor() const noexcept override { return device_.ends_[0]; }
    [[nodiscard]] std::vector<ControlEvent> take() override {
      std::array<std::byte, 1024> bytes;
      const ssize_t count = ::read(device_.ends_[0], bytes.data(), bytes.size());
      if (count > 0) {
        return events_.take(std::span(bytes).first(static_cast<std::size_t>(count)));
      }
      if (count < 0 && errno == EAGAIN) return {};
      throw Error(device_.name_ + ": gone");
    }
    [[nodiscard]] bool take_for_ourselves(bool wanted) override {
      if (wanted && events_.any_down()) return false;
      device_.is_ours = wanted;
      return true;
    }
    [[nodiscard]] bool is_keyboard() const noexcept override { return device_.is_keyboard; }

   private:
    PipedDevice& device_;
    InputEvents events_;
  };

  std::string name_;
  int ends_[2] = {-1, -1};
};

}  // namespace jnd::core
