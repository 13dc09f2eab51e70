#pragma once

#include <filesystem>
#include <string>

#include "app/session/session_pulses.h"

namespace CLI {
class App;
}

namespace jnd::app {

/// The options as they were given: see `add_marker_options`.
struct MarkerOptions {
  std::string port;
  std::string serial = "bytes";  ///< "bytes", "rts" or "dtr".
  int baud = 115200;
  double width_ms = 5.0;
  std::filesystem::path answer_port;  ///< The port of a box that answers by bytes.
  int answer_baud = 9600;
};

/// Adds the options of other instruments at a session: `--marker-port`, `--marker-line`,
/// `--marker-baud`, `--marker-width-ms`, `--answer-port` and `--answer-baud`.
void add_marker_options(CLI::App& command, MarkerOptions& options);

[[nodiscard]] WantedMarkers markers_given(const MarkerOptions& options);

/// Throws `UsageError` if markers are asked for in simulated time, or a box without a window in
/// which it could answer. Says on stderr where markers go.
void require_markers_fit(const MarkerOptions& options, bool is_realtime, bool has_window);

}  // namespace jnd::app
