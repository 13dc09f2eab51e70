#pragma once

#include <cstdint>

#include "app/session/apparatus.h"
#include "app/session/attachment_watch.h"
#include "app/session/laboratory_run.h"
#include "app/session/presenter.h"
#include "experiments/participants/simulated_participant.h"
#include "experiments/session/session.h"

namespace jnd::app {

/// Thrown from within a session that was asked to stop.
struct Cancelled {};

/// Throws `Cancelled` if the run was asked to stop.
void stop_if_cancelled(const LaboratoryRun& run);

/// Plays a simulated participant at the apparatus: explores media and runs trials of every
/// procedure. Each presentation runs in closed loop, and every act is an event of the session.
/// Throws `Cancelled` between acts and between the strokes of a presentation. Not real time.
class TrialPlayer {
 public:
  /// The references must outlive the player.
  TrialPlayer(const LaboratoryRun& run, Apparatus& apparatus, experiments::Session& session,
              const experiments::SimulatedParticipant& participant)
      : run_(run),
        apparatus_(apparatus),
        session_(session),
        participant_(participant),
        presenter_(apparatus, session, run.study.device) {}

  /// Explores a medium outside of any trial.
  void explore(const experiments::Exploration& exploration);
  /// Runs the session's current trial to its answer. If a finger comes off, it is put back; if
  /// the loop misses more ticks than the study allows, the attempt does not count. In both
  /// cases the trial comes again later, see `Session::put_off_attempt`. Throws `core::Error` if
  /// ticks are missed three times in a row. An answer that misses the block's deadline also
  /// ends the attempt, at the deadline.
  void run_trial(const experiments::Block& block);
  /// Answers the questions that wait after a trial, also after one before an interruption.
  void answer_questions(const experiments::Block& block);

 private:
  struct Felt {
    /// A damping in N s/m, or for a solid its stiffness in N/m.
    double amount = 0.0;
    std::int64_t last_tick = 0;
    double duration_s = 0.0;
  };

  [[nodiscard]] double device_damping(const Presenter::Felt& felt) const;
  struct CameOff;
  struct Missed;
  struct TooLate;
  class StiffnessMeter;

  void feel(const experiments::Exploration& exploration);
  void stop_if_loose() const;
  void put_fingers_back(std::uint8_t loose_bits);
  void begin_anew(const std::string& reason);
  void miss_deadline();
  [[nodiscard]] bool hurries(const experiments::Block& block) const;
  void play_trial(const experiments::Block& block, std::int64_t trial);
  void wait(double duration_s);
  void rest(double duration_s);
  [[nodiscard]] device::StrokePlan plan_of(const experiments::StrokeIntent& intent) const;
  [[nodiscard]] core::RandomStream stroke_stream(std::int64_t trial, std::int64_t attempt,
                                                 std::int64_t presentation) const;
  void rise_above(double surface_m);
  [[nodiscard]] bool has_felt(double duration_s) const;
  bool pass(double duration_s, double end_s);
  void run_strokes(const experiments::StrokeIntent& intent, StiffnessMeter& stiffness,
                   double end_s);
  [[nodiscard]] double left_to_answer_s(const experiments::Block& block) const;
  [[nodiscard]] bool looks_again(const experiments::Block& block) const;
  Felt present(const experiments::Block& block, const std::string& interval,
               Presenter::Beginning beginning = Presenter::Beginning::kStimulus);
  [[nodiscard]] experiments::Moment moment(const experiments::Block& block) const;
  [[nodiscard]] double read(const Felt& felt, const experiments::Block& block) const;
  void estimate(const experiments::Block& block, const experiments::TrialForm& form);
  void detect(const experiments::Block& block);
  void compare(const experiments::Block& block);
  void choose_interval(const experiments::Block& block);
  void compare_intervals(const experiments::Block& block, experiments::AnswerKind asked);
  void adjust(const experiments::Block& block, std::int64_t trial, bool has_reference);

  const LaboratoryRun& run_;
  Apparatus& apparatus_;
  experiments::Session& session_;
  const experiments::SimulatedParticipant& participant_;
  Presenter presenter_;
  AttachmentWatch attachment_;
  int num_missed_in_a_row_ = 0;
};

}  // namespace jnd::app
