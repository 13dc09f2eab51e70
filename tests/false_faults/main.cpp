// Measures how often the loop's guards disturb healthy people. It counts faults, warnings and
// repeated trials of simulated hands on devices with friction, noise and loss, which are
// watched as real ones. `./dev false-faults` writes data/reference/false_faults/README.md. The
// same seed gives the same page.

#include <array>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include "core/media/medium.h"
#include "core/parallel.h"
#include "device/haptic_loop.h"
#include "false_faults/worn_hand_device.h"

namespace jnd::false_faults {
namespace {

constexpr double kHome_m = -0.15;
constexpr int kNumFaults = static_cast<int>(core::kLastFault) + 1;

/// What the hand does in the stimulus.
enum class Act { kStrokes, kRests, kPresses };

struct Stimulus {
  std::string name;
  core::MediumAmounts medium;
  core::Immersion immersion;
  bool is_solid = false;
};

/// Returns the stimuli of the shipped studies, and others that a study may ask for.
std::vector<Stimulus> stimuli() {
  const core::Immersion endless{.origin_z_m = 1.0};
  // The palm's outer point rests a centimetre deep in the table.
  const core::Immersion table{.origin_z_m = kHome_m - 0.033};
  const core::Immersion bucket{.radius_m = 0.25, .depth_m = 1.0, .origin_z_m = kHome_m + 0.3};
  return {{"water, scale 0.25", core::water({.scale = 0.25}), endless},
          {"water, scale 1", core::water({}), endless},
          {"water, scale 4", core::water({.scale = 4.0}), endless},
          {"2.5 Pa s", core::viscous({.viscosity_pa_s = 2.5}), endless},
          {"8 Pa s", core::viscous({.viscosity_pa_s = 8.0}), endless},
          {"21 Pa s", core::viscous({.viscosity_pa_s = 21.0}), endless},
          {"plane of 300 N/m", core::solid({.stiffness_n_per_m = 300.0}), table, true},
          {"plane of 1000 N/m, rough",
           core::solid({.stiffness_n_per_m = 1000.0, .friction_ratio = 0.3}), table, true},
          {"plane of 2000 N/m, damped",
           core::solid({.stiffness_n_per_m = 2000.0, .damping_n_s_per_m = 5.0}), table, true},
          {"bucket of 5 Pa s",
           core::viscous({.viscosity_pa_s = 5.0}) +
               core::container({.stiffness_n_per_m = 500.0, .friction_ratio = 0.2}),
           bucket},
          {"float of 8 N in water", core::water({}) + core::buoyant(8.0), endless}};
}

/// Counts what happened in one person's sessions.
struct Tally {
  std::int64_t num_ticks = 0;
  std::array<std::int64_t, kNumFaults> num_faults{};
  std::array<std::int64_t, core::kGuards.size()> num_warnings{};
  struct OfStimulus {
    std::int64_t num_trials = 0;
    std::int64_t num_faulted = 0;   ///< Trials that were repeated because of a fault.
    std::int64_t num_detached = 0;  ///< Trials that were repeated because a finger came off.
  };
  std::vector<OfStimulus> by_stimulus;

  void add(const Tally& other) {
    num_ticks += other.num_ticks;
    for (int i = 0; i < kNumFaults; ++i) num_faults[i] += other.num_faults[i];
    for (std::size_t i = 0; i < num_warnings.size(); ++i) {
      num_warnings[i] += other.num_warnings[i];
    }
    by_stimulus.resize(other.by_stimulus.size());
    for (std::size_t i = 0; i < by_stimulus.size(); ++i) {
      by_stimulus[i].num_trials += other.by_stimulus[i].num_trials;
      by_stimulus[i].num_faulted += other.by_stimulus[i].num_faulted;
      by_stimulus[i].num_detached += other.by_stimulus[i].num_detached;
    }
  }
};

/// Simulates one person for an hour. A trial is a stimulus of some seconds, and a rest without
/// one.
class Hour {
 public:
  Hour(std::uint64_t seed, std::int64_t person, const std::vector<Stimulus>& stimuli)
      : seed_(seed),
        person_(person),
        stimuli_(stimuli),
        random_(seed, "trials", {person}),
        device_(Wear::of_person(seed, person), seed, person) {
    tally_.by_stimulus.resize(stimuli.size());
  }

  Tally live(std::int64_t num_ticks) {
    run(10);
    arm();
    for (std::int64_t trial = 0; tally_.num_ticks < num_ticks; ++trial) run_trial(trial);
    telemetry_.fetch();
    for (std::size_t i = 0; i < core::kGuards.size(); ++i) {
      tally_.num_warnings[i] = telemetry_.value().guards.num_warnings[i];
    }
    return tally_;
  }

