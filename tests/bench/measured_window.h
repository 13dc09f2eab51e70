#pragma once

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <filesystem>
#include <fstream>
#include <functional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "app/window/virtual_display.h"
#include "app/window/window_driver.h"
#include "support/temporary_folder.h"

namespace jnd::app {

inline double percentile(std::vector<double> values, double ratio) {
  if (values.empty()) throw std::runtime_error("nothing was measured");
  std::ranges::sort(values);
  const auto most = static_cast<double>(values.size() - 1);
  return values[static_cast<std::size_t>(std::lround(ratio * most))];
}

inline double median(std::vector<double> values) { return percentile(std::move(values), 0.5); }

/// Returns the load average of one minute. Other work of the machine influences every figure,
/// so the load is printed with each.
inline double load_average() {
  double load = 0.0;
  return ::getloadavg(&load, 1) == 1 ? load : -1.0;
}

inline void sleep_s(double seconds) {
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
}

/// Runs `work`. If it fails, the JSON says why, and the other benchmarks are measured all the
/// same.
inline void measure(benchmark::State& state, const std::function<void()>& work) {
  const std::string lacking = what_windows_lack();
  for (auto _ : state) {
    try {
      if (!lacking.empty()) throw std::runtime_error(lacking);
      work();
    } catch (const std::exception& error) {
      // The first line says what failed, and the others say what was shown.
      const std::string what = error.what();
      state.SkipWithError(what.substr(0, what.find('\n')).c_str());
      return;
    }
  }
  state.counters["load_average"] = load_average();
}

/// Measures the real window, which the processor draws on a display of its own of 1600 x 1000.
class MeasuredWindow {
 public:
  struct Frame {
    std::string view;
    double draw_ms = 0.0, render_ms = 0.0, show_ms = 0.0, cpu_ms = 0.0;

    [[nodiscard]] double ms() const { return draw_ms + render_ms + show_ms; }
  };

  explicit MeasuredWindow(bool times_frames) {
    if (times_frames) ::setenv("JND_FRAME_TIMES", frame_file().c_str(), 1);
  }
  ~MeasuredWindow() { ::unsetenv("JND_FRAME_TIMES"); }
  MeasuredWindow(const MeasuredWindow&) = delete;
  MeasuredWindow& operator=(const MeasuredWindow&) = delete;

  [[nodiscard]] std::filesystem::path path(const std::string& name) const {
    return temporary_.path() / name;
  }
  [[nodiscard]] WindowDriver& person() { return person_; }

  /// Returns every frame of this run so far.
  [[nodiscard]] std::vector<Frame> frames() const {
    std::vector<Frame> all;
    std::ifstream lines(frame_file());
    Frame frame;
    while (lines >> frame.view >> frame.draw_ms >> frame.render_ms >> frame.show_ms >>
           frame.cpu_ms) {
      all.push_back(frame);
    }
    return all;
  }

  /// Waits until no frame was drawn for half a second, so that the view has finished what it
  /// began.
  void wait_for_rest() const {
    std::size_t before = 0;
    for (int wait = 0; wait < 60; ++wait) {
      const std::size_t now = frames().size();
      if (now == before) return;
      before = now;
      sleep_s(0.5);
    }
    throw std::runtime_error("the window draws on and on");
  }

  /// Moves the mouse over the whole window for about this time.
  void move_mouse(double seconds) const {
    constexpr double kStep_s = 0.04;
    std::vector<std::string> words = {"xdotool"};
    for (int step = 0; step < seconds / kStep_s; ++step) {
      const double turn = 0.11 * step;
      words.insert(words.end(),
                   {"mousemove", std::to_string(std::lround(800 + 700 * std::sin(turn))),
                    std::to_string(std::lround(500 + 450 * std::sin(1.7 * turn))), "sleep",
                    std::to_string(kStep_s)});
    }
    if (run_tool(words, display_.name()).exit_code != 0) {
      throw std::runtime_error("the mouse does not move");
    }
  }

  /// Returns the processor time of all threads of the program so far.
  [[nodiscard]] double cpu_s() const {
    const ToolOutcome found =
        run_tool({"xdotool", "search", "--onlyvisible", "--name", "^jnd$", "getwindowpid"},
                 display_.name());
    clockid_t clock{};
    timespec used{};
    if (found.exit_code != 0 ||
        ::clock_getcpuclockid(std::atoi(found.out.c_str()), &clock) != 0 ||
        ::clock_gettime(clock, &used) != 0) {
      throw std::runtime_error("the program's process is not found");
    }
    return static_cast<double>(used.tv_sec) + 1e-9 * static_cast<double>(used.tv_nsec);
  }

 private:
  [[nodiscard]] std::filesystem::path frame_file() const { return path("frame_times.txt"); }

  test_support::TemporaryFolder temporary_{test_support::memory_folder()};
  VirtualDisplay display_{1600, 1000};
  WindowDriver person_{display_, path("person")};
};

}  // namespace jnd::app
