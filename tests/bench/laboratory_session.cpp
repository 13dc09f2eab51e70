#include "bench/laboratory_session.h"

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>

#include "app/operator/answer_controls.h"
#include "app/operator/session_worker.h"
#include "app/session/session_setup.h"
#include "experiments/participants/thesis_laboratory.h"
#include "experiments/protocol/study_reader.h"
#include "support/files.h"

namespace jnd::bench {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

/// The study has more trials than a day allows. The session is ended when its time is over.
constexpr char kLaboratoryStudy[] = R"json({
  "format": 1, "name": "laboratory", "languages": ["en"], "title": {"en": "Laboratory"},
  "authors": ["A. Author"],
  "masking_noise": {"kind": "pink", "level_dbfs": -30, "required": true},
  "cues": [{"moment": "ready", "frequency_hz": 500, "level_dbfs": -30},
           {"moment": "begin", "frequency_hz": 1000, "level_dbfs": -30},
           {"moment": "end", "frequency_hz": 800, "level_dbfs": -30}],
  "device": {"min_contact_points": 1, "rate_hz": 1000, "ramp_s": 0.05, "max_missed_ratio": 1},
  "stages": [
    {"kind": "block", "name": "comparison", "procedure": "constant_stimuli",
     "answered_by": "participant", "medium": "viscous", "viscosity_pa_s": [4, 6, 10, 16],
     "reference_viscosity_pa_s": 8, "repetitions": 500, "free_space_between_s": 0,
     "instruction": {"en": "Compare."}, "question": {"en": "Thicker?"}, "expected_trial_s": 3}]
})json";

/// Returns the study. Without sound, it does not require the noise, so that the session begins
/// nevertheless.
std::string laboratory_study(bool has_sound) {
  std::string text = kLaboratoryStudy;
  const std::string required = ", \"required\": true";
  if (!has_sound) text.erase(text.find(required), required.size());
  return text;
}

/// Knows when the newest picture of the session came.
class LatestPicture {
 public:
  void came() {
    {
      const std::lock_guard guard(mutex_);
      came_ns_ =
          std::chrono::duration_cast<std::chrono::nanoseconds>(Clock::now().time_since_epoch())
              .count();
    }
    something_.notify_one();
  }
  /// Returns when a picture came, or nothing if none came within 4 ms, which is far less than a
  /// window may be silent.
  std::optional<std::int64_t> wait() {
    std::unique_lock lock(mutex_);
    something_.wait_for(lock, std::chrono::milliseconds(4), [this] { return came_ns_ != 0; });
    const std::int64_t came_ns = std::exchange(came_ns_, 0);
    return came_ns == 0 ? std::nullopt : std::optional(came_ns);
  }

 private:
  std::mutex mutex_;
  std::condition_variable something_;
  std::int64_t came_ns_ = 0;
};

void say(const char* what, const std::string& words) {
  std::printf("%s %s\n", what, words.c_str());
  std::fflush(stdout);
}

class LaboratoryOperator {
 public:
  explicit LaboratoryOperator(const LaboratorySession& wanted)
      : wanted_(wanted), folder_(wanted.folder / "a.study") {
    const fs::path file = test_support::write_file(wanted.folder / "laboratory.json",
                                                   laboratory_study(wanted.has_everything));
    experiments::Study study = experiments::read_study(file);
    auto store = std::make_unique<core::StudyStore>(folder_, core::StudyStore::Mode::kCreate);
    auto laboratory =
        std::make_unique<experiments::Laboratory>(experiments::thesis_laboratory());
    const std::int64_t session = app::add_sessions(*store,
                                                   {.study = study,
                                                    .laboratory = laboratory.get(),
                                                    .study_file = file,
                                                    .device = "lumped",
                                                    .seed = 7,
                                                    .realtime = true,
                                                    .allow_no_realtime = true},
                                                   {"P01"})
                                     .front();
    study_id_ = store->study_id();
    app::AnswerControls::Parameters controls{
        .file = wanted.folder / "controls.json",
        .reader = {.folder = wanted.folder / "no_input_devices"}};
    core::WantedStreams streams;
    core::WantedMarkers markers;
    if (wanted.has_everything) {
      controls.reader.serial_boxes = {{.path = wanted.answer_port, .baud = 9600}};
      streams = {.markers = true,
                 .samples = true,
                 .inlets = {"name=" + wanted.stream_name},
                 .peers = {"127.0.0.1"}};
      markers = {.port = wanted.marker_port, .width_s = 0.005};
    }
    controls_ = std::make_unique<app::AnswerControls>(std::move(controls));
    worker_ = std::make_unique<app::SessionWorker>(
        app::SessionWorker::Parameters{
            .store = std::move(store),
            .session = session,
            .study = std::move(study),
            .laboratory = std::move(laboratory),
            .language = "",
            .allow_no_realtime = true,
            .streams = streams,
            .sound = {.output = wanted.has_everything ? "headphones" : app::kSoundOff},
            .markers = markers,
            .wake = [this] { picture_.came(); }},
        exchange_);
    if (!wanted.has_everything) return;
    for (const LaboratoryPress& press : kLaboratoryPresses) {
      controls_->set(press.action, {.device = "serial " + wanted.answer_port,
                                    .name = "byte " + std::to_string(press.byte)});
    }
    controls_->begin_session(
        [this](const app::operate::UseControl& use) { worker_->request(use); });
  }
  ~LaboratoryOperator() {
    controls_->end_session();
    worker_.reset();
  }
  LaboratoryOperator(const LaboratoryOperator&) = delete;
  LaboratoryOperator& operator=(const LaboratoryOperator&) = delete;

