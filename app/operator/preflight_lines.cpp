#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <iterator>
#include <memory>
#include <thread>
#include <utility>

#include "app/language/words.h"
#include "app/operator/preflight.h"
#include "app/operator/study_folder.h"
#include "app/session/device_run.h"
#include "app/session/stored_session.h"
#include "core/error.h"
#include "core/storage/backup_mark.h"
#include "core/storage/study_store.h"
#include "core/storage/writer_lock.h"
#include "device/profiled_device.h"
#include "device/registry/device_registry.h"

namespace jnd::app {
namespace {

using Status = PreflightLine::Status;

/// Recordings of the simulated hand take less than this; the rest is room for other devices.
constexpr double kBytesPerSample = 15.0;

std::string size_words(double bytes) {
  if (bytes >= 10e9) return fmt::format("{:.0f} GB", bytes / 1e9);
  if (bytes >= 1e9) return fmt::format("{:.1f} GB", bytes / 1e9);
  return fmt::format("{:.0f} MB", bytes / 1e6);
}

/// A count with two digits, rounded down: "about 940 sessions".
std::string about_sessions(double count) {
  if (count < 1.0) return tr("less than a session");
  if (count >= 10'000.0) return tr("more than 10000 sessions");
  const double step = count >= 1000.0 ? 100.0 : (count >= 100.0 ? 10.0 : 1.0);
  return trn("about {} session", "about {} sessions",
             static_cast<std::int64_t>(std::floor(count / step) * step));
}

std::string rate_words(double rate_hz) {
  return rate_hz >= 1000.0 ? fmt::format("{:g} kHz", rate_hz / 1000.0)
                           : fmt::format("{:g} Hz", rate_hz);
}

std::string loop_name(double rate_hz, double duration_s) {
  return tr("Loop at {} for {:g} s", rate_words(rate_hz), duration_s);
}

std::string text_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace

PreflightLine line_from(const std::string& name, const std::string& failure,
                        const std::function<PreflightLine()>& work) {
  try {
    return work();
  } catch (const core::Error& error) {
    return {.name = name, .status = Status::kFailed, .found = failure, .remedy = error.what()};
  }
}

PreflightLine study_file_line(const std::filesystem::path& folder) {
  const std::string name = tr("Study file");
  return line_from(name, tr("cannot be used"), [&]() -> PreflightLine {
    const core::StudyStore store(folder, core::StudyStore::Mode::kReadOnly);
    const core::ProtocolRow protocol = protocol_in(store);
    (void)study_in(store);
    const std::filesystem::path file = study_file_of(store, protocol);
    std::error_code ignored;
    if (file.empty() || !std::filesystem::is_regular_file(file, ignored)) {
      return {.name = name, .status = Status::kOk, .found = tr("sound, kept in the folder")};
    }
    if (text_of(file) == protocol.text) {
      return {.name = name, .status = Status::kOk, .found = tr("sound and unchanged")};
    }
    return {
        .name = name,
        .status = Status::kWarning,
        .found = tr("changed since the study began"),
        .remedy = tr("sessions go on with the text kept in the folder; begin a new folder for "
                     "the changed one")};
  });
}

PreflightLine folder_line(const std::filesystem::path& folder) {
  const std::string name = tr("Study folder");
  return line_from(name, tr("cannot be written"), [&]() -> PreflightLine {
    core::require_no_backup(folder);
    const core::WriterLock alone(folder);
    const std::filesystem::path file = folder / "study.sqlite";
    if (::access(file.c_str(), W_OK) != 0) {
      throw core::Error(
          tr("{}: expected a file that can be written, found that it cannot; look at "
             "its rights and its disk",
             file.string()));
    }
    const core::StudyStore store(folder, core::StudyStore::Mode::kReadOnly);
    if (!ended_study_remark(store).empty()) {
      return {.name = name,
              .status = Status::kWarning,
              .found = tr("ended by the rule of the study"),
              .remedy = tr("one session more was not planned; see `jnd look`")};
    }
    return {.name = name, .status = Status::kOk, .found = tr("ours alone to write")};
  });
}

PreflightLine disk_line(double free_bytes, double rate_hz, double session_s) {
  // Events, and the pages of the database.
  constexpr double kOtherwise_bytes = 1e6;
  constexpr double kFewSessions = 10.0;
  const double sessions =
      free_bytes / (rate_hz * session_s * kBytesPerSample + kOtherwise_bytes);
  PreflightLine line{.name = tr("Disk"), .status = Status::kOk};
  line.found = tr("{} free, {}", size_words(free_bytes), about_sessions(sessions));
  if (sessions >= kFewSessions) return line;
  line.status = sessions < 1.0 ? Status::kFailed : Status::kWarning;
  line.remedy = tr("make room, or keep the study on another disk");
  return line;
}

PreflightLine device_line(const std::string& device, double rate_hz, int min_contact_points) {
  const std::string name = tr("Device");
  return line_from(name, tr("does not start"), [&]() -> PreflightLine {
    const std::unique_ptr<device::HapticDevice> made = device::make_device(device, rate_hz);
    const device::DeviceCapabilities can = made->capabilities();
    if (can.num_contact_points() < min_contact_points) {
      return {.name = name,
              .status = Status::kFailed,
              .found = tr("holds {} of {} points of the hand", can.num_contact_points(),
                          min_contact_points),
              .remedy = tr("choose another device")};
    }
    // The motors of a real device turn on only after the check for real time, in the loop's
    // test.
    if (!can.simulated) return {.name = name, .status = Status::kOk, .found = device};
    made->open();
    made->close();
    return {.name = name, .status = Status::kOk, .found = tr("{}, simulated", device)};
  });
}

PreflightLine with_profile(PreflightLine line, const std::optional<KnownProfile>& known,
                           const std::string& refused) {
  if (!refused.empty()) {
    line.status = Status::kFailed;
    line.remedy = refused;
  } else if (known) {
    const experiments::DeviceProfile& profile = known->profile;
    line.found += profile.simulated ? tr(", measured SIMULATED on {}, valid until {}",
                                         profile.measured_on, profile.valid_until)
                                    : tr(", measured on {}, valid until {}",
                                         profile.measured_on, profile.valid_until);
  }
  return line;
}

PreflightLine stimuli_line(const std::vector<experiments::RangeEntry>& range,
                           const experiments::RangeLimits& limits, bool hides_levels,
                           const std::optional<StabilityCheck>& stability) {
  const auto fitting =
      std::count_if(range.begin(), range.end(), [](const auto& entry) { return entry.fits; });
  const bool all = fitting == static_cast<std::ptrdiff_t>(range.size());
  PreflightLine line{.name = tr("Stimuli"), .status = all ? Status::kOk : Status::kFailed};
  line.found = tr("{} of {} within limits", fitting, range.size());
  if (!all) {
    line.remedy = tr("choose a device that can render them, or weaken the study's stimuli");
  }
  if (stability && stability->num_unstable() > 0) {
    line.status = Status::kFailed;
    line.found += tr(", {} unstable", stability->num_unstable());
    if (line.remedy.empty()) line.remedy = tr("weaken the study's stimuli, or raise its rate");
  } else if (stability && stability->num_needing_the_hand() > 0) {
    line.found += tr(", {} stable on the hand alone", stability->num_needing_the_hand());
  }
  if (hides_levels || range.empty()) return line;
  const auto strongest = std::max_element(
      range.begin(), range.end(),
      [](const auto& a, const auto& b) { return a.total_force_n < b.total_force_n; });
  line.found +=
      tr(", up to {:.1f} of {:g} N", strongest->total_force_n, limits.max_total_force_n);
  return line;
}

/// Judges what loss and delay on the way to the device will cost in a session.
static void judge_link(const device::LinkReport& link, PreflightLine& line) {
  line.found += tr("; link {}: {:.1f} % lost, {:.1f} ms there and back", link.level,
                   100.0 * link.lost_ratio, 1e3 * link.round_trip_s);
  if (link.may_arm) return;
  line.status = link.may_give_force ? Status::kWarning : Status::kFailed;
  line.remedy =
      link.may_give_force
          ? tr("a force that is there goes on, but the device is not armed over such a "
               "link, so every fault holds the session up until it is better; use a "
               "cable of its own")
          : tr("no force is given over such a link; use a cable of its own, or look at "
               "the device's own program");
}

PreflightLine loop_line(const LoopTest& test) {
  PreflightLine line{.name = loop_name(test.rate_hz, test.duration_s), .status = Status::kOk};
  if (!test.fault.empty()) {
    line.status = Status::kFailed;
    line.found = tr("stopped by a fault");
    line.remedy = test.fault;
    return line;
  }
  const std::string missed = test.missed_ticks == 0
                                 ? std::string(tr("none"))
                                 : trn("{} tick", "{} ticks", test.missed_ticks);
  line.found = test.lateness_p99_us < 10.0
                   ? tr("{} missed, 99 % within {:.1f} µs", missed, test.lateness_p99_us)
                   : tr("{} missed, 99 % within {:.0f} µs", missed, test.lateness_p99_us);
  if (test.link) judge_link(*test.link, line);
  const bool late = test.lateness_p99_us > 0.2 * 1e6 / test.rate_hz;
  if (line.status != Status::kOk || (test.missed_ticks == 0 && !late)) return line;
  line.status = test.missed_ticks > 0 && test.for_a_person ? Status::kFailed : Status::kWarning;
  line.remedy = tr("close other programs, or give the loop a processor of its own");
  return line;
}

LoopTest test_loop(const PreflightRequest& request, double rate_hz,
                   const std::optional<KnownProfile>& known,
                   const std::function<void(double)>& on_progress) {
  using Clock = std::chrono::steady_clock;
  LoopTest test{.rate_hz = rate_hz, .duration_s = request.loop_test_s};
  std::unique_ptr<device::HapticDevice> device = device::make_device(request.device, rate_hz);
  if (known) {
    device = std::make_unique<device::ProfiledDevice>(std::move(device),
                                                      device_parameters(known->profile));
  }
  test.for_a_person = !device->capabilities().simulated;
  DeviceRun run(*device, {.rate_hz = rate_hz,
                          .allow_no_realtime = request.allow_no_realtime,
                          .emergency_stop = request.emergency_stop});
  const Clock::time_point begin = Clock::now();
  for (double done = 0.0; done < 1.0;) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    run.take([](const core::Sample&) {});
    const double elapsed_s = std::chrono::duration<double>(Clock::now() - begin).count();
    done = std::min(1.0, elapsed_s / request.loop_test_s);
    if (on_progress) on_progress(done);
  }
  test.link = device->link();
  run.stop();
  const core::Fault fault = run.telemetry().fault;
  if (core::is_failure(fault)) test.fault = tr(core::words(fault).data());
  const device::LoopTiming& timing = run.thread().timing();
  test.missed_ticks = timing.missed_ticks();
  test.lateness_p99_us = 1e-3 * static_cast<double>(timing.lateness().percentile_ns(0.99));
  return test;
}

}  // namespace jnd::app
