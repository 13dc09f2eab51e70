#include "app/operator/preflight.h"

#include <algorithm>
#include <optional>

#include "app/language/words.h"
#include "app/operator/study_folder.h"
#include "app/operator/study_outline.h"
#include "app/profile/profile_choice.h"
#include "app/session/device_checks.h"
#include "app/session/device_limits.h"
#include "app/session/machine_checks.h"
#include "core/error.h"
#include "core/storage/study_store.h"
#include "device/registry/device_registry.h"

namespace jnd::app {
namespace {

using Status = PreflightLine::Status;

enum Place : std::size_t {
  kStudyFile,
  kFolder,
  kDisk,
  kPriority,
  kMemory,
  kSleep,
  kDevice,
  kStimuli,
  kLoop,
};

/// What this machine lacks fails the check only if somebody can be hurt (`must`).
PreflightLine line_of(const MachineCheck& check, const std::string& name, bool must) {
  PreflightLine line{.name = name, .found = check.ok ? tr("granted") : tr("refused")};
  line.status = check.ok ? Status::kOk : (must ? Status::kFailed : Status::kWarning);
  line.remedy = check.remedy;
  return line;
}

/// Goes through everything, and tells of each line as soon as it is known.
class Look {
 public:
  Look(const PreflightRequest& request, WorkControl& control,
       const std::function<void(const std::vector<PreflightLine>&)>& on_lines)
      : request_(request), control_(control), on_lines_(on_lines) {
    for (const char* name :
         {tr("Study file"), tr("Study folder"), tr("Disk"), tr("Real-time priority"),
          tr("Memory lock"), tr("Sleep"), tr("Device"), tr("Stimuli"), tr("Loop")}) {
      lines_.push_back({.name = name});
    }
    tell();
  }

  std::vector<PreflightLine> run() {
    read_study();
    put(kFolder, folder_line(request_.folder));
    put(kDisk, disk());
    const bool must = is_for_a_person() && !request_.allow_no_realtime;
    put(kPriority, line_of(check_realtime_priority(), tr("Real-time priority"), must));
    put(kMemory, line_of(check_memory_lock(), tr("Memory lock"), must));
    put(kSleep, sleep_line());
    put(kDevice, device());
    put(kStimuli, stimuli());
    put(kLoop, loop());
    return lines_;
  }

 private:
  void tell() const {
    if (on_lines_) on_lines_(lines_);
  }
  void put(Place place, PreflightLine line) {
    lines_[place] = std::move(line);
    tell();
    control_.progress(kQuickRatio * static_cast<double>(place + 1) /
                      static_cast<double>(lines_.size()));
    control_.wake();
    control_.stop_if_cancelled();
  }

  void read_study() {
    put(kStudyFile, study_file_line(request_.folder));
    try {
      const core::StudyStore store(request_.folder, core::StudyStore::Mode::kReadOnly);
      study_ = study_in(store);
      rate_hz_ = study_->device.rate_hz;
      hides_levels_ = study_->blinding == experiments::Blinding::kDouble && !store.unblinded();
    } catch (const core::Error&) {
      // The line of the study file tells what is wrong.
      study_.reset();
    }
  }

  [[nodiscard]] bool is_for_a_person() const try {
    return !device::make_device(request_.device, rate_hz_)->capabilities().simulated;
  } catch (const core::Error&) {
    return true;
  }

  [[nodiscard]] static PreflightLine sleep_line() {
    const MachineCheck check = check_sleep();
    return {.name = tr("Sleep"),
            .status = check.ok ? Status::kOk : Status::kWarning,
            .found = check.ok ? tr("kept away") : tr("not kept away"),
            .remedy = check.remedy};
  }

  [[nodiscard]] PreflightLine disk() const {
    const std::optional<double> free = free_bytes(request_.folder);
    if (!free)
      return {.name = tr("Disk"), .status = Status::kWarning, .found = tr("not known")};
    constexpr double kHour_s = 3600.0;
    return disk_line(*free, rate_hz_, study_ ? longest_session_s(*study_) : kHour_s);
  }

  PreflightLine device() {
    PreflightLine line =
        device_line(request_.device, rate_hz_, study_ ? study_->device.min_contact_points : 1);
    if (line.status == Status::kFailed) return line;
    return line_from(line.name, line.found, [&] {
      const DeviceOfProfile device = device_of_profile(request_.device, rate_hz_);
      const ProfileChoice choice =
          choose_profile(device, request_.profile, profile_folders(), today());
      profile_ = choice.known;
      return with_profile(line, choice.known,
                          study_ ? refused_words(device, choice, *study_) : choice.lack);
    });
  }

