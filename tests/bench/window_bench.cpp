#include <benchmark/benchmark.h>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "app/tiny_study.h"
#include "app/window/window_studies.h"
#include "bench/measured_window.h"
#include "support/program.h"

namespace jnd::app {
namespace {

namespace fs = std::filesystem;

/// Returns a study of the thesis with its thirteen participants, simulated once for all views.
fs::path thirteen_participants() {
  static const test_support::TemporaryFolder folder(test_support::memory_folder());
  static const test_support::ProgramOutcome outcome = test_support::run_program(
      {"simulate", "viscosity_discrimination", "--participants", "13", "--fast", "--study",
       (folder.path() / "thirteen.study").string()});
  if (outcome.exit_code != 0) throw std::runtime_error("jnd simulate: " + outcome.err);
  return folder.path() / "thirteen.study";
}

/// Goes to a view like a working person.
class Walk {
 public:
  explicit Walk(MeasuredWindow& window) : window_(window), person_(window.person()) {}

  void to(const std::string& view) {
    if (view == "session") return to_session("lumped");
    if (view == "session_exoskeleton") return to_session("exoskeleton");
    if (view == "apparatus") {
      to_session("exoskeleton");
      person_.use("apparatus");
      person_.wait_for_view("apparatus");
      return;
    }
    const fs::path study = thirteen_participants();
    person_.start({"run", "viscosity_discrimination", "--study", study.string(),
                   "--participant", "P99", "--device", "lumped"});
    person_.wait_for_view("prepare");
    window_.wait_for_rest();
    if (view == "prepare") return;
    // A view that was opened once can be reached from the start.
    person_.kill();
    person_.start();
    window_.wait_for_rest();
    if (view == "start") return;
    person_.use("study_1");
    person_.wait_for_view("sessions");
    if (view != "sessions") person_.use("tab_" + view);
    person_.wait_for_view(view);
    window_.wait_for_rest();
  }

 private:
  /// Goes to the second presentation of a trial, with the hand moving to and fro.
  void to_session(const std::string& device) {
    write_file(window_.path("study.json"), study_of(kComparison));
    person_.start({"run", window_.path("study.json").string(), "--study",
                   window_.path("a.study").string(), "--participant", "P01", "--device", device,
                   "--seed", "7"});
    person_.use("start_session");
    person_.use("begin");
    person_.use("present");
    person_.wait_until("the reference", [](const Screen& now) {
      return now.offers("present") && now.find("present")->label == "Present the test";
    });
    person_.use("present");
    person_.wait_for_text("felt for");
  }

  MeasuredWindow& window_;
  WindowDriver& person_;
};

/// Times one frame of a view while the mouse moves over it: the median over three seconds. Its
/// parts are the view's own work, the time until OpenGL is done, and the way to the display. It
/// also reports the processor time of all threads, which other programs affect less.
void window_frame(benchmark::State& state, const std::string& view) {
  measure(state, [&] {
    MeasuredWindow window(true);
    Walk(window).to(view);
    const std::size_t before = window.frames().size();
    window.move_mouse(3.0);
    std::vector<double> all, draw, render, show, cpu;
    const std::vector<MeasuredWindow::Frame> frames = window.frames();
    for (std::size_t i = before; i < frames.size(); ++i) {
      if (frames[i].view != view) throw std::runtime_error("another view: " + frames[i].view);
      all.push_back(frames[i].ms());
      draw.push_back(frames[i].draw_ms);
      render.push_back(frames[i].render_ms);
      show.push_back(frames[i].show_ms);
      cpu.push_back(frames[i].cpu_ms);
    }
    state.SetIterationTime(1e-3 * median(all));
    state.counters["frame_p99_ms"] = percentile(all, 0.99);
    state.counters["draw_ms"] = median(draw);
    state.counters["render_ms"] = median(render);
    state.counters["show_ms"] = median(show);
    state.counters["cpu_ms"] = median(cpu);
    state.counters["frames"] = static_cast<double>(all.size());
  });
}

/// Opens the apparatus for the first time. Measures the longest frame from then on, for which
/// the heartbeat waits, and the time until its picture is there. `stopped` is 1 if the force
/// was ended because of it.
void window_first_3d(benchmark::State& state) {
  measure(state, [&] {
    MeasuredWindow window(true);
    Walk(window).to("session_exoskeleton");
    const std::size_t before = window.frames().size();
    const auto began = std::chrono::steady_clock::now();
    window.person().use("apparatus");
    window.person().wait_for_text("picture of the apparatus");
    const std::chrono::duration<double> waited = std::chrono::steady_clock::now() - began;
    sleep_s(1.0);
    std::vector<double> all;
    const std::vector<MeasuredWindow::Frame> frames = window.frames();
    for (std::size_t i = before; i < frames.size(); ++i) all.push_back(frames[i].ms());
    state.SetIterationTime(waited.count());
    state.counters["longest_frame_ms"] = percentile(all, 1.0);
    state.counters["frames"] = static_cast<double>(all.size());
    state.counters["stopped"] =
        window.person().every_text().find("program stopped answering") == std::string::npos ? 0
                                                                                            : 1;
  });
}

/// Measures a view that nobody touches: percent of one core, and frames that were drawn
/// needlessly.
void window_idle(benchmark::State& state, const std::string& view) {
  constexpr double kSeconds = 8.0;
  measure(state, [&] {
    MeasuredWindow window(true);
    Walk(window).to(view);
    const std::size_t frames_before = window.frames().size();
    const double cpu_before_s = window.cpu_s();
    sleep_s(kSeconds);
    state.counters["cpu_percent"] = 100.0 * (window.cpu_s() - cpu_before_s) / kSeconds;
    state.counters["frames"] = static_cast<double>(window.frames().size() - frames_before);
    state.SetIterationTime(kSeconds);
  });
}

int register_views() {
  benchmark::RegisterBenchmark("window_first_3d", window_first_3d)
      ->Iterations(1)
      ->UseManualTime()
      ->Unit(benchmark::kSecond);
  for (const std::string view :
       {"start", "prepare", "session", "apparatus", "sessions", "results", "study"}) {
    benchmark::RegisterBenchmark(("window_frame/" + view).c_str(), window_frame, view)
        ->Iterations(1)
        ->UseManualTime()
        ->Unit(benchmark::kMillisecond);
    if (view == "session" || view == "apparatus") continue;  // These views are never idle.
    benchmark::RegisterBenchmark(("window_idle/" + view).c_str(), window_idle, view)
        ->Iterations(1)
        ->UseManualTime()
        ->Unit(benchmark::kSecond);
  }
  return 0;
}

[[maybe_unused]] const int kRegistered = register_views();

}  // namespace
}  // namespace jnd::app