  int run() {
    while (!worker_->over()) {
      exchange_.heartbeat.beat();
      if (const auto came_ns = picture_.wait()) look_at(*came_ns);
      if (begun_) press_what_is_due();
    }
    if (!worker_->failure().empty()) {
      std::fprintf(stderr, "%s\n", worker_->failure().c_str());
      return 1;
    }
    return 0;
  }

 private:
  void look_at(std::int64_t came_ns) {
    const auto view = worker_->view();
    if (view == nullptr) return;
    if (view->step == app::Step::kBegin && !has_asked_) {
      has_asked_ = true;
      worker_->request(app::operate::Begin{});
    } else if (view->step != app::Step::kBegin && !begun_) {
      begun_ = Clock::now();
      say("SESSION", study_id_);
    }
    if (view->trials_on_disk > num_stored_) {
      num_stored_ = view->trials_on_disk;
      say("STORED", std::to_string(num_stored_) + " " + std::to_string(came_ns));
    }
    if (view->doubt) worker_->request(app::operate::StoreDoubted{view->doubt->trial});
    if (view->num_refusals > num_refusals_) {
      num_refusals_ = view->num_refusals;
      std::fprintf(stderr, "refused: %s\n", view->refusal.c_str());
    }
    if (view->step == app::Step::kFault || view->step == app::Step::kFailed) {
      std::fprintf(stderr, "%s %s\n", view->sentence.c_str(), view->fault.c_str());
      worker_->request(app::operate::Leave{"a fault"});
    }
    if (view->step == app::Step::kFinished) worker_->request(app::operate::Leave{""});
  }

  /// Without a pedal, presses at the same moments in place of a person at the window.
  void press_what_is_due() {
    const double since_s = std::chrono::duration<double>(Clock::now() - *begun_).count();
    if (since_s > wanted_.duration_s) {
      if (!std::exchange(has_ended_, true)) {
        worker_->request(app::operate::EndEarly{"its time is over"});
      }
      return;
    }
    if (wanted_.has_everything) return;
    const auto& press = kLaboratoryPresses[num_presses_ % std::size(kLaboratoryPresses)];
    const auto cycle = static_cast<double>(num_presses_ / std::size(kLaboratoryPresses));
    if (since_s < cycle * kLaboratoryCycle_s + press.at_s) return;
    ++num_presses_;
    worker_->request(app::operate::UseControl{press.action, "", 0});
  }

  const LaboratorySession& wanted_;
  fs::path folder_;
  std::string study_id_;
  app::OperatorExchange exchange_;
  LatestPicture picture_;
  std::unique_ptr<app::AnswerControls> controls_;
  std::unique_ptr<app::SessionWorker> worker_;
  std::optional<Clock::time_point> begun_;
  bool has_asked_ = false, has_ended_ = false;
  std::int64_t num_stored_ = 0;
  std::uint64_t num_refusals_ = 0;
  std::size_t num_presses_ = 0;
};

}  // namespace

int run_laboratory_session(const LaboratorySession& session) {
  return LaboratoryOperator(session).run();
}

}  // namespace jnd::bench
