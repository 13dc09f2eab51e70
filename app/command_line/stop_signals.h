#pragma once

namespace jnd::app {

/// From now on Ctrl-C, SIGTERM and a closed terminal (unless under nohup) ask to stop instead
/// of ending the program, so that work stops with what is on disk rather than dies with it.
void stop_on_signals();

/// Whether one of them came. Any thread.
[[nodiscard]] bool stop_requested() noexcept;

}  // namespace jnd::app
