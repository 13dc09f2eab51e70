#include "experiments/session/plan.h"
#include "experiments/study/media.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "analysis/results/block_words.h"
#include "app/command_line/command.h"
#include "app/command_line/json_text.h"
#include "app/command_line/option_checks.h"
#include "app/commands/field_options.h"
#include "app/commands/profile_option.h"
#include "app/operator/study_words.h"
#include "app/planning/plan_lapses.h"
#include "app/planning/plan_statistics.h"
#include "app/profile/profile_choice.h"
#include "app/session/device_checks.h"
#include "app/session/device_limits.h"
#include "app/session/pseudonym.h"
#include "app/session/session_setup.h"
#include "app/session/shipped_files.h"
#include "app/session/stability_limits.h"
#include "app/session/stored_session.h"
#include "core/error.h"
#include "device/registry/device_registry.h"
#include "experiments/order/block_turns.h"
#include "experiments/protocol/study_reader.h"

namespace jnd::app {
namespace {

using nlohmann::ordered_json;

struct PlanOptions {
  std::string file;
  std::string folder;
  int participants = 13;
  std::uint64_t seed = 1;
  std::string device;
  /// A profile's file; if "", a real device's own is looked for.
  std::string profile;
  std::string laboratory;           ///< "" for the default of the device.
  std::vector<std::string> fields;  ///< Such as "sex=female".
  double speed_m_per_s = 0.5;
  bool all = false;  ///< Prints all cells, however many there are.
  bool json = false;
};

/// Everything that the command has to tell.
struct PlanOutcome {
  experiments::Study study;
  std::vector<experiments::ParticipantPlan> plans;
  std::vector<experiments::RangeEntry> range;
  std::vector<std::string> completed;  ///< The cells of completed sessions.
  /// None if the device's own data are used.
  std::optional<KnownProfile> profile;
  device::DeviceCapabilities device;
  experiments::RangeLimits limits{};
  std::optional<StabilityCheck> stability;  ///< None if the device has no map.
  PlanStatistics statistics;
  std::vector<PlannedLapses> lapses;
  /// The expected duration of the longest session.
  double duration_s = 0.0;
  /// The duration of that session if every block takes as many trials as it can.
  double longest_duration_s = 0.0;
  /// Why its sessions cannot be stored in the folder; "" if they can.
  std::string folder_problem;
};

/// A plan needs no profile, so a missing one is only mentioned among the remarks.
std::optional<KnownProfile> profile_to_plan_with(const PlanOptions& options, double rate_hz) {
  ProfileChoice choice = choose_profile(device_of_profile(options.device, rate_hz),
                                        options.profile, profile_folders(), today());
  if (!choice.lack.empty()) choice.remarks.push_back(choice.lack);
  for (const std::string& remark : choice.remarks) fmt::print(stderr, "jnd: {}\n", remark);
  return std::move(choice.known);
}

PlanOutcome outcome_of(const PlanOptions& options) {
  PlanOutcome outcome;
  outcome.study = experiments::read_study(user_or_shipped(options.file, "protocols"));
  experiments::PlanRequest request = {.participants = {}, .seed = options.seed};
  bool unblinded = false;
  if (!options.folder.empty()) {
    const core::StudyStore store(options.folder, core::StudyStore::Mode::kReadOnly);
    request.num_earlier_sessions = static_cast<std::int64_t>(store.sessions().size());
    request.participants = next_participants(store, options.participants);
    request.completed = experiments::completed_cells(store);
    unblinded = store.unblinded();
    outcome.folder_problem = other_study_problem(store, outcome.study);
  }
  if (outcome.study.blinding == experiments::Blinding::kDouble && !unblinded) {
    throw core::Error(options.file +
                      ": expected a study that is not blind for the experimenter, found "
                      "`double`; its orders are shown once its study folder is unblinded");
  }
  if (options.folder.empty())
    request.participants = next_participants({}, options.participants);
  request.fields = fields_or_none(outcome.study, options.fields);
  outcome.plans = experiments::plan_participants(outcome.study, request);
  outcome.completed = request.completed;
  const experiments::Laboratory laboratory = experiments::read_laboratory(user_or_shipped(
      options.laboratory.empty() ? default_laboratory(options.device) : options.laboratory,
      "data/laboratories"));
  outcome.statistics = plan_statistics(outcome.study, outcome.plans, laboratory, options.seed);
  outcome.lapses = planned_lapses(outcome.study, outcome.plans, laboratory);
  for (const experiments::ParticipantPlan& plan : outcome.plans) {
    outcome.duration_s = std::max(outcome.duration_s, plan.duration_s);
    outcome.longest_duration_s = std::max(outcome.longest_duration_s, plan.longest_duration_s);
  }
  outcome.profile = profile_to_plan_with(options, outcome.study.device.rate_hz);
  const DeviceLimits device =
      limits_of_device(options.device, outcome.study.device.rate_hz, outcome.profile);
  outcome.device = device.can;
  outcome.limits = range_limits_of(outcome.device, options.speed_m_per_s);
  outcome.range = experiments::planned_range(outcome.study, outcome.limits);
  if (device.stability) {
    outcome.stability =
        check_stability(*device.stability, outcome.study, outcome.range, options.speed_m_per_s);
  }
  return outcome;
}

/// The numbers of sessions by cell: completed ones, and together with the planned ones.
std::map<std::string, std::pair<int, int>> balance_of(const PlanOutcome& outcome) {
  std::map<std::string, std::pair<int, int>> balance;
  for (const experiments::Cell& cell : experiments::cells_of(outcome.study)) {
    balance[to_string(cell)] = {0, 0};
  }
  for (const std::string& cell : outcome.completed) {
    if (const auto found = balance.find(cell); found != balance.end()) ++found->second.first;
  }
  for (auto& [cell, counts] : balance) counts.second = counts.first;
  for (const auto& plan : outcome.plans) ++balance[to_string(plan.cell)].second;
  return balance;
}

ordered_json to_json(const experiments::PlannedTrial& trial) {
  ordered_json json = {{"repetition", trial.repetition}, {"position", trial.position}};
  if (trial.intensity) json["intensity"] = *trial.intensity;
  if (trial.reference_intensity) json["reference_intensity"] = *trial.reference_intensity;
  if (trial.starting_intensity) json["starting_intensity"] = *trial.starting_intensity;
  if (trial.target_percent) json["target_percent"] = *trial.target_percent;
  if (trial.series) json["series"] = *trial.series;
  if (trial.test_interval) json["test_interval"] = *trial.test_interval;
  if (!trial.intervals.empty()) json["intervals"] = trial.intervals;
  if (trial.is_catch) json["is_catch"] = true;
  return json;
}

/// `turns` is null if the answers decide how many trials a block has.
ordered_json to_json(const experiments::PlannedGroup& group) {
  auto blocks = ordered_json::array(), turns = ordered_json::array();
  for (const experiments::Stage* block : group.blocks) blocks.push_back(block->name);
  for (const std::size_t index : group.order) turns.push_back(group.blocks[index]->name);
  return {{"name", group.name},
          {"rule", experiments::to_string(group.turns)},
          {"blocks", std::move(blocks)},
          {"turns", group.order.empty() ? ordered_json() : std::move(turns)}};
}

/// Whether the answers decide how many trials the block has.
bool answers_decide(const experiments::Block& block) {
  return analysis::length_is_expected(block) || block.practice;
}

ordered_json to_json(const experiments::ParticipantPlan& plan,
                     const PlanStatistics& statistics) {
  auto order = ordered_json::array();
  for (const experiments::PlannedBlock& block : plan.blocks) {
    auto trials = ordered_json::array();
    for (const experiments::PlannedTrial& trial : block.trials)
      trials.push_back(to_json(trial));
    const auto& content = std::get<experiments::Block>(block.stage->content);
    order.push_back({{"block", block.stage->name},
                     {"procedure", content.procedure},
                     {"medium", content.medium},
                     {"quantity", content.quantity},
                     {"num_trials", block.num_trials},
                     {"num_trials_is_expected", answers_decide(content)},
                     {"trials", std::move(trials)}});
    const auto simulated = statistics.num_trials.find(block.stage->name);
    if (simulated != statistics.num_trials.end()) {
      order.back()["num_trials_simulated"] = to_decimals(simulated->second.mean, 6);
    }
  }
  ordered_json json = {
      {"id", plan.participant}, {"cells", to_string(plan.cell)}, {"order", std::move(order)}};
  if (!plan.groups.empty()) json["interleaved"] = ordered_json::array();
  for (const experiments::PlannedGroup& group : plan.groups) {
    json["interleaved"].push_back(to_json(group));
  }
  json["duration_s"] = to_decimals(plan.duration_s, 6);
  return json;
}

ordered_json to_json(const experiments::RangeEntry& entry) {
  ordered_json json = {{"stage", entry.stage}, {"medium", entry.setting.medium}};
  if (!entry.setting.quantity.empty()) json[entry.setting.quantity] = entry.setting.intensity;
  constexpr int kNumDecimals = 9;
  json["total_force_n"] = to_decimals(entry.total_force_n, kNumDecimals);
  json["largest_point_force_n"] = to_decimals(entry.largest_point_force_n, kNumDecimals);
  json["fits"] = entry.fits;
  json["fits_up_to_m_per_s"] =
      entry.fits_up_to_m_per_s
          ? ordered_json(to_decimals(*entry.fits_up_to_m_per_s, kNumDecimals))
          : ordered_json();
  return json;
}

ordered_json to_json(const device::ExoskeletonStability& limits) {
  return {{"viscosity_pa_s", limits.viscosity_pa_s.value},
          {"viscosity_is_at_least", limits.viscosity_pa_s.is_beyond_ladder},
          {"stiffness_n_per_m", limits.stiffness_n_per_m.value},
          {"stiffness_is_at_least", limits.stiffness_n_per_m.is_beyond_ladder}};
}

/// null for a device without a map.
ordered_json stability_json(const PlanOutcome& outcome) {
  if (!outcome.stability) return nullptr;
  return {{"rate_hz", outcome.stability->rate_hz},
          {"attached", to_json(outcome.stability->attached)},
          {"detached", to_json(outcome.stability->detached)},
          {"remark", detached_remark(*outcome.stability)}};
}

/// null for a device that nobody measured.
ordered_json profile_json(const PlanOutcome& outcome) {
  if (!outcome.profile) return nullptr;
  const experiments::DeviceProfile& profile = outcome.profile->profile;
  return {{"file", outcome.profile->place},     {"model", profile.device.model},
          {"serial", profile.device.serial},    {"measured_on", profile.measured_on},
          {"valid_until", profile.valid_until}, {"simulated", profile.simulated}};
}

ordered_json to_json(const PlanOutcome& outcome, const PlanOptions& options) {
  auto participants = ordered_json::array();
  for (const auto& plan : outcome.plans)
    participants.push_back(to_json(plan, outcome.statistics));
  auto balance = ordered_json::array();
  for (const auto& [cell, counts] : balance_of(outcome)) {
    balance.push_back(
        {{"cells", cell}, {"num_completed", counts.first}, {"num_planned", counts.second}});
  }
  auto range = ordered_json::array();
  for (std::size_t i = 0; i < outcome.range.size(); ++i) {
    range.push_back(to_json(outcome.range[i]));
    if (!outcome.stability) continue;
    range.back()["stable"] = static_cast<bool>(outcome.stability->is_stable[i]);
    range.back()["needs_the_hand"] = static_cast<bool>(outcome.stability->needs_the_hand[i]);
  }
  ordered_json json = {{"study", outcome.study.name},
                       {"seed", options.seed},
                       {"participants", std::move(participants)},
                       {"balance", std::move(balance)}};
  add_to_json(outcome.statistics, json);
  add_to_json(outcome.lapses, json);
  json.update(
      ordered_json{{"duration_s", to_decimals(outcome.duration_s, 6)},
                   {"longest_duration_s", to_decimals(outcome.longest_duration_s, 6)},
                   {"device", options.device},
                   {"device_profile", profile_json(outcome)},
                   {"limits",
                    {{"max_force_per_point_n", outcome.limits.max_force_per_point_n},
                     {"max_total_force_n", outcome.limits.max_total_force_n},
                     {"expected_speed_m_per_s", outcome.limits.expected_speed_m_per_s},
                     {"expected_depth_m", outcome.limits.expected_depth_m},
                     {"device_max_force_per_point_n", outcome.device.max_force_per_point_n},
                     {"device_max_total_force_n", outcome.device.max_total_force_n},
                     {"remark", own_limit_words(options.device, outcome.device)}}},
                   {"stability", stability_json(outcome)},
                   {"range", std::move(range)}});
  return json;
}

/// Prints the order, one line for each repetition, such as "1: 0.5 4 2". A production begins
/// with its target.
void print_order(const experiments::PlannedBlock& block) {
  const auto& content = std::get<experiments::Block>(block.stage->content);
  const bool matches = !block.trials.empty() && !block.trials.front().intensity &&
                       block.trials.front().reference_intensity;
  fmt::print("    {}: {}{} trials{}\n", block.stage->name,
             content.practice ? "practice, at most " : "",
             content.practice ? std::to_string(block.num_trials)
                              : analysis::trials_to_expect(content, block.num_trials),
             matches ? "; standards, and where each match starts" : "");
  if (analysis::length_is_expected(content)) {
    fmt::print("      {}; {}\n", analysis::adaptive_words(content),
               fmt::join(analysis::adaptive_level_words(
                             content, experiments::quantity_unit(content.quantity)),
                         "; "));
    return;
  }
  if (content.practice) {
    fmt::print(
        "      levels {}\n",
        analysis::list_of(content.intensities, experiments::quantity_unit(content.quantity)));
    return;
  }
  int repetition = 0;
  for (const experiments::PlannedTrial& trial : block.trials) {
    if (trial.repetition != repetition) {
      repetition = trial.repetition;
      fmt::print("{}      {}:", trial.position == 1 && repetition > 1 ? "\n" : "", repetition);
      if (trial.target_percent) fmt::print(" to {:g} %, from", *trial.target_percent);
    }
    fmt::print(" {}", analysis::stimulus_words(trial));
  }
  fmt::print("\n");
}

/// Prints which blocks a group mixes, and their turns by their places in the group.
void print_group(const experiments::PlannedGroup& group) {
  fmt::print("    {}: ", group.name);
  for (std::size_t i = 0; i < group.blocks.size(); ++i) {
    fmt::print("{}{} {}", i == 0 ? "" : ", ", i + 1, group.blocks[i]->name);
  }
  fmt::print(", interleaved {}\n", experiments::turns_words(group.turns));
  if (group.order.empty()) return;
  fmt::print("      turns:");
  for (const std::size_t index : group.order) fmt::print(" {}", index + 1);
  fmt::print("\n");
}

/// Prints the number of sessions of each cell; if there are very many cells, only the first
/// ones, unless all are asked for.
void print_balance(const PlanOutcome& outcome, bool all) {
  constexpr std::size_t kMostCells = 12;
  const auto balance = balance_of(outcome);
  fmt::print("\nBalance: completed sessions, and with the planned ones\n");
  std::size_t num_shown = 0;
  for (const auto& [cell, counts] : balance) {
    if (!all && balance.size() > kMostCells && num_shown == kMostCells) break;
    fmt::print("  {:<56} {:>3} {:>3}\n", cell.empty() ? "(one cell)" : cell, counts.first,
               counts.second);
    ++num_shown;
  }
  if (num_shown == balance.size()) return;
  int fewest = balance.begin()->second.second, most = fewest;
  for (const auto& [cell, counts] : balance) {
    fewest = std::min(fewest, counts.second);
    most = std::max(most, counts.second);
  }
  fmt::print(
      "  ... and {} more; with the planned ones each of all {} has {}; --all lists them\n",
      balance.size() - num_shown, balance.size(),
      fewest == most ? std::to_string(most) : fmt::format("{} to {}", fewest, most));
}

/// The first stimuli that are too strong, such as "viscosity_pa_s 20 in `thick` (35.50 N in
/// all, 12.40 N at a point)", and how many more there are.
std::string too_strong_words(const std::vector<experiments::RangeEntry>& range) {
  constexpr std::size_t kMostNamed = 3;
  std::string words;
  std::size_t num = 0;
  for (const experiments::RangeEntry& entry : range) {
    if (entry.fits || ++num > kMostNamed) continue;
    const std::string stimulus =
        entry.setting.quantity.empty()
            ? entry.setting.medium
            : fmt::format("{} {:g}", entry.setting.quantity, entry.setting.intensity);
    words += fmt::format("{}{} in `{}` ({:.2f} N in all, {:.2f} N at a point)",
                         words.empty() ? "" : ", ", stimulus, entry.stage, entry.total_force_n,
                         entry.largest_point_force_n);
  }
  return words + (num > kMostNamed ? fmt::format(" and {} more", num - kMostNamed) : "");
}

void print_range(const PlanOutcome& outcome, const PlanOptions& options) {
  fmt::print(
      "\nStimuli on `{}`: at most {:g} N at a point and {:g} N in all; hand head on at {:g} "
      "m/s, "
      "{:g} m deep in what is solid\n",
      options.device, outcome.limits.max_force_per_point_n, outcome.limits.max_total_force_n,
      outcome.limits.expected_speed_m_per_s, outcome.limits.expected_depth_m);
  const std::string own_limit = own_limit_words(options.device, outcome.device);
  if (!own_limit.empty()) fmt::print("Note: {}.\n", own_limit);
  if (outcome.profile) {
    fmt::print("`{}` {}: {}\n", options.device, age_words(outcome.profile->profile, today()),
               outcome.profile->place);
  }
  std::size_t longest = 24;
  for (const experiments::RangeEntry& entry : outcome.range) {
    longest = std::max(longest, entry.stage.size());
  }
  const auto width = static_cast<int>(longest);
  for (const experiments::RangeEntry& entry : outcome.range) {
    const std::string setting =
        entry.setting.medium +
        (entry.setting.quantity.empty()
             ? ""
             : fmt::format(" {} {:g}", entry.setting.quantity, entry.setting.intensity));
    fmt::print("  {:<{}} {:<32} {:6.2f} N in all, {:5.2f} N at a point{}{}\n", entry.stage,
               width, setting, entry.total_force_n, entry.largest_point_force_n,
               entry.fits_up_to_m_per_s
                   ? fmt::format(", fits up to {:.2f} m/s", *entry.fits_up_to_m_per_s)
                   : "",
               entry.fits ? "" : "  TOO STRONG");
  }
  if (!outcome.stability) return;
  fmt::print("Stable at {:g} Hz on the hand up to {} and {}.\n", outcome.stability->rate_hz,
             words_of(outcome.stability->attached.viscosity_pa_s, "Pa s"),
             words_of(outcome.stability->attached.stiffness_n_per_m, "N/m"));
  const std::string remark = detached_remark(*outcome.stability);
  if (!remark.empty()) fmt::print("{}.\n", remark);
}

void print(const PlanOutcome& outcome, const PlanOptions& options) {
  const double mean_s = spread_of(outcome.statistics.durations_s).mean;
  fmt::print("{}: {} participants, seed {}, about {:.0f} min each", outcome.study.name,
             outcome.plans.size(), options.seed, mean_s / 60.0);
  if (outcome.statistics.adapts) {
    fmt::print(", {:.0f} min with all trials that adaptive blocks may take",
               outcome.longest_duration_s / 60.0);
  }
  fmt::print("\n\n");
  for (const experiments::ParticipantPlan& plan : outcome.plans) {
    const std::string cell = to_string(plan.cell);
    fmt::print("  {}{}{}\n", plan.participant, cell.empty() ? "" : " ", cell);
    for (const experiments::PlannedBlock& block : plan.blocks) print_order(block);
    for (const experiments::PlannedGroup& group : plan.groups) print_group(group);
  }
  print_balance(outcome, options.all);
  print(outcome.statistics);
  print(outcome.lapses);
  print_range(outcome, options);
}

std::string in_brackets(const std::string& words) {
  return words.empty() ? "" : " (" + words + ")";
}

/// What speaks against running the study on this device, a sentence each.
std::vector<std::string> problems_of(const PlanOutcome& outcome, const PlanOptions& options) {
  std::vector<std::string> problems;
  if (!outcome.folder_problem.empty()) problems.push_back(outcome.folder_problem);
  const auto too_strong = std::count_if(outcome.range.begin(), outcome.range.end(),
                                        [](const auto& entry) { return !entry.fits; });
  if (too_strong > 0) {
    problems.push_back(fmt::format(
        "{}: expected stimuli that `{}` can render at {:g} m/s, found {} of {} too strong: {}; "
        "weaken them or plan for another device{}",
        options.file, options.device, outcome.limits.expected_speed_m_per_s, too_strong,
        outcome.range.size(), too_strong_words(outcome.range),
        in_brackets(own_limit_words(options.device, outcome.device))));
  }
  if (outcome.stability && outcome.stability->num_unstable() > 0) {
    problems.push_back(options.file + ": " +
                       unstable_words(*outcome.stability, options.device) +
                       "; weaken them, or raise the study's rate");
  }
  const std::optional<double>& limit_s = outcome.study.session_limits.max_duration_s;
  const auto too_long = std::count_if(
      outcome.statistics.durations_s.begin(), outcome.statistics.durations_s.end(),
      [&](double duration_s) { return limit_s && duration_s > *limit_s; });
  if (too_long > 0) {
    problems.push_back(fmt::format(
        "{}: expected sessions of at most {:g} s, as `session_limits` says, found {} of {} "
        "that simulated participants take longer for; shorten adaptive blocks or raise the "
        "limit",
        options.file, *limit_s, too_long, outcome.plans.size()));
  }
  const std::string missing = missing_points_words(options.device, outcome.device,
                                                   outcome.study.device.min_contact_points);
  if (!missing.empty()) problems.push_back(options.file + ": " + missing);
  return problems;
}

int run_plan(const PlanOptions& options) {
  require_device(options.device);
  const PlanOutcome outcome = outcome_of(options);
  const std::vector<std::string> problems = problems_of(outcome, options);
  if (options.json) {
    ordered_json json = to_json(outcome, options);
    json["problems"] = problems;
    fmt::print("{}\n", json_text(json));
  } else {
    print(outcome, options);
  }
  // The sentences come after the table about which they speak.
  std::fflush(stdout);
  for (const std::string& problem : problems) fmt::print(stderr, "jnd: {}\n", problem);
  return problems.empty() ? kDone : kHasProblems;
}

}  // namespace

HelpPlace place_of_plan() { return {HelpGroup::kWriting, 40}; }

void add_plan(CLI::App& program, Invocation& invocation) {
  CLI::App* command = program.add_subcommand(
      "plan", "Orders, balance, duration and range of a study before anyone comes");
  invocation.examples[command] = {{"jnd plan my_study.json --participants 24",
                                   "orders, balance and length for 24 participants"}};
  const auto options = std::make_shared<PlanOptions>();
  options->device = std::string(device::devices().front().name);
  command->add_option("FILE", options->file, "Study file, or the name of a shipped study")
      ->required();
  command->add_option("--study", options->folder,
                      "Study folder whose completed sessions count");
  command->add_option("--participants", options->participants, "How many to plan")
      ->check(whole_number(1, 100000))
      ->capture_default_str();
  command->add_option("--seed", options->seed, "Of everything that is drawn")
      ->check(seed_number())
      ->capture_default_str();
  command->add_option("--laboratory", options->laboratory,
                      "Of simulated participants, who tell how long adaptive blocks take; "
                      "default: thesis, or thesis_exoskeleton with that device");
  add_field_option(*command, options->fields,
                   "What all of them bring; default: drawn for each");
  command->add_option("--device", options->device, "Whose limits; see `jnd devices`")
      ->capture_default_str();
  add_profile_option(*command, options->profile);
  command
      ->add_option("--speed-m-per-s", options->speed_m_per_s,
                   "Speed of the hand that forces are expected at")
      ->check(number_between(0.001, 10.0))
      ->capture_default_str();
  command->add_flag("--all", options->all,
                    "List all cells of the balance; default: of more than twelve the first");
  command->add_flag("--json", options->json, "Print one JSON document");
  command->callback(
      [&invocation, options] { invocation.run = [options] { return run_plan(*options); }; });
}

}  // namespace jnd::app
