#include "app/commands/device_serving.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <limits>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "app/command_line/command.h"
#include "app/command_line/json_text.h"
#include "app/command_line/option_checks.h"
#include "app/command_line/stop_signals.h"
#include "app/commands/release_stop_option.h"
#include "app/operator/remembered_stop.h"
#include "app/session/device_checks.h"
#include "core/error.h"
#include "device/network/device_key.h"
#include "device/network/device_server.h"
#include "device/network/udp_port.h"
#include "device/realtime_report.h"
#include "device/realtime_thread.h"
#include "device/registry/device_registry.h"
#include "device/sleep_watch.h"

namespace jnd::app {
namespace {

constexpr std::int64_t kNsPerS = 1'000'000'000;

/// Opens a device again after it was used, for the next program. If that fails, because the
/// device was unplugged, it is tried again once a second; the program at the other end sees
/// that the device cannot be read.
class Renewal {
 public:
  void look(device::DeviceServer& server, std::int64_t now_ns) {
    if (now_ns < next_ns_) return;
    try {
      server.renew_device();
      if (has_failed_) fmt::print(stderr, "device-server: the device is open again\n");
      has_failed_ = false;
    } catch (const core::Error& error) {
      if (!has_failed_) {
        fmt::print(stderr, "device-server: {}; it is tried again every second\n", error.what());
      }
      has_failed_ = true;
      next_ns_ = now_ns + kNsPerS;
    }
  }

 private:
  std::int64_t next_ns_ = 0;
  bool has_failed_ = false;
};

/// Steps a server by absolute time until it is told to stop. Returns how many steps were left
/// out because the machine delayed this program; the device's own time goes on only by its
/// steps.
std::int64_t serve(device::DeviceServer& server, device::UdpPort& port,
                   const DeviceServing& options) {
  const std::int64_t period_ns = std::llround(1e9 / options.rate_hz);
  const std::int64_t start_ns = port.now_ns();
  const std::int64_t end_ns = options.seconds > 0.0
                                  ? start_ns + std::llround(1e9 * options.seconds)
                                  : std::numeric_limits<std::int64_t>::max();
  std::int64_t num_missed = 0;
  std::int64_t due_ns = start_ns;
  Renewal renewal;
  device::SleepWatch sleep;
  while (due_ns < end_ns && !stop_requested()) {
    const timespec due{.tv_sec = static_cast<time_t>(due_ns / kNsPerS),
                       .tv_nsec = static_cast<long>(due_ns % kNsPerS)};
    // A signal wakes the thread early; then the loop ends.
    while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &due, nullptr) != 0 &&
           !stop_requested()) {
    }
    if (sleep.has_slept()) server.suspended();
    server.step(port.now_ns());
    renewal.look(server, port.now_ns());
    due_ns += period_ns;
    const std::int64_t late_ns = port.now_ns() - due_ns;
    if (late_ns >= period_ns) {
      num_missed += late_ns / period_ns;
      due_ns += late_ns / period_ns * period_ns;
    }
  }
  server.dismiss(port.now_ns());
  return num_missed;
}

void print(const device::DeviceServer& server, std::int64_t num_not_accepted,
           std::int64_t num_missed, bool json) {
  const device::DeviceServer::Counts& counts = server.counts();
  const device::LinkCounts& link = server.quality().counts();
  if (json) {
    nlohmann::ordered_json out;
    out["num_steps"] = counts.num_steps;
    out["num_missed_steps"] = num_missed;
    out["num_clients"] = counts.num_clients;
    out["num_turned_away"] = counts.num_turned_away;
    out["num_not_accepted"] = num_not_accepted;
    out["num_armings"] = counts.num_armings;
    out["num_disarmings"] = counts.num_disarmings;
    out["last_fault"] = std::string(core::name(counts.last_fault));
    out["link"] = {{"received", link.received},   {"lost", link.lost},
                   {"late", link.late},           {"doubled", link.doubled},
                   {"reordered", link.reordered}, {"refused", link.refused}};
    fmt::print("{}\n", json_text(out));
    return;
  }
  fmt::print(
      "{} steps, {} left out; {} programs connected, {} turned away; armed {} times, disarmed "
      "itself {} times{}\n{} datagrams received, {} lost, {} doubled, {} reordered, {} "
      "refused; "
      "{} steps without a new one; {} from hosts that are not allowed\n",
      counts.num_steps, num_missed, counts.num_clients, counts.num_turned_away,
      counts.num_armings, counts.num_disarmings,
      counts.last_fault == core::Fault::kNone
          ? ""
          : fmt::format(" (last: {})", core::name(counts.last_fault)),
      link.received, link.lost, link.doubled, link.reordered, link.refused, link.late,
      num_not_accepted);
}

