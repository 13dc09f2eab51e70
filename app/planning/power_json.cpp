#include "app/planning/power_json.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/error.h"

namespace jnd::app {
namespace {

using nlohmann::ordered_json;
using namespace analysis;

ordered_json number(const std::optional<double>& value) {
  return value ? ordered_json(*value) : ordered_json();
}

std::optional<double> number_of(const ordered_json& json) {
  return json.is_null() ? std::nullopt : std::optional(json.get<double>());
}

constexpr std::pair<PlannedQuantity, const char*> kQuantities[] = {
    {PlannedQuantity::kWeberFraction, "weber_fraction"},
    {PlannedQuantity::kEstimationExponent, "estimation_exponent"},
    {PlannedQuantity::kProductionExponent, "production_exponent"},
    {PlannedQuantity::kMatch, "match"},
    {PlannedQuantity::kRating, "rating"}};

const char* word_of(PlannedQuantity quantity) {
  for (const auto& [known, word] : kQuantities) {
    if (known == quantity) return word;
  }
  return "";
}

PlannedQuantity quantity_of(const std::string& word) {
  for (const auto& [quantity, known] : kQuantities) {
    if (word == known) return quantity;
  }
  throw core::Error("quantity: expected one of this program's, found another");
}

ordered_json compare_json(const PowerDesign& design) {
  if (!design.request.compare) return nullptr;
  return ordered_json::array({design.request.compare->first, design.request.compare->second});
}

/// What shards and results have in common.
ordered_json request_json(const PowerDesign& design) {
  return {{"study", design.study},
          {"study_sha256", design.study_sha256},
          {"laboratory", design.laboratory},
          {"laboratory_sha256", design.laboratory_sha256},
          {"program_version", design.program_version},
          {"simulated", true},
          {"seed", design.request.seed},
          {"runs", design.request.num_runs},
          {"participants", design.request.sizes},
          {"compare", compare_json(design)},
          {"null_hypothesis", design.request.null_hypothesis},
          {"pse", design.request.free_pse ? "free" : "reference"},
          {"hierarchical", design.request.hierarchical}};
}

ordered_json to_json(const PlannedPower& power, const PlannedName& name, bool alike) {
  ordered_json json = {{"name", name.name},
                       {"primary", name.meaning == kPrimaryTest},
                       {"meaning", name.meaning},
                       {"power", power.power},
                       {"power_is", alike ? "false_positive_rate" : "power"},
                       {"power_ci95", {power.power_low, power.power_high}},
                       {"num_significant", power.num_significant},
                       {"num_undefined", power.num_undefined},
                       {"mean_difference", number(power.mean_difference)}};
  json["alpha"] = name.alpha;
  json["planned"] = name.of_contrast;
  if (name.of_contrast) {
    json["power_is"] = "power";
    json["effect_is"] = name.is_ratio ? "ratio" : "difference";
    json["mean_effect"] = number(power.mean_difference && name.is_ratio
                                     ? std::optional(std::exp(*power.mean_difference))
                                     : power.mean_difference);
  }
  return json;
}

ordered_json contrasts_json(const PowerDesign& design) {
  auto contrasts = ordered_json::array();
  for (const analysis::PowerContrast& one : design.analysis.contrasts) {
    contrasts.push_back({{"name", one.name},
                         {"meaning", one.meaning},
                         {"alpha", one.alpha},
                         {"margin", number(one.margin)},
                         {"effect_is", one.is_ratio ? "ratio" : "difference"}});
  }
  return contrasts;
}

constexpr std::pair<SpendingFunction, const char*> kSpendings[] = {
    {SpendingFunction::kObrienFleming, "obrien_fleming"},
    {SpendingFunction::kPocock, "pocock"}};

constexpr std::pair<Tail, const char*> kTails[] = {
    {Tail::kTwoSided, "either"}, {Tail::kGreater, "greater"}, {Tail::kLess, "less"}};

/// The rule of the looks; null if none are planned.
ordered_json rule_json(const std::optional<PlannedSequential>& planned) {
  if (!planned) return nullptr;
  const SequentialRule& rule = planned->boundaries.rule;
  const auto word = [](const auto& table, auto value) {
    for (const auto& [known, its_word] : table) {
      if (known == value) return its_word;
    }
    return "";
  };
  return {{"contrast", planned->contrast},
          {"looks", rule.looks},
          {"spending", word(kSpendings, rule.spending)},
          {"alpha", rule.alpha},
          {"direction", word(kTails, rule.tail)},
          {"nominal_levels", planned->boundaries.nominal_level}};
}

std::optional<PlannedSequential> planned_sequential_of(const ordered_json& json) {
  if (json.is_null()) return std::nullopt;
  const auto value = [&json](const auto& table, const char* key) {
    for (const auto& [its_value, word] : table) {
      if (json.at(key) == word) return its_value;
    }
    throw core::Error(std::string(key) + ": expected one of this program's, found another");
  };
  const SequentialRule rule{.looks = json.at("looks").get<std::vector<int>>(),
                            .spending = value(kSpendings, "spending"),
                            .alpha = json.at("alpha"),
                            .tail = value(kTails, "direction")};
  return PlannedSequential{.contrast = json.at("contrast"), .boundaries = boundaries_of(rule)};
}

ordered_json sequential_json(const PowerDesign& design, const SequentialPower& power,
                             bool alike) {
  ordered_json json = rule_json(design.analysis.sequential);
  json["power"] = power.power;
  json["power_is"] = alike ? "false_positive_rate" : "power";
  json["power_ci95"] = {power.power_low, power.power_high};
  json["expected_participants"] = power.mean_participants;
  json["expected_participants_standard_error"] = power.standard_error;
  json["fixed_power"] = power.fixed_power;
  json["fixed_participants"] =
      power.fixed_participants ? ordered_json(*power.fixed_participants) : ordered_json();
  json["num_ended"] = power.num_ended;
  json["num_significant"] = power.num_significant;
  return json;
}

ordered_json to_json(const PlannedPrecision& precision, const PlannedName& name,
                     const analysis::PlannedBlock& block) {
  return {{"name", name.name},
          {"meaning", name.meaning},
          {"true_value", number(block.true_value)},
          {"median", number(precision.median)},
          {"bias", number(precision.bias)},
          {"half_width_median", number(precision.half_width_median)},
          {"half_width_90", number(precision.half_width_90)},
          {"coverage", number(precision.coverage)},
          {"coverage_ci95", {precision.coverage_low, precision.coverage_high}},
          {"degenerate", number(precision.degenerate)},
          {"num_undefined", precision.num_undefined}};
}

}  // namespace

ordered_json to_json(const PowerDesign& design) {
  ordered_json json = request_json(design);
  json["paired"] = design.analysis.paired;
  auto blocks = ordered_json::array();
  for (const analysis::PlannedBlock& block : design.analysis.blocks) {
    blocks.push_back({{"name", block.name},
                      {"quantity", word_of(block.quantity)},
                      {"reference", block.reference},
                      {"either_interval", block.either_interval},
                      {"true_value", number(block.true_value)}});
  }
  json["blocks"] = std::move(blocks);
  auto durations = ordered_json::array();
  for (const PlannedDuration& duration : design.durations) {
    durations.push_back({duration.mean_s, duration.total_s});
  }
  json["durations_s"] = std::move(durations);
  json["left_out"] = design.left_out;
  json["contrasts"] = contrasts_json(design);
  if (design.analysis.sequential) json["sequential"] = rule_json(design.analysis.sequential);
  return json;
}

PowerDesign power_design_of(const ordered_json& json) {
  PowerDesign design{.study = json.at("study"),
                     .study_sha256 = json.at("study_sha256"),
                     .laboratory = json.at("laboratory"),
                     .laboratory_sha256 = json.at("laboratory_sha256"),
                     .program_version = json.at("program_version")};
  PowerRequest& request = design.request;
  request.sizes = json.at("participants").get<std::vector<int>>();
  request.num_runs = json.at("runs");
  request.seed = json.at("seed");
  request.free_pse = json.at("pse") == "free";
  request.hierarchical = json.at("hierarchical");
  request.null_hypothesis = json.at("null_hypothesis");
  for (const ordered_json& block : json.at("blocks")) {
    design.analysis.blocks.push_back({.name = block.at("name"),
                                      .quantity = quantity_of(block.at("quantity")),
                                      .reference = block.at("reference"),
                                      .either_interval = block.at("either_interval"),
                                      .true_value = number_of(block.at("true_value"))});
  }
  const auto place_of = [&](const std::string& name) {
    for (std::size_t place = 0; place < design.analysis.blocks.size(); ++place) {
      if (design.analysis.blocks[place].name == name) return place;
    }
    throw core::Error("compare: expected a block of the shard, found another");
  };
  if (!json.at("compare").is_null()) {
    request.compare = {json.at("compare").at(0), json.at("compare").at(1)};
    design.analysis.compared = {place_of(request.compare->first),
                                place_of(request.compare->second)};
  }
  design.analysis.paired = json.at("paired");
  design.analysis.sizes = request.sizes;
  design.analysis.free_pse = request.free_pse;
  design.analysis.hierarchical = request.hierarchical;
  for (const ordered_json& one : json.at("durations_s")) {
    design.durations.push_back({.mean_s = one.at(0), .total_s = one.at(1)});
  }
  design.left_out = json.at("left_out").get<std::vector<std::string>>();
  // Shards of programs that knew no contrasts contain none.
  for (const ordered_json& one : json.value("contrasts", ordered_json::array())) {
    design.analysis.contrasts.push_back({.name = one.at("name"),
                                         .meaning = one.at("meaning"),
                                         .alpha = one.at("alpha"),
                                         .margin = number_of(one.at("margin")),
                                         .is_ratio = one.at("effect_is") == "ratio"});
  }
  design.analysis.sequential = planned_sequential_of(json.value("sequential", ordered_json()));
  constexpr std::int64_t kMostRuns = 1'000'000;
  if (request.sizes.empty() || design.durations.size() != request.sizes.size() ||
      request.num_runs < 1 || request.num_runs > kMostRuns) {
    throw core::Error("design: expected sizes, durations and 1 to 1000000 runs, found others");
  }
  return design;
}

ordered_json to_json(const PlannedRun& run) {
  auto json = ordered_json::array();
  for (const PlannedSize& size : run.sizes) {
    auto estimates = ordered_json::array();
    for (const PlannedEstimate& one : size.estimates) {
      estimates.push_back({number(one.value), number(one.ci95.low), number(one.ci95.high)});
    }
    auto tests = ordered_json::array();
    for (const PlannedTest& one : size.tests) {
      tests.push_back({number(one.difference), number(one.p_value)});
    }
    json.push_back({{"estimates", std::move(estimates)},
                    {"tests", std::move(tests)},
                    {"with_answers", size.num_with_answers},
                    {"degenerate", size.num_degenerate},
                    {"at_grid_end", size.num_at_grid_end}});
  }
  if (!run.sequential) return json;
  std::string fixed;
  for (const bool significant : run.sequential->fixed_significant) {
    fixed += significant ? '1' : '0';
  }
  return {{"sizes", std::move(json)},
          {"sequential",
           {{"look", run.sequential->look},
            {"significant", run.sequential->significant},
            {"fixed_significant", fixed}}}};
}

namespace {

SequentialRun sequential_run_of(const ordered_json& json, const PlannedSequential& planned) {
  const std::vector<int>& looks = planned.boundaries.rule.looks;
  SequentialRun run{.look = json.at("look"), .significant = json.at("significant")};
  for (const char one : json.at("fixed_significant").get<std::string>()) {
    run.fixed_significant.push_back(one == '1');
  }
  const auto num_sizes = static_cast<std::size_t>(looks.back() - looks.front()) + 1;
  if (run.look >= looks.size() || run.fixed_significant.size() != num_sizes) {
    throw core::Error("run: expected one that its looks ended, found another");
  }
  return run;
}

}  // namespace

PlannedRun planned_run_of(const ordered_json& json, const PlannedAnalysis& analysis) {
  PlannedRun run;
  if (analysis.sequential) {
    run.sequential = sequential_run_of(json.at("sequential"), *analysis.sequential);
  }
  for (const ordered_json& size : analysis.sequential ? json.at("sizes") : json) {
    PlannedSize& read = run.sizes.emplace_back();
    for (const ordered_json& one : size.at("estimates")) {
      read.estimates.push_back(
          {number_of(one.at(0)), {number_of(one.at(1)), number_of(one.at(2))}});
    }
    for (const ordered_json& one : size.at("tests")) {
      read.tests.push_back({number_of(one.at(0)), number_of(one.at(1))});
    }
    read.num_with_answers = size.at("with_answers").get<std::vector<int>>();
    read.num_degenerate = size.at("degenerate").get<std::vector<int>>();
    read.num_at_grid_end = size.at("at_grid_end").get<std::vector<int>>();
    if (read.estimates.size() != estimate_names(analysis).size() ||
        read.tests.size() != test_names(analysis).size() ||
        read.num_with_answers.size() != analysis.blocks.size() ||
        read.num_degenerate.size() != analysis.blocks.size() ||
        read.num_at_grid_end.size() != analysis.blocks.size()) {
      throw core::Error("run: expected as many numbers as its design asks for, found others");
    }
  }
  if (run.sizes.size() != analysis.sizes.size()) {
    throw core::Error("run: expected every size of its design, found others");
  }
  return run;
}

ordered_json power_result(const PowerDesign& design,
                          const std::vector<PlannedSummary>& summaries,
                          const std::optional<SequentialPower>& sequential) {
  const std::vector<PlannedName> tests = test_names(design.analysis);
  const std::vector<PlannedName> estimates = estimate_names(design.analysis);
  ordered_json json = request_json(design);
  json["level"] = kPlannedLevel;
  json["contrasts"] = contrasts_json(design);
  const bool alike = design.request.null_hypothesis || nothing_differs(design.analysis);
  json["true_difference"] = number(true_difference(design.analysis));
  json["nothing_differs"] = alike;
  auto sizes = ordered_json::array();
  for (std::size_t size = 0; size < summaries.size(); ++size) {
    const PlannedSummary& summary = summaries[size];
    ordered_json one = {{"participants", summary.num_participants},
                        {"duration_per_participant_s", design.durations[size].mean_s},
                        {"total_duration_s", design.durations[size].total_s},
                        {"tests", ordered_json::array()},
                        {"estimates", ordered_json::array()}};
    for (std::size_t test = 0; test < tests.size(); ++test) {
      one["tests"].push_back(to_json(summary.tests[test], tests[test], alike));
    }
    for (std::size_t estimate = 0; estimate < estimates.size(); ++estimate) {
      one["estimates"].push_back(to_json(summary.estimates[estimate], estimates[estimate],
                                         design.analysis.blocks[estimates[estimate].block]));
    }
    one["at_grid_end"] = ordered_json::object();
    for (std::size_t block = 0; block < design.analysis.blocks.size(); ++block) {
      one["at_grid_end"][design.analysis.blocks[block].name] = summary.at_grid_end[block];
    }
    sizes.push_back(std::move(one));
  }
  json["sizes"] = std::move(sizes);
  if (sequential) json["sequential"] = sequential_json(design, *sequential, alike);
  json["left_out"] = design.left_out;
  json["warnings"] =
      planning_doubts(design.analysis, summaries, design.request.null_hypothesis);
  if (sequential && alike) {
    const std::string doubt = sequential_doubt(*design.analysis.sequential, *sequential);
    if (!doubt.empty()) json["warnings"].push_back(doubt);
  }
  return json;
}

}  // namespace jnd::app
