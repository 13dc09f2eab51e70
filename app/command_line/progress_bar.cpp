#include "app/command_line/progress_bar.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <utility>

namespace jnd::app {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr int kWidth = 32;
/// Nothing is shown about work that is over by then.
constexpr seconds kSoon(2);
constexpr milliseconds kBetweenDrawings(100);
constexpr seconds kBetweenLines(60);

}  // namespace

ProgressBar::ProgressBar(std::string title)
    : title_(std::move(title)),
      on_terminal_(::isatty(STDERR_FILENO) == 1),
      start_(std::chrono::steady_clock::now()),
      last_shown_(start_) {}

ProgressBar::~ProgressBar() {
  if (on_terminal_) std::fprintf(stderr, "\r\033[K");
}

void ProgressBar::show(double done) {
  const std::lock_guard guard(mutex_);
  const auto now = std::chrono::steady_clock::now();
  if (now - start_ < kSoon) return;
  if (now - last_shown_ < (on_terminal_ ? kBetweenDrawings : milliseconds(kBetweenLines))) {
    return;
  }
  last_shown_ = now;
  const double elapsed_s = std::chrono::duration<double>(now - start_).count();
  const double left_s = done > 0.02 ? elapsed_s / done * (1.0 - done) : -1.0;
  if (!on_terminal_) {
    std::fprintf(stderr, "jnd: %s: %.0f %% done", title_.c_str(), 100.0 * done);
    if (left_s >= 0.0) std::fprintf(stderr, ", about %.0f s left", left_s);
    std::fprintf(stderr, "\n");
    return;
  }
  std::string bar(static_cast<std::size_t>(std::clamp(done, 0.0, 1.0) * kWidth), '=');
  bar.resize(kWidth, ' ');
  std::fprintf(stderr, "\r\033[K%s [%s] %3.0f %%", title_.c_str(), bar.c_str(), 100.0 * done);
  if (left_s >= 0.0) std::fprintf(stderr, "  %.0f s left", left_s);
  std::fflush(stderr);
}

}  // namespace jnd::app
