#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "app/window/virtual_display.h"
#include "app/window/window_driver.h"
#include "app/window/window_studies.h"
#include "soak/process_use.h"
#include "support/program.h"
#include "support/temporary_folder.h"

// Runs the real program's window, with its pixels drawn on a display in memory: letters in
// every size, both themes, the picture of the apparatus, the participant's window. What the
// program holds is observed from outside. Exit code 0: nothing has grown; 1: something has; 2:
// wrong usage, or a view did not come.

namespace jnd::soak {
namespace {

namespace fs = std::filesystem;
using app::Screen;

constexpr std::size_t kFewestRounds = 8;
/// The participant's window moves between the two monitors that the experimenter does not look
/// at.
constexpr const char* kMonitors =
    "LEFT 0 0 1280 720\nMIDDLE 1280 0 1024 600\nRIGHT 2304 0 800 600\n";

/// Opens once everything that draws.
class Round {
 public:
  Round(app::WindowDriver& window, fs::path study)
      : window_(window), study_(std::move(study)) {}

  void go() {
    open_study();
    look_at_what_is_stored();
    look_at_letters();
    run_into_a_trial();
    look_at_apparatus();
    look_at_participant_window();
    leave_session();
  }

 private:
  void open_study() {
    window_.use("open_study");
    window_.wait_for("open_path");
    window_.press("ctrl+a");
    window_.type(study_.string());
    window_.press("Return");
    window_.wait_for_view("sessions");
  }
  void look_at_what_is_stored() {
    window_.use("tab_study");
    window_.wait_for_view("study");
    window_.use("tab_results");
    window_.wait_for_view("results");
    for (const char* page : {"page_charts", "page_boxes", "page_numbers"}) {
      window_.wait_until("the pages", [page](const Screen& now) {
        return now.offers(page) || now.offers("page_numbers");
      });
      if (window_.screen().offers(page)) window_.use(page);
    }
    window_.use("tab_sessions");
    window_.wait_for_view("sessions");
    window_.press("Down");
    window_.use("show_session");
    window_.wait_for_view("record");
    window_.use("page_answers");
    window_.press("BackSpace");
    window_.wait_for_view("sessions");
  }
  /// Shows every size and theme. Each size has a picture of its letters, and each theme has its
  /// colours.
  void look_at_letters() {
    for (const char* key : {"ctrl+plus", "ctrl+plus", "ctrl+minus", "ctrl+minus", "ctrl+d"}) {
      window_.press(key);
      look();
    }
    window_.press("ctrl+d");
    look();
  }
  void run_into_a_trial() {
    window_.use("new_session");
    window_.wait_for_view("prepare");
    window_.use("start_session");
    window_.use("begin");
    // The first is the reference, the second the test.
    window_.use("present");
    window_.wait_until("the test", [](const Screen& now) {
      return now.offers("present") && now.find("present")->label == "Present the test";
    });
    window_.use("present");
    window_.wait_until("an answer", [](const Screen& now) {
      return now.shows("felt for") && !now.offers("present");
    });
  }
  void look_at_apparatus() {
    window_.use("apparatus");
    window_.wait_for_view("apparatus");
    window_.wait_for_text("picture of the apparatus");
    for (const char* camera : {"camera_above", "camera_front", "camera_side"}) {
      if (window_.screen().offers(camera)) window_.use(camera);
      look();
    }
    window_.use("apparatus");
    window_.wait_for_view("session");
  }
  void look_at_participant_window() {
    window_.press("F9");
    for (const char* screen : {"screen_1", "screen_2", "screen_0"}) {
      window_.use(screen);
      look();
    }
    window_.use("screen_close");
    window_.wait_until("one window", [this](const Screen&) {
      return !window_.has_window("jnd: participant");
    });
  }
  void leave_session() {
    window_.press("ctrl+w");
    window_.wait_for("dialog_do");
    window_.press("Return");
    window_.wait_for_view("sessions");
    window_.press("ctrl+0");
    window_.wait_for_view("start");
  }
  static void look() { std::this_thread::sleep_for(std::chrono::milliseconds(300)); }

  app::WindowDriver& window_;
  fs::path study_;
};

int soak(double minutes, bool tells) {
  if (const std::string lacking = app::what_windows_lack(); !lacking.empty()) {
    throw std::runtime_error(lacking);
  }
  const test_support::TemporaryFolder folder(test_support::memory_folder());
  const fs::path person = folder.path() / "person", study = folder.path() / "study.json";
  app::VirtualDisplay display(3104, 720);
  app::WindowDriver window(display, person);
  std::ofstream(study) << app::study_of(app::kComparison);
  std::ofstream(folder.path() / "monitors") << kMonitors;
  test_support::ProgramOptions options{.folder = folder.path(),
                                       .environment = window.environment()};
  const test_support::ProgramOutcome simulated = test_support::run_program(
      {"simulate", "study.json", "--participants", "2", "--fast", "--study", "template.study"},
      options);
  if (simulated.exit_code != 0) throw std::runtime_error(simulated.err);
  ::setenv("JND_MONITORS", (folder.path() / "monitors").c_str(), 1);
  window.forgives_stalls = true;
  window.start();
  const auto begin = std::chrono::steady_clock::now();
  const auto took_s = [begin] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  };
  std::vector<ProcessUse> rounds;
  while (took_s() < 60.0 * minutes || rounds.size() < kFewestRounds) {
    const fs::path copy =
        folder.path() / (rounds.size() % 2 == 0 ? "one.study" : "other.study");
    fs::remove_all(copy);
    fs::copy(folder.path() / "template.study", copy, fs::copy_options::recursive);
    Round(window, copy).go();
    rounds.push_back(settled([&] { return use_of(window.process()); }, rounds));
    if (tells) {
      std::fprintf(stderr, "round %zu at %.0f s: %.1f MB, %d handles, %d threads\n",
                   rounds.size(), took_s(), 1e-6 * rounds.back().resident_bytes,
                   rounds.back().num_handles, rounds.back().num_threads);
    }
  }
  window.kill();
  const std::vector<std::string> problems = growths(rounds, /*judges_resident=*/true);
  const nlohmann::json told = {{"seconds", took_s()},
                               {"rounds", rounds.size()},
                               {"held", told_of(rounds)},
                               {"problems", problems}};
  std::printf("%s\n", told.dump(1).c_str());
  return problems.empty() ? 0 : 1;
}

}  // namespace
}  // namespace jnd::soak

int main(int argc, char** argv) {
  double minutes = 70.0;
  bool tells = false;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    char* end = nullptr;
    if (word == "--tell") {
      tells = true;
    } else if (minutes = std::strtod(word.c_str(), &end); *end != '\0' || !(minutes > 0.0)) {
      std::fprintf(stderr, "jnd_window_soak: expected [MINUTES] [--tell], found `%s`\n",
                   word.c_str());
      return 2;
    }
  }
  try {
    return jnd::soak::soak(minutes, tells);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "jnd_window_soak: %s\n", error.what());
    return 2;
  }
}
