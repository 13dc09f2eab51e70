#include <benchmark/benchmark.h>
#include <sys/resource.h>

#include <cstdint>
#include <filesystem>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/storage/study_store.h"
#include "support/program.h"
#include "support/temporary_folder.h"

namespace jnd {
namespace {

namespace fs = std::filesystem;

constexpr int kNumSimulated = 13;

/// Returns the acts of a session, each with the rows that were projected from it.
std::map<std::int64_t, core::Commit> acts_of(const core::StudyStore& store,
                                             std::int64_t session) {
  std::map<std::int64_t, core::Commit> acts;
  for (core::EventRow& event : store.events(session)) {
    acts[event.sequence].event = std::move(event);
  }
  for (core::DesignRow& row : store.design(session)) {
    acts.at(row.sequence.value()).design.push_back(std::move(row));
  }
  for (core::TrialRow& row : store.trials(session)) acts.at(row.sequence).trial = row;
  for (core::PresentationRow& row : store.presentations(session)) {
    acts.at(row.sequence).presentation = row;
  }
  for (core::AnswerRow& row : store.answers(session)) {
    acts.at(row.sequence).answers.push_back(std::move(row));
  }
  return acts;
}

void move_to(core::Commit& act, std::int64_t session) {
  act.event.session = session;
  for (core::DesignRow& row : act.design) row.session = session;
  for (core::AnswerRow& row : act.answers) row.session = session;
  if (act.trial) act.trial->session = session;
  if (act.presentation) act.presentation->session = session;
}

void move_by(core::Commit& act, std::int64_t num_acts, std::int64_t num_trials) {
  act.event.sequence += num_acts;
  if (act.event.trial) *act.event.trial += num_trials;
  for (core::DesignRow& row : act.design) {
    row.trial += num_trials;
    row.sequence = act.event.sequence;
  }
  if (act.trial) {
    act.trial->sequence = act.event.sequence;
    act.trial->trial += num_trials;
  }
  if (act.presentation) {
    act.presentation->sequence = act.event.sequence;
    act.presentation->trial += num_trials;
  }
}

/// Returns study 2 of the thesis with 13 simulated participants, which is made once.
const fs::path& simulated_study() {
  static const test_support::TemporaryFolder temporary(test_support::memory_folder());
  static const fs::path folder = [] {
    const auto outcome = test_support::run_program(
        {"simulate", "viscosity_discrimination", "--participants",
         std::to_string(kNumSimulated), "--study", "people.study", "--seed", "1", "--fast"},
        {.folder = temporary.path(), .environment = {}});
    if (outcome.exit_code != 0) throw std::runtime_error(outcome.err);
    return temporary.path() / "people.study";
  }();
  return folder;
}

/// A copy of the study, to which more can be added.
class GrownStudy {
 public:
  GrownStudy() { fs::copy(simulated_study(), folder(), fs::copy_options::recursive); }

  [[nodiscard]] fs::path place() const { return temporary_.path(); }
  [[nodiscard]] fs::path folder() const { return place() / "grown.study"; }

  /// Adds people until there are `num_people`. They are the same people again, under other
  /// names.
  void add_people(int num_people) {
    core::StudyStore store(folder(), core::StudyStore::Mode::kReadWrite,
                           core::Durability::kAtClose);
    for (int person = kNumSimulated; person < num_people; ++person) {
      const std::int64_t original = person % kNumSimulated + 1;
      core::SessionRow row = store.session(original);
      row.session = 0;
      row.participant = "P" + std::to_string(1000 + person);
      const std::int64_t session = store.add_session(row);
      for (auto& [sequence, act] : acts_of(store, original)) {
        move_to(act, session);
        store.append(act);
      }
    }
  }

  /// Adds a session with `num_trials` trials, which repeat those of the first session.
  void add_long_session(std::int64_t num_trials) {
    core::StudyStore store(folder(), core::StudyStore::Mode::kReadWrite,
                           core::Durability::kAtClose);
    core::SessionRow row = store.session(1);
    row.session = 0;
    row.participant = "P9999";
    const std::int64_t session = store.add_session(row);
    const std::map<std::int64_t, core::Commit> acts = acts_of(store, 1);
    const std::int64_t num_in_one = std::ssize(store.design(1));
    const std::int64_t last = acts.rbegin()->first;
    const std::int64_t num_copies = num_trials / num_in_one;
    for (std::int64_t copy = 0; copy < num_copies; ++copy) {
      for (const auto& [sequence, original] : acts) {
        core::Commit act = original;
        move_to(act, session);
        move_by(act, copy * last, copy * num_in_one);
        // Only the last copy ends the session. Among the other repeated events, only those of
        // trials have a meaning.
        if (act.event.kind == "session_completed" && copy + 1 < num_copies) {
          act.event.kind = "note_added";
          act.event.data = R"({"text": "and so on"})";
        }
        store.append(act);
      }
    }
  }

 private:
  test_support::TemporaryFolder temporary_{test_support::memory_folder()};
};

/// Returns the processor time of children that have ended.
double children_s() {
  rusage usage{};
  ::getrusage(RUSAGE_CHILDREN, &usage);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

/// Runs `jnd` with these arguments once, and measures its processor time with that of its
/// children.
void time_program(benchmark::State& state, const GrownStudy& study,
                  const std::vector<std::string>& arguments) {
  for (auto _ : state) {
    const double before_s = children_s();
    const auto outcome =
        test_support::run_program(arguments, {.folder = study.place(), .environment = {}});
    if (outcome.exit_code != 0) throw std::runtime_error(outcome.err);
    state.SetIterationTime(children_s() - before_s);
  }
}

/// Measures a command with 13, 100 and 300 people, in seconds of processor time, including
/// gnuplot's. The rate of people shows how the time grows.
void study_of_people(benchmark::State& state, const std::vector<std::string>& arguments) {
  GrownStudy study;
  study.add_people(static_cast<int>(state.range(0)));
  time_program(state, study, arguments);
  state.counters["people_per_s"] =
      benchmark::Counter(static_cast<double>(state.range(0)), benchmark::Counter::kIsRate);
}

void at_three_sizes(benchmark::internal::Benchmark* one) {
  one->Arg(13)->Arg(100)->Arg(300)->Iterations(1)->UseManualTime()->Unit(benchmark::kSecond);
}

BENCHMARK_CAPTURE(study_of_people, results,
                  std::vector<std::string>{"results", "grown.study", "--json"})
    ->Apply(at_three_sizes);
BENCHMARK_CAPTURE(study_of_people, report,
                  std::vector<std::string>{"report", "grown.study", "--out", "report"})
    ->Apply(at_three_sizes);
BENCHMARK_CAPTURE(study_of_people, export_bids,
                  std::vector<std::string>{"export", "bids", "grown.study", "--out", "bids"})
    ->Apply(at_three_sizes);
BENCHMARK_CAPTURE(study_of_people, verify, std::vector<std::string>{"verify", "grown.study"})
    ->Apply(at_three_sizes);

/// Measures `results` of 13 people and one more, who answers more and more trials.
void results_of_long_session(benchmark::State& state) {
  GrownStudy study;
  study.add_long_session(state.range(0));
  time_program(state, study, {"results", "grown.study", "--json"});
  state.counters["trials_per_s"] =
      benchmark::Counter(static_cast<double>(state.range(0)), benchmark::Counter::kIsRate);
}
BENCHMARK(results_of_long_session)
    ->Arg(80)
    ->Arg(5000)
    ->Arg(20000)
    ->Iterations(1)
    ->UseManualTime()
    ->Unit(benchmark::kSecond);

}  // namespace
}  // namespace jnd