  [[nodiscard]] PreflightLine stimuli() const {
    if (!study_) {
      return {.name = tr("Stimuli"),
              .status = Status::kFailed,
              .found = tr("not known"),
              .remedy = tr("mend the study first")};
    }
    return line_from(tr("Stimuli"), tr("not known"), [&] {
      const DeviceLimits device = limits_of_device(request_.device, rate_hz_, profile_);
      const experiments::RangeLimits limits =
          range_limits_of(device.can, experiments::RangeLimits{}.expected_speed_m_per_s);
      const std::vector<experiments::RangeEntry> range =
          experiments::planned_range(*study_, limits);
      std::optional<StabilityCheck> stability;
      if (device.stability) {
        stability =
            check_stability(*device.stability, *study_, range, limits.expected_speed_m_per_s);
      }
      return stimuli_line(range, limits, hides_levels_, stability);
    });
  }

  PreflightLine loop() {
    return line_from(tr("Loop"), tr("does not run"), [&] {
      return loop_line(test_loop(request_, rate_hz_, profile_, [this](double done) {
        control_.progress(kQuickRatio + (1.0 - kQuickRatio) * done);
        control_.stop_if_cancelled();
      }));
    });
  }

  /// The loop's test takes the rest of the time.
  static constexpr double kQuickRatio = 0.2;

  const PreflightRequest& request_;
  WorkControl& control_;
  const std::function<void(const std::vector<PreflightLine>&)>& on_lines_;
  std::vector<PreflightLine> lines_;
  std::optional<experiments::Study> study_;
  std::optional<KnownProfile> profile_;  ///< What was measured of the device.
  double rate_hz_ = 1000.0;
  bool hides_levels_ = true;
};

}  // namespace

std::vector<PreflightLine> look_before_session(
    const PreflightRequest& request, WorkControl& control,
    const std::function<void(const std::vector<PreflightLine>&)>& on_lines) {
  return Look(request, control, on_lines).run();
}

Preflight::Preflight(PreflightRequest request, std::function<void()> wake)
    : work_(
          [this, request = std::move(request)](WorkControl& control) mutable {
            request.emergency_stop = &emergency_stop_;
            (void)look_before_session(request, control,
                                      [this](const std::vector<PreflightLine>& lines) {
                                        const std::lock_guard guard(mutex_);
                                        lines_ = lines;
                                      });
          },
          std::move(wake)) {}

std::vector<PreflightLine> Preflight::lines() const {
  const std::lock_guard guard(mutex_);
  return lines_;
}

bool Preflight::passed() const {
  if (work_.status() != WorkStatus::kDone) return false;
  const std::vector<PreflightLine> all = lines();
  return std::none_of(all.begin(), all.end(), [](const PreflightLine& line) {
    return line.status == Status::kFailed || line.status == Status::kWaiting;
  });
}

std::vector<PreflightLine> look_at_machine() {
  std::vector<PreflightLine> lines = {
      line_of(check_realtime_priority(), tr("Real-time priority"), false),
      line_of(check_memory_lock(), tr("Memory lock"), false)};
  constexpr double kRate_hz = 1000.0;
  constexpr double kSession_s = 3600.0;
  if (const auto free = free_bytes(default_study_folder("study"))) {
    lines.push_back(disk_line(*free, kRate_hz, kSession_s));
  }
  std::string real;
  int num_simulated = 0;
  for (const device::DeviceEntry& entry : device::devices()) {
    if (!entry.argument.empty()) continue;
    const device::DeviceCapabilities can = entry.make("", kRate_hz)->capabilities();
    if (!can.simulated) {
      real += (real.empty() ? "" : ", ") + std::string(entry.name);
    } else if (device_line(std::string(entry.name), kRate_hz, 1).status == Status::kOk) {
      ++num_simulated;
    }
  }
  lines.push_back(
      real.empty() ? PreflightLine{.name = tr("Device"),
                                   .status = Status::kWarning,
                                   .found = tr("none connected, {} simulated", num_simulated)}
                   : PreflightLine{.name = tr("Device"), .status = Status::kOk, .found = real});
  return lines;
}

}  // namespace jnd::app
