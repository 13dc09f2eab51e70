#include <algorithm>
#include <atomic>
#include <memory>
#include <optional>
#include <thread>
#include <utility>

#include "app/operator/realtime_session_fixture.h"
#include "core/error.h"
#include "core/storage/integrity.h"
#include "device/network/device_server.h"
#include "device/network/udp_port.h"
#include "device/registry/device_registry.h"
#include "support/wide_profile.h"

namespace jnd::app {
namespace network_session_test {

/// The lumped hand, which here claims to be a device that can hurt somebody.
class HurtfulHand final : public device::HapticDevice {
 public:
  [[nodiscard]] std::string_view name() const noexcept override { return "hurtful"; }
  [[nodiscard]] device::DeviceCapabilities capabilities() const noexcept override {
    device::DeviceCapabilities can = hand_->capabilities();
    can.simulated = false;
    can.tells_acting_force = true;
    return can;
  }
  void open() override { hand_->open(); }
  [[nodiscard]] bool read(core::HapticState& state) noexcept override {
    const bool is_read = hand_->read(state);
    state.acted_n = acted_n_;
    return is_read;
  }
  [[nodiscard]] bool write(const core::PointVectors& force_n) noexcept override {
    acted_n_ = force_n;
    return hand_->write(force_n);
  }
  void close() noexcept override { hand_->close(); }
  void halt() noexcept override { hand_->halt(); }

 private:
  std::unique_ptr<device::HapticDevice> hand_ = device::make_device("lumped", 1000.0);
  core::PointVectors acted_n_ = core::zero_vectors();
};

/// A simulated hand across the network, with a clock of its own. When it is destroyed it
/// disappears silently, like a killed process.
class ServedHand {
 public:
  /// Port 0 is any free port.
  explicit ServedHand(std::uint64_t first_stream_id, std::uint16_t port = 0,
                      std::unique_ptr<device::HapticDevice> hand = device::make_device("lumped",
                                                                                       1000.0))
      : device_(std::move(hand)),
        port_(device::resolved({.host = "127.0.0.1", .port = port})),
        server_(*device_, port_,
                {.watchdog_s = 0.100,
                 .max_answer_age_s = 0.120,
                 .first_stream_id = first_stream_id}) {
    device_->open();
    thread_ = std::thread([this] {
      while (!killed_) {
        server_.step(port_.now_ns());
        server_.renew_device();
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      }
    });
  }
  ~ServedHand() {
    killed_ = true;
    thread_.join();
  }
  ServedHand(const ServedHand&) = delete;
  ServedHand& operator=(const ServedHand&) = delete;

  [[nodiscard]] std::string place() const { return device::text_of(port_.local()); }

 private:
  std::unique_ptr<device::HapticDevice> device_;
  device::UdpPort port_;
  device::DeviceServer server_;
  std::atomic<bool> killed_{false};
  std::thread thread_;
};

/// Tests an operator whose device is at the other end of a network.
class NetworkSessionTest : public RealtimeSessionTest {
 protected:
  ~NetworkSessionTest() override { session_.reset(); }

  /// Continues to the first trial, in real time.
  SessionView begin() {
    hand_.emplace(1);
    device_ = "network:" + hand_->place() + ",simulated";
    open_window();
    open(kTwoTrials);
    session_->request(operate::Begin{});
    return until([](const SessionView& now) { return now.step == Step::kReady; });
  }

  /// Kills the device, which raises a fault.
  void kill_device() {
    hand_.reset();
    until([](const SessionView& now) { return now.step == Step::kFault; });
  }
  /// Arms as often as necessary, because a connection has to be good for a while first.
  SessionView rearm() {
    return until([this](const SessionView& now) {
      if (now.step == Step::kFault) session_->request(operate::Rearm{now.telemetry.num_faults});
      return now.step != Step::kFault;
    });
  }
  void restart_device() {
    const std::string port = device_.substr(device_.rfind(':') + 1);
    hand_.emplace(2, static_cast<std::uint16_t>(std::stoi(port)));
  }

  /// Presents and answers the trial, and returns what comes next.
  SessionView answer(std::int64_t trial) {
    present(trial, "test");
    session_->request(operate::Answer{trial, 12.0});
    return until([&](const SessionView& now) {
      return now.step == Step::kStageDone || (now.trial && now.trial->trial != trial);
    });
  }

  void expect_both_trials_stored_once() {
    session_->request(operate::FinishStage{view().stage, ""});
    until([](const SessionView& now) { return now.step == Step::kFinished; });
    session_.reset();
    const std::vector<core::TrialRow> trials = store_->trials(session_number_);
    ASSERT_EQ(trials.size(), 2U);
    for (const core::TrialRow& trial : trials) EXPECT_EQ(trial.response, 12.0);
    EXPECT_TRUE(store_->completed(session_number_));
    EXPECT_TRUE(core::verify(*store_).problems.empty());
  }

