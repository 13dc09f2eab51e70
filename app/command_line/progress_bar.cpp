#include "app/command_line/progress_bar.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <utility>

namespace jnd::app {
namespace {

constexpr int kWidth = 32;

}  // namespace

ProgressBar::ProgressBar(std::string title)
    : title_(std::move(title)),
      on_terminal_(::isatty(STDERR_FILENO) == 1),
      start_(std::chrono::steady_clock::now()) {}

ProgressBar::~ProgressBar() {
  if (on_terminal_) std::fprintf(stderr, "\r\033[K");
}

void ProgressBar::show(double done) {
  if (!on_terminal_) return;
  const std::lock_guard guard(mutex_);
  const auto now = std::chrono::steady_clock::now();
  if (now - last_shown_ < std::chrono::milliseconds(100)) return;
  last_shown_ = now;
  const double elapsed_s = std::chrono::duration<double>(now - start_).count();
  std::string bar(static_cast<std::size_t>(std::clamp(done, 0.0, 1.0) * kWidth), '=');
  bar.resize(kWidth, ' ');
  std::fprintf(stderr, "\r\033[K%s [%s] %3.0f %%", title_.c_str(), bar.c_str(), 100.0 * done);
  if (done > 0.02) std::fprintf(stderr, "  %.0f s left", elapsed_s / done * (1.0 - done));
  std::fflush(stderr);
}

}  // namespace jnd::app
