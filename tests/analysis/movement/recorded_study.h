#pragma once

#include <functional>
#include <numbers>
#include <optional>
#include <string>

#include "core/storage/recording.h"
#include "core/storage/study_store.h"
#include "support/temporary_folder.h"

namespace jnd::analysis {

/// Writes a study folder with a recording. Its presentations are even strokes of 1 s, 0.4 m
/// wide along x, in a viscous fluid of whose force 90 % is delivered.
class RecordedStudy {
 public:
  static constexpr double kWidthM = 0.4;
  static constexpr double kDampingPerPaS = 1.776;
  /// It returns whether the sample is recorded.
  using Change = std::function<bool(core::Sample&)>;

  explicit RecordedStudy(double delivered_ratio = 0.9)
      : store_(folder(), core::StudyStore::Mode::kCreate, core::Durability::kAtClose),
        hash_(store_.add_protocol("r.json", R"({"name":"r","device":{"ramp_s":0.1}})")),
        delivered_ratio_(delivered_ratio) {}

  [[nodiscard]] std::filesystem::path folder() const { return temporary_.path() / "r.study"; }
  [[nodiscard]] const core::StudyStore& store() const { return store_; }

  std::int64_t add(const std::string& participant, bool pilot = false, bool recorded = true) {
    finish();
    sequence_ = trial_ = tick_ = 0;
    session_ =
        store_.add_session({.participant = participant,
                            .protocol_sha256 = hash_,
                            .pilot = pilot,
                            .simulated = true,
                            .laboratory = R"({"movement":{"surface_height_m":{"value":1.5}}})",
                            .rate_hz = 1000.0,
                            .recorded = recorded});
    if (recorded) writer_.emplace(store_.recording_file(session_), 1000.0);
    return session_;
  }
  void answer_height(const std::string& text) {
    core::Commit commit = event("item_answered");
    commit.answers.push_back({.session = session_,
                              .sequence = sequence_,
                              .stage = "about_you",
                              .item = "body_height_m",
                              .answer = text});
    store_.append(commit);
  }

  /// A trial with one presentation of each interval, which is answered "yes".
  struct Trial {
    std::string block = "group_d";
    std::string procedure = "constant_stimuli";
    std::string medium = "viscous";
    double intensity = 2.0;
    std::optional<double> reference = 1.0;
    std::int64_t repetition = 1;
    std::int64_t num_ticks = 5600;  ///< The length of each presentation.
  };
  void present(const Trial& trial, const Change& change = nullptr) {
    core::Commit drawn = event("trials_drawn");
    drawn.design.push_back({.session = session_,
                            .trial = ++trial_,
                            .block = trial.block,
                            .procedure = trial.procedure,
                            .medium = trial.medium,
                            .quantity = "viscosity_pa_s",
                            .repetition = trial.repetition,
                            .intensity = trial.intensity,
                            .reference_intensity = trial.reference});
    store_.append(drawn);
    rest(1000);
    std::int64_t presentation = 0;
    if (trial.reference) {
      stroke(trial, "reference", *trial.reference, ++presentation, change);
    }
    stroke(trial, "test", trial.intensity, ++presentation, change);
    core::Commit answered = event("trial_answered");
    answered.event.trial = trial_;
    answered.event.attempt = 1;
    answered.trial = core::TrialRow{.session = session_,
                                    .trial = trial_,
                                    .attempt = 1,
                                    .sequence = sequence_,
                                    .block = trial.block,
                                    .procedure = trial.procedure,
                                    .medium = trial.medium,
                                    .quantity = "viscosity_pa_s",
                                    .repetition = trial.repetition,
                                    .intensity = trial.intensity,
                                    .reference_intensity = trial.reference,
                                    .response = 1.0};
    store_.append(answered);
  }
  void explore(const std::string& medium, double intensity, std::int64_t num_ticks) {
    core::Commit explored = event("medium_explored");
    explored.event.intensity = intensity;
    explored.event.first_tick = tick_;
    record(num_ticks, intensity, nullptr);
    explored.event.last_tick = tick_ - 1;
    explored.event.data = R"({"medium":")" + medium + R"("})";
    store_.append(explored);
  }
  void exclude(std::int64_t trial) {
    core::Commit excluded = event("trial_excluded");
    excluded.event.trial = trial;
    store_.append(excluded);
  }
  /// Writes everything to the file.
  void finish() {
    if (writer_) writer_->flush();
    writer_.reset();
  }

 private:
  core::Commit event(const char* kind) {
    core::Commit commit;
    commit.event.session = session_;
    commit.event.sequence = ++sequence_;
    commit.event.kind = kind;
    return commit;
  }

  void rest(std::int64_t num_ticks) { tick_ += num_ticks; }

  void stroke(const Trial& trial, const std::string& interval, double intensity,
              std::int64_t presentation, const Change& change) {
    core::Commit ended = event("presentation_ended");
    const std::int64_t first_tick = tick_;
    record(trial.num_ticks, intensity, change);
    ended.presentation = core::PresentationRow{
        .session = session_,
        .trial = trial_,
        .attempt = 1,
        .presentation = presentation,
        .sequence = sequence_,
        .interval = interval,
        .intensity = intensity,
        .first_tick = first_tick,
        .last_tick = tick_ - 1,
        .measures = {
            .delivered_damping_n_s_per_m = kDampingPerPaS * intensity * delivered_ratio_,
            .commanded_damping_n_s_per_m = kDampingPerPaS * intensity}};
    store_.append(ended);
  }

  void record(std::int64_t num_ticks, double viscosity_pa_s, const Change& change) {
    for (std::int64_t i = 0; i < num_ticks; ++i) {
      const double phase = 2.0 * std::numbers::pi * static_cast<double>(i) / 1000.0;
      core::Sample sample{.tick = tick_++, .attached_bits = 31, .immersed_bits = 31};
      const double velocity_m_per_s = kWidthM * std::numbers::pi * std::cos(phase);
      for (int point = 0; point < core::kNumContactPoints; ++point) {
        sample.tip_position_m[point] = {0.5 * kWidthM * std::sin(phase), 0.01 * point, -0.5};
        sample.tip_velocity_m_per_s[point] = {velocity_m_per_s, 0.0, 0.0};
        sample.tip_force_n[point] = {-delivered_ratio_ * kDampingPerPaS * viscosity_pa_s *
                                         velocity_m_per_s / core::kNumContactPoints,
                                     0.0, 0.0};
      }
      sample.end_effector_position_m = {sample.tip_position_m[0][0], -0.3, -0.5};
      if (writer_ && (!change || change(sample))) writer_->append(sample);
    }
  }

  test_support::TemporaryFolder temporary_{test_support::memory_folder()};
  core::StudyStore store_;
  std::string hash_;
  double delivered_ratio_;
  std::optional<core::RecordingWriter> writer_;
  std::int64_t session_ = 0, trial_ = 0, sequence_ = 0, tick_ = 0;
};

}  // namespace jnd::analysis