  static constexpr const char* kTwoTrials = R"json({
    "format": 1, "name": "two", "languages": ["en"], "title": {"en": "Two"},
    "authors": ["A. Author"],
    "device": {"min_contact_points": 1, "rate_hz": 1000, "ramp_s": 0.05},
    "stages": [
      {"kind": "block", "name": "estimation", "procedure": "magnitude_estimation",
       "medium": "water", "scale": [1, 2], "repetitions": 1, "free_space_between_s": 0,
       "instruction": {"en": "Say."}, "question": {"en": "How strong?"},
       "expected_trial_s": 5}]})json";
  std::optional<ServedHand> hand_;
};

TEST_F(NetworkSessionTest, GoesOnWhenTheDeviceIsBackAfterItDiedInATrial) {
  const std::int64_t trial = begin().trial->trial;
  present(trial, "test");
  kill_device();
  EXPECT_NE(view().fault.find("connection to the device"), std::string::npos) << view().fault;
  EXPECT_EQ(store_->trials(session_number_).size(), 0U);

  restart_device();
  const SessionView armed = rearm();
  ASSERT_EQ(armed.step, Step::kReady) << "the trial is felt again from its start, later";
  EXPECT_NE(armed.trial->trial, trial);
  EXPECT_FALSE(armed.trial->can_answer) << "what was felt before the fault does not count";
  EXPECT_EQ(answer(armed.trial->trial).trial->trial, trial);
  answer(trial);
  expect_both_trials_stored_once();
}

TEST_F(NetworkSessionTest, NobodyToArmIsToldAsOftenAsItIsTried) {
  const std::int64_t trial = begin().trial->trial;
  present(trial, "test");
  kill_device();
  for (int attempt = 0; attempt < 2; ++attempt) {
    session_->request(operate::Rearm{view().telemetry.num_faults});
    const auto patience = std::chrono::steady_clock::now() + std::chrono::milliseconds(300);
    while (std::chrono::steady_clock::now() < patience) session_->advance(0.0);
    EXPECT_EQ(view().step, Step::kFault);
    EXPECT_EQ(force_n(view().telemetry.total_force_n), 0.0);
  }
  session_->request(operate::Leave{});
  until([this](const SessionView&) { return session_->over(); });
  session_.reset();
  EXPECT_FALSE(store_->finished(session_number_));
  EXPECT_TRUE(core::verify(*store_).problems.empty());
}

TEST_F(NetworkSessionTest, ResumesInANewProgramAfterTheDeviceDiedInAPause) {
  const SessionView second = answer(begin().trial->trial);
  session_->request(operate::Pause{"a look at the machine"});
  until([](const SessionView& now) { return now.step == Step::kPaused; });
  kill_device();
  session_->request(operate::Leave{});
  until([this](const SessionView&) { return session_->over(); });
  session_.reset();

  restart_device();
  reopen();
  session_->request(operate::Begin{"repeat"});
  const SessionView again = until([](const SessionView& now) {
    return now.step == Step::kReady || now.step == Step::kPaused;
  });
  ASSERT_EQ(again.step, Step::kReady);
  EXPECT_EQ(again.trial->trial, second.trial->trial);
  answer(again.trial->trial);
  expect_both_trials_stored_once();
}

/// As SAFETY.md says, the program does not even open an unmeasured real device for a study with
/// force.
TEST_F(NetworkSessionTest, ARealDeviceWithoutAProfileIsNotOpenedForAStudyWithForce) {
  hand_.emplace(1, 0, std::make_unique<HurtfulHand>());
  device_ = "network:" + hand_->place();
  open_window();
  try {
    open(kTwoTrials);
    FAIL() << "opened";
  } catch (const core::Error& error) {
    EXPECT_NE(std::string(error.what()).find("expected a profile of the device"),
              std::string::npos)
        << error.what();
  }
  EXPECT_TRUE(store_->events(session_number_).empty());
}

TEST_F(NetworkSessionTest, ARealDeviceRunsByTheProfileThatTheSessionKeeps) {
  hand_.emplace(1, 0, std::make_unique<HurtfulHand>());
  device_ = "network:" + hand_->place();
  profile_ = {.profile = test_support::wide_profile("hurtful"),
              .text = experiments::device_profile_text(test_support::wide_profile("hurtful"))};
  open_window();
  open(kTwoTrials);
  EXPECT_FALSE(store_->session(session_number_).device_profile_sha256.empty());
  session_->request(operate::Begin{});
  until([](const SessionView& now) { return now.step != Step::kBegin; });
  // What the device says about itself is stored as well.
  const std::vector<core::EventRow> events = store_->events(session_number_);
  EXPECT_TRUE(std::any_of(events.begin(), events.end(), [](const core::EventRow& event) {
    return event.kind == "loop_started" &&
           event.data.find(R"("model":"hurtful")") != std::string::npos;
  }));
}

