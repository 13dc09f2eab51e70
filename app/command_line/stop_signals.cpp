#include "app/command_line/stop_signals.h"

#include <atomic>
#include <csignal>

namespace jnd::app {
namespace {

std::atomic<bool> requested{false};
static_assert(std::atomic<bool>::is_always_lock_free, "set in a signal handler");

/// Only sets the flag, because a signal may come at any moment.
void request_stop(int) { requested = true; }

}  // namespace

void stop_on_signals() {
  requested = false;
  std::signal(SIGINT, request_stop);
  std::signal(SIGTERM, request_stop);
  if (std::signal(SIGHUP, request_stop) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);
}

bool stop_requested() noexcept { return requested.load(); }

}  // namespace jnd::app
