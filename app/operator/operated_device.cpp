#include "app/operator/operated_device.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <thread>
#include <utility>

#include "app/commissioning/commissioning_report.h"
#include "app/commissioning/daily_check.h"
#include "app/commissioning/device_watch.h"
#include "app/commissioning/force_test.h"
#include "app/commissioning/guided_run.h"
#include "app/language/words.h"
#include "app/operator/device_look.h"
#include "app/operator/remembered_stop.h"
#include "app/profile/profile_choice.h"
#include "core/error.h"
#include "device/registry/device_registry.h"
#include "experiments/device_profile/profile_writer.h"

namespace jnd::app {
namespace {

using Act = DeviceQuestion::Act;

constexpr double kTriedForce_n = 0.5;

std::string mark_words(const Eigen::Vector3d& mark_m) {
  return tr(
      "Bring the first contact point to the mark at x {:.0f}, y {:.0f}, z {:.0f} mm, and hold "
      "it there.",
      1e3 * mark_m.x(), 1e3 * mark_m.y(), 1e3 * mark_m.z());
}

std::string moved_words(const ForceTestResult& result, int axis) {
  const char* there = axis == 0   ? tr("to the right")
                      : axis == 1 ? tr("away from the participant")
                                  : tr("upwards");
  constexpr double kSeen_m = 0.0005;
  if (result.moved_m > kSeen_m) {
    return tr("{:g} N {} moved it there, by {:.1f} mm. Was it that way?", kTriedForce_n, there,
              1e3 * result.moved_m);
  }
  if (result.moved_m < -kSeen_m) {
    return tr("{:g} N {} moved it the other way, by {:.1f} mm: something is of the wrong sign.",
              kTriedForce_n, there, -1e3 * result.moved_m);
  }
  return tr("{:g} N {} did not move it: its friction is larger, or no force came.",
            kTriedForce_n, there);
}

Eigen::Matrix3d rotation_in(const experiments::DeviceProfile& profile) {
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(
      profile.frame.rotation.data());
}

/// The frame of whichever profile is found, even an expired one; without any, the device's own
/// axes.
Eigen::Matrix3d frame_of(const DeviceOfProfile& device, const std::string& file) {
  if (!file.empty()) return rotation_in(read_known_profile(file).profile);
  const FoundProfile found = find_profile(device, profile_folders(), today());
  return found.known ? rotation_in(found.known->profile) : Eigen::Matrix3d::Identity();
}

std::vector<DeviceView::CheckedLine> lines_of(const DailyCheckResult& result) {
  std::vector<DeviceView::CheckedLine> lines;
  for (const CheckedQuantity& one : result.quantities) {
    lines.push_back({.what = tr(one.what),
                     .expected = expected_words(one),
                     .found = found_words(one) + " " + std::string(one.shown_unit),
                     .passed = one.passed()});
  }
  return lines;
}

}  // namespace

/// Asks the person at the window. For a simulated device, a simulated person then does what was
/// asked.
class OperatedDevice::WindowBench final : public device::Bench {
 public:
  WindowBench(OperatedDevice& of, device::Bench* simulated) : of_(of), simulated_(simulated) {}