 private:
  void run_trial(std::int64_t trial) {
    const auto which = static_cast<std::size_t>(random_.below(stimuli_.size()));
    const Stimulus& stimulus = stimuli_[which];
    const int detachments_before = device_.num_detachments();
    begin_act(stimulus, trial);
    command(stimulus.medium, stimulus.immersion);
    const bool went_well = run(static_cast<int>(4000 + random_.below(6000)));
    device_.arm().go_home();
    command(core::free_space(), stimulus.immersion);
    const bool rested_well = run(static_cast<int>(1500 + random_.below(1500)));
    Tally::OfStimulus& of = tally_.by_stimulus[which];
    ++of.num_trials;
    if (!went_well || !rested_well) {
      ++of.num_faulted;
      run(1000);
      arm();
    } else if (device_.num_detachments() != detachments_before) {
      ++of.num_detached;
    }
  }

  /// Begins what the hand does. It enters a solid from above.
  void begin_act(const Stimulus& stimulus, std::int64_t trial) {
    const core::RandomStream stream(seed_, "strokes", {person_, trial});
    const double draw = random_.uniform();
    const Act act = stimulus.is_solid ? (draw < 0.5 ? Act::kPresses : Act::kRests)
                                      : (draw < 0.85 ? Act::kStrokes : Act::kRests);
    if (act == Act::kRests) return device_.arm().go_home();
    device::StrokePlan plan;
    plan.amplitude_m = act == Act::kPresses ? 0.03 : random_.uniform(0.08, 0.3);
    plan.max_speed_m_per_s = act == Act::kPresses ? 0.1 : random_.uniform(0.15, 0.9);
    plan.height_m = act == Act::kPresses ? kHome_m + 0.01 : kHome_m;
    plan.lift_m = act == Act::kPresses ? 0.03 : 0.015;
    device_.arm().begin_strokes(plan, stream);
  }

  void command(const core::MediumAmounts& medium, const core::Immersion& immersion) {
    commands_.publish({.sequence = ++sequence_, .medium = medium, .immersion = immersion});
  }

  /// Runs the loop for these ticks. Returns false if a fault came, after which the remaining
  /// time is not simulated.
  bool run(int num_ticks) {
    for (int i = 0; i < num_ticks; ++i) {
      loop_.tick();
      ++tally_.num_ticks;
      telemetry_.fetch();
      move_where_asked();
      const core::Fault fault = telemetry_.value().fault;
      if (fault == core::Fault::kNone || fault == core::Fault::kNotArmed) continue;
      if (fault == known_fault_) continue;
      known_fault_ = fault;
      ++tally_.num_faults[static_cast<std::size_t>(fault)];
      return false;
    }
    return true;
  }

  /// Moves the hand a second after the loop asked for it, as a person does to whom the
  /// experimenter reads the warning.
  void move_where_asked() {
    constexpr int kReaction_ms = 1000;
    const bool is_asked = telemetry_.value().warning == core::Fault::kPositionFrozen;
    num_asked_ticks_ = is_asked ? num_asked_ticks_ + 1 : 0;
    if (num_asked_ticks_ != kReaction_ms) return;
    const device::StrokePlan plan{
        .amplitude_m = 0.01, .max_speed_m_per_s = 0.05, .height_m = kHome_m, .num_strokes = 2};
    device_.arm().begin_strokes(plan, {seed_, "moves", {person_, tally_.num_ticks}});
  }

  void arm() {
    known_fault_ = core::Fault::kNone;
    loop_.rearm();
    run(700);
  }

