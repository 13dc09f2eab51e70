#include "app/operator/session_quality.h"

#include <utility>
#include <variant>

#include "app/operator/answer_doubts.h"
#include "app/operator/given_answer.h"
#include "app/session/stored_session.h"
#include "core/error.h"
#include "experiments/procedures/procedure_registry.h"
#include "experiments/session/session_state.h"

namespace jnd::app {
namespace {

using namespace experiments;

/// Counts what happens, event by event.
class QualityCount {
 public:
  explicit QualityCount(SessionQuality& quality) : quality_(quality) {}

  void read(const Event& event) {
    std::visit([&](const auto& data) { count(data); }, event.data);
    apply(state_, event);
  }
  [[nodiscard]] const SessionState& state() const noexcept { return state_; }

 private:
  template <typename Data>
  void count(const Data&) const {}
  void count(const FaultRaised&) const { ++quality_.num_faults; }
  void count(const ForceMissing&) const { ++quality_.num_without_force; }
  void count(const PresentationStarted& e) { first_tick_ = e.first_tick; }
  void count(const PresentationEnded& e) {
    const std::int64_t missed = e.summary.measures.missed_ticks;
    // Ticks that never ran have no number, so they are added.
    quality_.num_ticks += e.last_tick - first_tick_ + 1 + missed;
    quality_.num_missed_ticks += missed;
  }

  SessionQuality& quality_;
  SessionState state_;
  std::int64_t first_tick_ = 0;
};

void count_answers(const SessionState& state, const std::vector<const Stage*>& stages,
                   double rate_hz, bool hides_levels, SessionQuality& quality) {
  for (const TrialState& trial : state.trials) {
    quality.num_repeated += trial.attempt > 1 ? 1 : 0;
    if (!trial.is_answered) continue;
    const Block& block =
        std::get<Block>(stages.at(static_cast<std::size_t>(trial.stage))->content);
    const AnswerGiven given{.state = state,
                            .trial = trial,
                            .block = block,
                            .rate_hz = rate_hz,
                            .hides_levels = hides_levels};
    GivenAnswer answer =
        given.with(procedure_named(block.procedure).form(block).answer, trial.response);
    quality.num_unstroked += std::exchange(answer.unstroked, {}).empty() ? 0 : 1;
    quality.num_unlikely += doubts_about(answer).empty() ? 0 : 1;
  }
}

}  // namespace

bool SessionQuality::is_doubtful() const noexcept {
  constexpr double kManyMissed = 0.001;
  const bool misses =
      static_cast<double>(num_missed_ticks) > kManyMissed * static_cast<double>(num_ticks);
  return misses || num_faults > 0 || num_without_force > 0 || num_unlikely > 0 ||
         num_unstroked > 0 || !problem.empty();
}

SessionQuality quality_of(const core::StudyStore& store, const core::SessionRow& row,
                          bool hides_levels) {
  SessionQuality quality{
      .session = row.session, .participant = row.participant, .pilot = row.pilot};
  try {
    const Study study = stored_study(store, row.session);
    QualityCount counted(quality);
    for (const core::EventRow& event : store.events(row.session)) {
      counted.read(event_from_row(event));
    }
    count_answers(counted.state(), stages_of_session(study, row.cells), row.rate_hz,
                  hides_levels, quality);
  } catch (const core::Error& error) {
    quality.problem = error.what();
  }
  return quality;
}

}  // namespace jnd::app