std::unique_ptr<device::HapticDevice> served_device(const DeviceServing& options) {
  require_device(options.device);
  std::unique_ptr<device::HapticDevice> device;
  try {
    device = device::make_device(options.device, options.rate_hz);
  } catch (const device::DeviceUnreachable&) {
    throw;
  } catch (const core::Error& error) {
    throw UsageError(error.what());
  }
  if (device->capabilities().simulated || !options.is_simulator) return device;
  throw UsageError("--device: expected a simulated device, found " + options.device +
                   "; see `jnd devices`, and `jnd device-server` for a real one");
}

/// An address that others can reach needs a key, because whoever can send to it could command
/// the device.
std::optional<device::DeviceKey> key_for(const DeviceServing& options,
                                         const device::Address& address) {
  if (!options.key.empty()) {
    try {
      return device::read_device_key(device::device_key_file(options.key));
    } catch (const core::Error& error) {
      throw EnvironmentError(error.what());
    }
  }
  if (device::is_loopback(address)) return std::nullopt;
  throw UsageError("--listen: expected a key for an address that others can reach, found " +
                   options.listen +
                   "; make one with `jnd device-key NAME` and give --key NAME on both sides");
}

std::vector<device::Address> allowed_hosts(const DeviceServing& options) {
  std::vector<device::Address> hosts;
  for (const std::string& host : options.allow) {
    hosts.push_back(device::resolved({.host = host, .port = 1}));
  }
  return hosts;
}

/// A simulation gets long timeouts, because it can hurt nobody, and a busy machine may delay
/// either program for long.
device::DeviceServer::Parameters parameters_for(bool is_simulated,
                                                const std::optional<device::DeviceKey>& key) {
  std::random_device draw;
  device::DeviceServer::Parameters parameters{
      .first_stream_id = std::uint64_t{draw()} << 32 | draw(),
      .first_challenge = std::uint64_t{draw()} << 32 | draw(),
      .key = key};
  if (is_simulated) {
    parameters.watchdog_s = 0.100;
    parameters.max_answer_age_s = 0.120;
  }
  return parameters;
}

}  // namespace

int serve_device(const DeviceServing& options) {
  const std::unique_ptr<device::HapticDevice> device = served_device(options);
  const bool is_simulated = device->capabilities().simulated;
  if (!is_simulated)
    require_stop_released(stops_folder(), options.device, options.releases_stop);
  stop_on_signals();
  device::RealtimeReport report;
  device::obtain_scheduler(80, report);
  device::obtain_locked_memory(report);
  device::prefault_stack();
  std::unique_ptr<device::UdpPort> port;
  std::optional<device::DeviceKey> key;
  try {
    const device::Address address = device::resolved(
        {.host = options.listen, .port = static_cast<std::uint16_t>(options.port)});
    key = key_for(options, address);
    port = std::make_unique<device::UdpPort>(address);
    port->accept_only_from(allowed_hosts(options));
    // For a simulation, missing rights cost only punctuality.
    device::require_realtime(*device, report, /*allow_no_realtime=*/is_simulated);
    device->open();
  } catch (const core::Error& error) {
    throw EnvironmentError(error.what());
  }
  if (!is_simulated && options.releases_stop) forget_stop(stops_folder(), options.device);
  device::DeviceServer server(*device, *port, parameters_for(is_simulated, key));
  std::FILE* told = options.json ? stderr : stdout;
  fmt::print(told, "listening on {}\n", device::text_of(port->local()));
  if (!is_simulated) fmt::print(told, "a real device; not tried on hardware\n");
  if (!key) fmt::print(told, "without a key: every program of this machine may connect\n");
  std::fflush(told);
  const std::int64_t num_missed = serve(server, *port, options);
  device->close();
  print(server, port->num_not_accepted(), num_missed, options.json);
  return kDone;
}

void add_serving_options(CLI::App& command, DeviceServing& options) {
  command.add_option("--port", options.port, "0: any that is free (default 4700)")
      ->check(whole_number(0, 65535));
  command
      .add_option("--listen", options.listen,
                  "Address to be reached at; for other machines one of this machine's own, "
                  "with --key")
      ->capture_default_str();
  command.add_option("--key", options.key,
                     "Name of a key of `jnd device-key`: only programs that have it too may "
                     "connect");
  command.add_option("--allow", options.allow,
                     "Host that may connect; may be repeated (default: any)");
  command.add_option("--rate-hz", options.rate_hz, "Steps a second (default 1000)")
      ->check(number_between(10.0, 10'000.0));
  command.add_option("--seconds", options.seconds, "How long; default: until it is stopped")
      ->check(number_between(0.001, 31'536'000.0));
  if (!options.is_simulator) add_release_stop_option(command, options.releases_stop);
  command.add_flag("--json", options.json,
                   "Print one JSON document at the end; the address goes to stderr");
}

}  // namespace jnd::app