  void take_hand_out() override {
    of_.ask({.act = Act::kTakeHandOut, .words = tr("Take every hand out of the device.")});
    if (simulated_ != nullptr) simulated_->take_hand_out();
  }
  void clamp() override {
    if (!is_held_) {
      of_.ask({.act = Act::kHold,
               .words = tr("Hold the tool where it is, or let it rest on something.")});
    }
    is_held_ = true;
    if (simulated_ != nullptr) simulated_->clamp();
  }
  void expect_force() override {
    if (!is_held_) return;
    of_.ask({.act = Act::kHold,
             .words = tr("Go on holding the tool where it is, fingers clear of its links: the "
                         "device will hold it, too, by a force that grows from nothing within "
                         "half a second.")});
  }
  void home() override {
    of_.ask(
        {.act = Act::kHome,
         .words = tr("Home the device as its maker says, by its maker's program if that takes "
                     "one: nothing here holds the device meanwhile. Then rest its tool where "
                     "it rested before.")});
    if (simulated_ != nullptr) simulated_->home();
  }
  void let_go_without_force() override {
    of_.ask(
        {.act = Act::kLetGo,
         .words = tr("The device has no force now: take the support away, let go of the tool "
                     "for a moment, and be ready to catch it.")});
    is_held_ = false;
    if (simulated_ != nullptr) simulated_->let_go_without_force();
  }
  void touch(const Eigen::Vector3d& mark_m) override {
    of_.ask({.act = Act::kTouch,
             .words = mark_words(mark_m),
             .mark_m = mark_m,
             .num_touched = num_touched_++});
    if (simulated_ != nullptr) simulated_->touch(mark_m);
  }
  void let_go() override {
    if (is_held_) {
      of_.ask({.act = Act::kLetGo,
               .words =
                   tr("The device holds the tool by its own force now: let go of it, and stand "
                      "clear.")});
    }
    is_held_ = false;
    if (simulated_ != nullptr) simulated_->let_go();
  }
  void hang(double load_kg) override {
    if (load_kg > 0.0) {
      of_.ask({.act = Act::kHang,
               .words = tr("Hang {:.0f} g from the tool.", 1e3 * load_kg),
               .load_kg = load_kg});
    } else {
      of_.ask({.act = Act::kTakeLoadOff, .words = tr("Take the load off the tool.")});
    }
    if (simulated_ != nullptr) simulated_->hang(load_kg);
  }