  std::uint64_t seed_;
  std::int64_t person_;
  const std::vector<Stimulus>& stimuli_;
  core::RandomStream random_;
  WornHandDevice device_;
  core::LatestValue<core::HapticCommand> commands_;
  core::LatestValue<core::Telemetry> telemetry_;
  core::EmergencyStop stop_;
  device::HapticLoop loop_{{}, device_, {commands_, telemetry_, stop_}};
  std::uint64_t sequence_ = 0;
  core::Fault known_fault_ = core::Fault::kNone;
  int num_asked_ticks_ = 0;
  Tally tally_;
};

/// Returns the p value of the hypothesis that all stimuli have the same share.
double p_of_equal_shares(const Tally& tally, std::int64_t Tally::OfStimulus::*counted) {
  std::int64_t all = 0, trials = 0;
  for (const Tally::OfStimulus& of : tally.by_stimulus) {
    all += of.*counted;
    trials += of.num_trials;
  }
  if (all == 0 || all == trials) return 1.0;
  const double share = static_cast<double>(all) / static_cast<double>(trials);
  double chi_squared = 0.0;
  for (const Tally::OfStimulus& of : tally.by_stimulus) {
    const double num = static_cast<double>(of.num_trials);
    const double off = static_cast<double>(of.*counted) - share * num;
    chi_squared += off * off / (num * share * (1.0 - share));
  }
  const boost::math::chi_squared distribution(static_cast<double>(tally.by_stimulus.size()) -
                                              1.0);
  return boost::math::cdf(boost::math::complement(distribution, chi_squared));
}

/// Returns the upper end of the 95 % interval of a Poisson mean, after `count` events.
double upper_bound(std::int64_t count) {
  const boost::math::chi_squared distribution(2.0 * static_cast<double>(count + 1));
  return 0.5 * boost::math::quantile(distribution, 0.975);
}

double percent(std::int64_t part, std::int64_t whole) {
  return whole == 0 ? 0.0 : 100.0 * static_cast<double>(part) / static_cast<double>(whole);
}

void print(const Tally& tally, const std::vector<Stimulus>& stimuli, std::int64_t num_people,
           std::uint64_t seed) {
  const double hours = 0.001 * static_cast<double>(tally.num_ticks) / 3600.0;
  std::printf(
      "# How often guards disturb healthy people\n\n"
      "Written by `./dev false-faults %lld`; seed %llu. %lld simulated people, an hour each, "
      "%.1f hours\nin all, on devices that nothing is wrong with: 0.6 to 2.5 kg, stiction "
      "of 0.1 to 0.8 N, positions in steps of 1 to 100 um,\nvelocities filtered at 40 to 200 "
      "Hz, "
      "tremor of 8 to 12 Hz and up to 0.5 mm, fingers that slide\nin their holders, "
      "measurements jittered by up to 0.2 ms of which 1 %% are lost, forces up to 2 ms "
      "late.\nThe loop watches over them as over a real hand.\n\n",
      static_cast<long long>(num_people), static_cast<unsigned long long>(seed),
      static_cast<long long>(num_people), hours);
  std::printf("## Faults\n\n");
  std::printf("| guard | faults | at most in 100 hours (97.5 %%) | warnings an hour |\n");
  std::printf("| --- | --- | --- | --- |\n");
  for (std::size_t i = 0; i < core::kGuards.size(); ++i) {
    const auto fault = static_cast<std::size_t>(core::kGuards[i]);
    std::printf("| `%s` | %lld | %.1f | %.2f |\n",
                std::string(core::name(core::kGuards[i])).c_str(),
                static_cast<long long>(tally.num_faults[fault]),
                100.0 * upper_bound(tally.num_faults[fault]) / hours,
                static_cast<double>(tally.num_warnings[i]) / hours);
  }
  for (int i = 1; i < kNumFaults; ++i) {
    const auto fault = static_cast<core::Fault>(i);
    if (core::is_guard(fault) ||
        (tally.num_faults[i] == 0 && fault != core::Fault::kStaleSample &&
         fault != core::Fault::kPositionJump && fault != core::Fault::kOverVelocity)) {
      continue;
    }
    std::printf("| `%s` | %lld | %.1f | |\n", std::string(core::name(fault)).c_str(),
                static_cast<long long>(tally.num_faults[i]),
                100.0 * upper_bound(tally.num_faults[i]) / hours);
  }
  std::printf(
      "\n## Repeated trials\n\nA trial is repeated for a fault, or where a finger came off "
      "(drawn: once in twenty minutes, whatever is felt).\n\n"
      "| stimulus | trials | for a fault | for a finger that came off |\n"
      "| --- | --- | --- | --- |\n");
  std::int64_t trials = 0, faulted = 0;
  for (std::size_t i = 0; i < stimuli.size(); ++i) {
    const Tally::OfStimulus& of = tally.by_stimulus[i];
    trials += of.num_trials;
    faulted += of.num_faulted;
    std::printf("| %s | %lld | %.2f %% | %.1f %% |\n", stimuli[i].name.c_str(),
                static_cast<long long>(of.num_trials), percent(of.num_faulted, of.num_trials),
                percent(of.num_detached, of.num_trials));
  }
  std::printf(
      "\nFor a fault: %.3f %% of %lld trials; alike across stimuli with p = %.2f "
      "(chi-squared). Fingers that came off: p = %.2f.\n",
      percent(faulted, trials), static_cast<long long>(trials),
      p_of_equal_shares(tally, &Tally::OfStimulus::num_faulted),
      p_of_equal_shares(tally, &Tally::OfStimulus::num_detached));
}

}  // namespace
}  // namespace jnd::false_faults

int main(int argc, char** argv) {
  using namespace jnd::false_faults;
  const std::int64_t num_people = argc > 1 ? std::atoll(argv[1]) : 300;
  const std::uint64_t seed = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 2018;
  if (num_people < 1) {
    std::fprintf(stderr,
                 "false_faults: expected a number of people (an hour each), 1 or more\n");
    return 2;
  }
  const std::vector<Stimulus> all = stimuli();
  std::vector<Tally> tallies(static_cast<std::size_t>(num_people));
  const int jobs = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  jnd::core::for_each_index(tallies.size(), jobs, [&](std::size_t i) {
    tallies[i] = Hour(seed, static_cast<std::int64_t>(i), all).live(3'600'000);
  });
  Tally sum;
  for (const Tally& tally : tallies) sum.add(tally);
  print(sum, all, num_people, seed);
  // After the faults are printed, the program exits like a failed test if there were any.
  std::int64_t num_faults = 0;
  for (const std::int64_t count : sum.num_faults) num_faults += count;
  return num_faults == 0 ? 0 : 1;
}
