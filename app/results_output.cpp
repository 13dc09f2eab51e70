#include "app/results_output.h"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "app/session_setup.h"
#include "app/share.h"
#include "core/storage/study_store.h"

namespace jnd::app {
namespace {

using analysis::Estimate;
using analysis::Interval;
using nlohmann::json;

json number(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? json(*value) : json(nullptr);
}

json interval(const Interval& ci95) {
  return json::array({number(ci95.low), number(ci95.high)});
}

std::string text(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? fmt::format("{:.4f}", *value) : "-";
}

std::string text(const Interval& ci95) {
  if (!ci95.low && !ci95.high) return "-";
  return fmt::format("{} .. {}", ci95.low ? text(ci95.low) : "open",
                     ci95.high ? text(ci95.high) : "open");
}

std::string p_text(const std::optional<double>& p_value) {
  if (!p_value) return "p undefined";
  return *p_value < 0.0001 ? "p < 0.0001" : fmt::format("p = {:.4f}", *p_value);
}

std::string published_text(const Estimate& estimate) {
  if (estimate.published_positive) return "> 0";
  if (!estimate.published) return "-";
  return estimate.published_sd
             ? fmt::format("{:.4f} (sd {:.4f})", *estimate.published, *estimate.published_sd)
             : fmt::format("{:.4f}", *estimate.published);
}

/// Text of the shipped laboratory of this name; "" if there is none.
std::string shipped(const std::string& name) {
  std::ifstream file(share_folder() / "data" / "laboratories" / (name + ".json"),
                     std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

/// What the simulated value may be credited with.
std::string basis_of(const Estimate& estimate) {
  if (estimate.calibrated) return "calibrated";
  return estimate.implied ? "implied" : "held out";
}

bool is_published(const Estimate& estimate) {
  return estimate.published || estimate.published_positive;
}

/// Whether our interval holds the published value, or lies above zero as was published; nothing
/// where there is no such interval.
std::optional<bool> holds_published(const Estimate& estimate) {
  const Interval& ci95 = estimate.ci95;
  if (estimate.published_positive && ci95.low) return *ci95.low > 0.0;
  if (!estimate.published || (!ci95.low && !ci95.high)) return std::nullopt;
  return (!ci95.low || *estimate.published >= *ci95.low) &&
         (!ci95.high || *estimate.published <= *ci95.high);
}

std::string heading(const analysis::StudyResults& results) {
  std::string line =
      fmt::format("{}: {} participants", results.study, results.num_participants);
  if (results.simulated) {
    line += fmt::format(", SIMULATED (laboratory \"{}\"{})", results.laboratory,
                        results.laboratory_changed ? ", CHANGED from the shipped one" : "");
  }
  return line + "\n";
}

constexpr char kRow[] = "  {:<46} {:>10}  {:>20}  {:>5}  {:>22}  {}\n";

std::string header() {
  return fmt::format(kRow, "", "value", "95 % interval", "unit", "published", "inside") + "  " +
         std::string(119, '-') + "\n";
}

std::string row(const Estimate& estimate) {
  const std::optional<bool> inside = holds_published(estimate);
  return fmt::format(kRow, estimate.name, text(estimate.value), text(estimate.ci95),
                     estimate.unit == "1" ? "" : estimate.unit, published_text(estimate),
                     inside ? (*inside ? "yes" : "no") : "");
}

/// A row of `jnd results`: what the number is, and what was published if anything was.
std::string explained_row(const Estimate& estimate) {
  std::string line =
      fmt::format("  {:<46} {:>10}  {:>20}  {:>5}  n {:>3}  {}", estimate.name,
                  text(estimate.value), text(estimate.ci95),
                  estimate.unit == "1" ? "" : estimate.unit, estimate.n, estimate.meaning);
  if (is_published(estimate)) line += "; published " + published_text(estimate);
  return line + "\n";
}

}  // namespace

analysis::StudyResults results_of_folder(const std::filesystem::path& folder,
                                         const analysis::ResultsOptions& options) {
  const core::StudyStore store(folder, core::StudyStore::Mode::kReadOnly);
  require_unblinded(store);
  return results_of_data(analysis::load_study(store), options);
}

analysis::StudyResults results_of_data(const analysis::StudyData& data,
                                       const analysis::ResultsOptions& options) {
  analysis::StudyResults results = analysis::results_of(
      data, analysis::published_for(data.study, share_folder() / "data" / "published"),
      options);
  results.laboratory_changed =
      data.simulated && data.laboratory_text != shipped(data.laboratory);
  return results;
}

json to_json(const analysis::StudyResults& results) {
  json sections = json::array();
  for (const analysis::ResultsSection& section : results.sections) {
    json estimates = json::array();
    for (const Estimate& estimate : section.estimates) {
      const std::optional<bool> inside = holds_published(estimate);
      estimates.push_back(
          {{"name", estimate.name},
           {"value", number(estimate.value)},
           {"ci95", interval(estimate.ci95)},
           {"unit", estimate.unit},
           {"meaning", estimate.meaning},
           {"published", number(estimate.published)},
           {"published_sd", number(estimate.published_sd)},
           {"published_positive", estimate.published_positive},
           {"calibrated", estimate.calibrated},
           {"basis", results.simulated && is_published(estimate) ? json(basis_of(estimate))
                                                                 : json(nullptr)},
           {"published_inside_ci95", inside ? json(*inside) : json(nullptr)},
           {"n", estimate.n}});
    }
    json comparisons = json::array();
    for (const analysis::NamedComparison& named : section.comparisons) {
      const analysis::Comparison& c = named.comparison;
      comparisons.push_back({{"name", named.name},
                             {"status", std::string(to_string(c.status))},
                             {"reason", c.reason},
                             {"method", c.method},
                             {"estimate", number(c.estimate)},
                             {"ci95", interval(c.ci95)},
                             {"statistic", number(c.statistic)},
                             {"degrees_of_freedom", number(c.degrees_of_freedom)},
                             {"p_value", number(c.p_value)},
                             {"cohen_dz", number(c.cohen_dz)},
                             {"n_a", c.num_a},
                             {"n_b", c.num_b}});
    }
    json participants = json::array();
    for (const analysis::ParticipantEstimate& own : section.participants) {
      participants.push_back({{"participant", own.participant},
                              {"name", own.name},
                              {"value", number(own.value)},
                              {"ci95", interval(own.ci95)},
                              {"reason", own.reason}});
    }
    json excluded = json::array();
    for (const analysis::ExcludedParticipant& one : section.excluded) {
      excluded.push_back({{"participant", one.participant}, {"reason", one.reason}});
    }
    sections.push_back({{"name", section.name},
                        {"estimates", std::move(estimates)},
                        {"participants", std::move(participants)},
                        {"comparisons", std::move(comparisons)},
                        {"excluded", std::move(excluded)}});
  }
  return {
      {"study", results.study},           {"simulated", results.simulated},
      {"laboratory", results.laboratory}, {"laboratory_changed", results.laboratory_changed},
      {"citation", results.citation},     {"num_participants", results.num_participants},
      {"sections", std::move(sections)}};
}

std::string to_table(const analysis::StudyResults& results) {
  std::string table = heading(results);
  for (const analysis::ResultsSection& section : results.sections) {
    table += fmt::format("\n{}\n", section.name);
    for (const Estimate& estimate : section.estimates) table += explained_row(estimate);
    for (const analysis::ParticipantEstimate& own : section.participants) {
      table += fmt::format("  {:<46} {:>10}  {:>20}  {}\n", own.participant + " " + own.name,
                           text(own.value), text(own.ci95), own.reason);
    }
    for (const analysis::NamedComparison& named : section.comparisons) {
      const analysis::Comparison& c = named.comparison;
      if (c.status != analysis::FitStatus::kOk) {
        table += fmt::format("  {}: {}\n", named.name, c.reason);
        continue;
      }
      table += fmt::format("  {}: difference {} ({}), t({:.1f}) = {:.2f}, {}\n", named.name,
                           text(c.estimate), text(c.ci95), c.degrees_of_freedom.value_or(0.0),
                           c.statistic.value_or(0.0), p_text(c.p_value));
    }
    for (const analysis::ExcludedParticipant& one : section.excluded) {
      table += fmt::format("  left out: {}: {}\n", one.participant, one.reason);
    }
  }
  return table;
}

std::string to_comparison_table(const analysis::StudyResults& results) {
  std::string table = heading(results) + header();
  const std::pair<const char*, const char*> kBases[] = {
      {"calibrated", "calibrated: the laboratory was fitted to the published value"},
      {"implied", "held out, but implied: follows nearly from what was calibrated"},
      {"held out", "held out: the laboratory knows nothing of the published value"}};
  for (const auto& [basis, title] : kBases) {
    bool first = true;
    for (const analysis::ResultsSection& section : results.sections) {
      for (const Estimate& estimate : section.estimates) {
        if (!is_published(estimate) || basis_of(estimate) != basis) continue;
        if (!estimate.value) continue;  // Of a stiff hand, say, whose fingers cannot trail.
        if (first && results.simulated) {
          table += std::string("  ") + title +
                   (results.laboratory_changed ? ", before it was changed\n" : "\n");
        }
        first = false;
        table += row(estimate);
      }
    }
  }
  for (const analysis::ResultsSection& section : results.sections) {
    for (const analysis::ExcludedParticipant& one : section.excluded) {
      table += fmt::format("  left out: {}: {}\n", one.participant, one.reason);
    }
  }
  return table;
}

}  // namespace jnd::app
