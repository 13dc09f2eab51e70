#include "app/commands/marker_options.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <set>

#include "app/command_line/command.h"

namespace jnd::app {

void add_marker_options(CLI::App& command, MarkerOptions& options) {
  constexpr double kLongestPulse_ms = 100.0;
  static const std::set<int> kRates = {9600,   19200,  38400,  57600,
                                       115200, 230400, 460800, 921600};
  CLI::Option* port =
      command
          .add_option("--marker-port", options.port,
                      "Tells another recorder what happens by pulses at this port: "
                      "/dev/ttyUSB0 and the like, or /dev/parport0. Their codes are in the "
                      "study file")
          ->type_name("PORT");
  command
      .add_option("--marker-line", options.serial,
                  "Of a serial port: bytes, for a box that makes codes of them, or the line "
                  "that pulses, rts or dtr")
      ->check(CLI::IsMember({"bytes", "rts", "dtr"}))
      ->capture_default_str()
      ->needs(port);
  command.add_option("--marker-baud", options.baud, "Of bytes")
      ->check(CLI::IsMember(kRates))
      ->capture_default_str()
      ->needs(port);
  command
      .add_option("--marker-width-ms", options.width_ms,
                  "How long a pulse is, and the rest after it, in ms; 0: the box ends it")
      ->check(CLI::Range(0.0, kLongestPulse_ms))
      ->capture_default_str()
      ->needs(port);
  CLI::Option* box =
      command
          .add_option("--answer-port", options.answer_port,
                      "In the window: a box at this serial port sends a byte for each button, "
                      "to be mapped as a pedal is")
          ->type_name("PORT");
  command.add_option("--answer-baud", options.answer_baud, "Of that box")
      ->check(CLI::IsMember(kRates))
      ->capture_default_str()
      ->needs(box);
}

WantedMarkers markers_given(const MarkerOptions& options) {
  constexpr double kSPerMs = 1e-3;
  using enum core::SerialMarker;
  return {.port = options.port,
          .serial = options.serial == "rts"   ? kRts
                    : options.serial == "dtr" ? kDtr
                                              : kBytes,
          .baud = options.baud,
          .width_s = kSPerMs * options.width_ms};
}

void require_markers_fit(const MarkerOptions& options, bool is_realtime, bool has_window) {
  if (!options.answer_port.empty() && !has_window) {
    throw UsageError(
        "--answer-port: expected a session in the window, found one whose participant is "
        "simulated; leave out --headless");
  }
  const WantedMarkers wanted = markers_given(options);
  if (!wanted.any()) return;
  if (!is_realtime) {
    throw UsageError(
        "--marker-port: expected a session in real time, for others record by the clock, found "
        "one in simulated time; add --realtime");
  }
  std::fprintf(stderr, "jnd: markers: %s, %s, pulses of %g ms\n", wanted.port.c_str(),
               core::way_of(wanted).c_str(), options.width_ms);
}

}  // namespace jnd::app