/// Nobody feels anything in a list, and nobody has to lie in an armed device to read a consent.
TEST_F(NetworkSessionTest, ListsAndConsentComeBeforeTheDeviceIsArmed) {
  hand_.emplace(1, 0, std::make_unique<HurtfulHand>());
  device_ = "network:" + hand_->place();
  profile_ = {.profile = test_support::wide_profile("hurtful"),
              .text = experiments::device_profile_text(test_support::wide_profile("hurtful"))};
  open_window();
  open(R"json({
    "format": 1, "name": "lists", "languages": ["en"], "title": {"en": "Lists"},
    "authors": ["A. Author"],
    "device": {"min_contact_points": 1, "rate_hz": 1000, "ramp_s": 0.05},
    "stages": [
      {"kind": "checklist", "name": "before", "title": {"en": "Before"},
       "items": [{"text": {"en": "Look at the device."}}]},
      {"kind": "consent", "name": "consent", "title": {"en": "Consent"},
       "paragraphs": [{"en": "You feel fluids."}], "agreement": {"en": "I agree."}},
      {"kind": "block", "name": "estimation", "procedure": "magnitude_estimation",
       "medium": "water", "scale": [1, 2], "repetitions": 1, "free_space_between_s": 0,
       "instruction": {"en": "Say."}, "question": {"en": "How strong?"},
       "expected_trial_s": 5}]})json");
  until([](const SessionView& now) { return now.telemetry.num_ticks > 0; });
  EXPECT_EQ(view().step, Step::kBegin);
  EXPECT_TRUE(view().is_disarmed);
  session_->request(operate::Begin{});
  const SessionView list =
      until([](const SessionView& now) { return now.step == Step::kItem; });
  EXPECT_TRUE(list.is_disarmed);
  session_->request(operate::Pause{});
  until([](const SessionView& now) { return now.step == Step::kPaused; });
  session_->request(operate::GoOn{});
  until([](const SessionView& now) { return now.step == Step::kItem; });
  session_->request(operate::AnswerItem{list.stage, list.item->name, "done"});
  const SessionView consent = until([](const SessionView& now) {
    return now.item && now.item->kind == ItemView::Kind::kConsent;
  });
  session_->request(operate::AnswerItem{consent.stage, consent.item->name, "given"});
  const SessionView block =
      until([](const SessionView& now) { return now.step == Step::kFault; });
  EXPECT_TRUE(block.is_disarmed);
  EXPECT_EQ(block.telemetry.arming, core::Arming::kDisarmed);
  session_->request(operate::Present{1, "test"});
  session_->advance(0.0);
  EXPECT_EQ(view().refusal, "the device has to be armed first");
  session_->request(operate::Rearm{view().telemetry.num_faults});
  const SessionView ready =
      until([](const SessionView& now) { return now.step == Step::kReady; });
  EXPECT_FALSE(ready.is_disarmed);
  EXPECT_TRUE(std::ranges::none_of(store_->events(session_number_), [](const auto& event) {
    return event.kind == "fault_raised";
  }));
}

/// A connection may be armed only after it has been good for a while, and `arm` waits for that.
TEST(NetworkArming, ADeviceThatCanHurtIsArmedWhereSomebodySaysSo) {
  for (const bool arm : {false, true}) {
    ServedHand hand(1, 0, std::make_unique<HurtfulHand>());
    Apparatus::Parameters parameters;
    parameters.device = "network:" + hand.place();
    parameters.realtime = true;
    parameters.allow_no_realtime = true;
    parameters.arm = arm;
    int num_told = 0;
    parameters.before_arming = [&num_told] { ++num_told; };
    const Apparatus apparatus(parameters);
    EXPECT_EQ(num_told, arm ? 1 : 0);
    EXPECT_FALSE(apparatus.is_simulated());
    if (!arm) std::this_thread::sleep_for(std::chrono::milliseconds(300));
    const core::Arming found = apparatus.telemetry().arming;
    EXPECT_EQ(found == core::Arming::kArming || found == core::Arming::kArmed, arm)
        << core::words(apparatus.telemetry().fault);
  }
}

TEST(NetworkArming, WhoCannotBeArmedForOtherReasonsIsNotAboutToBe) {
  ServedHand hand(1, 0, std::make_unique<HurtfulHand>());
  Apparatus::Parameters parameters;
  parameters.device = "network:" + hand.place();
  parameters.realtime = true;
  parameters.allow_no_realtime = true;
  parameters.arm = true;
  parameters.wants_profile = true;  // There is none.
  bool is_told = false;
  parameters.before_arming = [&is_told] { is_told = true; };
  EXPECT_THROW(Apparatus{parameters}, core::Error);
  EXPECT_FALSE(is_told);
}

}  // namespace network_session_test
}  // namespace jnd::app
