#pragma once

namespace jnd::app {

/// From now on Ctrl-C, SIGTERM and a closed terminal (except under nohup) ask the program to
/// stop instead of ending it, so that work stops in order with everything on disk.
void stop_on_signals();

/// Whether one of these signals came. Any thread may call it.
[[nodiscard]] bool stop_requested() noexcept;

}  // namespace jnd::app