 private:
  OperatedDevice& of_;
  device::Bench* simulated_;
  bool is_held_ = false;
  int num_touched_ = 0;
};

OperatedDevice::OperatedDevice(std::function<void()> wake, bool allow_no_realtime,
                               std::filesystem::path stops)
    : wake_(std::move(wake)), allow_no_realtime_(allow_no_realtime), stops_(std::move(stops)) {}

OperatedDevice::~OperatedDevice() {
  leave_off();
  work_.reset();
}

MeasuringPlan OperatedDevice::plan() noexcept {
  return {.rate_hz = kDeviceRate_hz,
          .allow_no_realtime = allow_no_realtime_,
          .emergency_stop = &emergency_stop_,
          .watcher = &watcher_};
}

bool OperatedDevice::is_live() const noexcept {
  if (!works()) return false;
  const std::lock_guard lock(mutex_);
  return view_.work == DeviceWork::kMeasuring || view_.work == DeviceWork::kChecking ||
         view_.work == DeviceWork::kTryingForce || view_.work == DeviceWork::kWatching;
}

bool OperatedDevice::may_begin() const noexcept {
  return !works() && !emergency_stop_.is_pressed();
}

/// `work` returns how it ended.
void OperatedDevice::begin(DeviceWork kind, const std::function<std::string()>& work) {
  {
    const std::lock_guard lock(mutex_);
    view_.work = kind;
    view_.progress = 0.0;
    view_.now.clear();
    view_.question.reset();
    view_.outcome.clear();
    has_answer_ = false;
    leaves_off_ = false;
    own_press_ = 0;
  }
  work_ = std::make_unique<BackgroundWork>(
      [this, kind, work](WorkControl&) {
        std::string outcome;
        bool is_good = true;
        try {
          outcome = work();
        } catch (const std::exception& error) {
          outcome = error.what();
          is_good = false;
        }
        if (kind == DeviceWork::kLooking) return;
        DeviceView seen = look_at_device(device_, profile_, plan());
        const std::lock_guard lock(mutex_);
        const bool left = std::exchange(leaves_off_, false);
        if ((left || emergency_stop_.is_pressed()) && !is_good)
          outcome = tr("Stopped. What was measured before is kept.");
        seen.checked = std::move(view_.checked);
        seen.check_passed = view_.check_passed;
        seen.outcome = std::move(outcome);
        seen.outcome_of = kind;
        seen.outcome_is_good = is_good;
        view_ = std::move(seen);
        if (own_press_ != 0) (void)emergency_stop_.release(std::exchange(own_press_, 0));
      },
      wake_);
}

void OperatedDevice::choose(const std::string& device, const std::string& profile) {
  if (works()) return;
  device_ = device;
  profile_ = profile;
  if (is_stop_remembered(stops_, device_)) emergency_stop_.press();
  {
    const std::lock_guard lock(mutex_);
    if (view_.name != device) view_ = {.name = device};
  }
  begin(DeviceWork::kLooking, [this] {
    DeviceView seen = look_at_device(device_, profile_, plan());
    const std::lock_guard lock(mutex_);
    seen.checked = std::move(view_.checked);
    seen.check_passed = view_.check_passed;
    view_ = std::move(seen);
    return std::string();
  });
}

void OperatedDevice::measure_at(
    const std::function<void(device::HapticDevice&, device::Bench&)>& act) {
  const auto made = device::make_device(device_, kDeviceRate_hz);
  WindowBench asking(*this, made->bench());
  device::Bench* simulated = made->bench();
  device::Bench& bench = simulated != nullptr && !rehearses_ ? *simulated : asking;
  act(*made, bench);
}

void OperatedDevice::measure(CommissioningStep step) {
  if (!may_begin()) return;
  {
    const std::lock_guard lock(mutex_);
    view_.working_step = static_cast<std::size_t>(step);
  }
  begin(DeviceWork::kMeasuring, [this, step] {
    measure_at([&](device::HapticDevice& device, device::Bench& bench) {
      Commissioning commissioning(
          usual_record(device_),
          {.name = device_, .identity = device.identity(), .can = device.capabilities()},
          plan());
      commissioning.measure(step, device, bench,
                            [this](double done, const std::string& now) { tell(done, now); });
    });
    return tr("{}: measured, and on disk.", std::string(tr(words_of(step).title)));
  });
}

void OperatedDevice::undo(CommissioningStep step) {
  if (works()) return;
  begin(DeviceWork::kWriting, [this, step] {
    const auto made = device::make_device(device_, kDeviceRate_hz);
    Commissioning commissioning(
        usual_record(device_),
        {.name = device_, .identity = made->identity(), .can = made->capabilities()}, plan());
    commissioning.undo(step);
    return tr("{}: counts as not measured. The old measurement stays in the file.",
              std::string(tr(words_of(step).title)));
  });
}

void OperatedDevice::write_profile() {
  if (works()) return;
  begin(DeviceWork::kWriting, [this] {
    const auto made = device::make_device(device_, kDeviceRate_hz);
    const bool is_simulated = made->capabilities().simulated;
    const Commissioning commissioning(
        usual_record(device_),
        {.name = device_, .identity = made->identity(), .can = made->capabilities()}, plan());
    const CommissioningFiles files = write_commissioning_files(
        commissioning, made->identity(),
        folder_for_profile({}, commissioning.record(), is_simulated), JND_VERSION, today());
    return tr("The profile is written: {}, and a report: {}", files.profile.string(),
              files.report.html.string());
  });
}

void OperatedDevice::check_daily() {
  if (!may_begin()) return;
  {
    const std::lock_guard lock(mutex_);
    view_.checked.clear();
    view_.check_passed.reset();
  }
  begin(DeviceWork::kChecking, [this] {
    bool passed = false;
    measure_at([&](device::HapticDevice& device, device::Bench& bench) {
      const bool is_simulated = device.capabilities().simulated;
      std::vector<std::filesystem::path> folders = profile_folders();
      if (is_simulated) {
        folders.insert(folders.begin(), folder_for_profile({}, usual_record(device_), true));
      }
      const KnownProfile known =
          profile_to_check(device_of_profile(device_, device), profile_, folders, today());
      const DailyCheckResult result =
          app::check_daily(device, bench, plan(), known.profile,
                           std::max(today(), experiments::last_checked_on(known.profile)),
                           [this](double done, const std::string& now) { tell(done, now); });
      experiments::add_daily_check(known.place, result.kept);
      passed = result.passed();
      const std::lock_guard lock(mutex_);
      view_.checked = lines_of(result);
      view_.check_passed = passed;
    });
    return std::string(
        passed ? tr("Passed: the device is as its profile says. That is kept in the profile.")
               : tr("Failed: no session begins with this profile until a check is passed. Look "
                    "for the reason, then check again, or measure the device anew."));
  });
}

void OperatedDevice::try_force(int axis) {
  if (!may_begin() || axis < 0 || axis > 2) return;
  begin(DeviceWork::kTryingForce, [this, axis] {
    std::string words;
    measure_at([&](device::HapticDevice& device, device::Bench& bench) {
      const ForceTest test{.along = Eigen::Vector3d::Unit(axis),
                           .force_n = kTriedForce_n,
                           .rotation = frame_of(device_of_profile(device_, device), profile_)};
      words = moved_words(
          test_force(device, bench, plan(), test,
                     [this](double done, const std::string& now) { tell(done, now); }),
          axis);
    });
    return words;
  });
}

void OperatedDevice::watch() {
  if (!may_begin()) return;
  begin(DeviceWork::kWatching, [this] {
    const auto made = device::make_device(device_, kDeviceRate_hz);
    // The device is never armed, so whoever moves its tool or presses its switch feels no
    // force.
    GuidedRun run(*made, {.rate_hz = kDeviceRate_hz,
                          .allow_no_realtime = allow_no_realtime_,
                          .emergency_stop = &emergency_stop_,
                          .watcher = &watcher_});
    constexpr double kLook_s = 0.05;
    while (true) {
      const core::Fault found = run.try_for(kLook_s);
      std::vector<DeviceLine> live;
      for (WatchedLine& line : watched_lines(made->capabilities(), run.telemetry())) {
        live.push_back({std::move(line.what), std::move(line.value)});
      }
      {
        const std::lock_guard lock(mutex_);
        if (leaves_off_) return std::string();
        view_.live = std::move(live);
      }
      if (wake_) wake_();
      if (core::is_failure(found)) throw core::Error(tr(core::words(found).data()));
      // A simulated device would otherwise run as fast as it can.
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
  });
}

void OperatedDevice::tell(double done, const std::string& now) {
  {
    const std::lock_guard lock(mutex_);
    view_.progress = done;
    view_.now = tr(now.c_str());
  }
  if (wake_) wake_();
}

/// Called by the thread that measures. Throws `core::Error` if somebody ends the work.
void OperatedDevice::ask(DeviceQuestion question) {
  std::unique_lock lock(mutex_);
  view_.question = std::move(question);
  has_answer_ = false;
  lock.unlock();
  if (wake_) wake_();
  lock.lock();
  answered_.wait(lock,
                 [this] { return has_answer_ || leaves_off_ || emergency_stop_.is_pressed(); });
  view_.question.reset();
  if (!has_answer_ || leaves_off_ || emergency_stop_.is_pressed()) {
    throw core::Error(tr("stopped; what was measured is kept"));
  }
}

void OperatedDevice::answer() {
  {
    const std::lock_guard lock(mutex_);
    if (!view_.question) return;
    has_answer_ = true;
  }
  answered_.notify_all();
}

void OperatedDevice::leave_off() {
  if (!works()) return;
  {
    const std::lock_guard lock(mutex_);
    leaves_off_ = true;
    // The loop ends the force as for any stop; this stop is released when the step has ended.
    if (!emergency_stop_.is_pressed()) {
      emergency_stop_.press();
      own_press_ = emergency_stop_.num_presses();
    }
  }
  answered_.notify_all();
}

void OperatedDevice::press_stop() noexcept {
  emergency_stop_.press();
  // Wakes the thread that waits for an answer. The lock makes sure that it is already waiting,
  // or has yet to look.
  { const std::lock_guard lock(mutex_); }
  answered_.notify_all();
  // Last: the disk may take its time.
  remember_stop(stops_, device_);
}

void OperatedDevice::release_stop() noexcept {
  if (works()) return;
  if (emergency_stop_.release(emergency_stop_.num_presses())) forget_stop(stops_, device_);
}

DeviceView OperatedDevice::view() {
  const std::lock_guard lock(mutex_);
  DeviceView now = view_;
  if (!works()) {
    now.work = DeviceWork::kNone;
    now.question.reset();
  }
  now.stop_is_pressed = emergency_stop_.is_pressed() && own_press_ == 0;
  return now;
}

}  // namespace jnd::app
