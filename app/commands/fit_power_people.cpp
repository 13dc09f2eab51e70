#include "app/commands/fit_power_people.h"

#include <algorithm>
#include <map>

#include "analysis/mixed/mixed_json.h"
#include "analysis/mixed/power_people.h"
#include "analysis/report/power_law_figure.h"
#include "analysis/report/single_figure.h"

namespace jnd::app {
namespace {

/// The participant of each row of the table, by the line on which the row begins.
std::map<int, std::string> participants_by_line(const analysis::CsvTable& table,
                                                const std::string& participant) {
  std::map<int, std::string> participants;
  analysis::CsvReader reader(table);
  if (const std::optional<std::size_t> column = reader.column(participant)) {
    for (std::size_t row = 0; row < table.num_rows(); ++row) {
      const std::string& cell = table.cell(row, *column);
      if (cell.empty()) reader.report(row, participant, "whose the row is");
      participants[table.line(row)] = cell;
    }
  }
  reader.throw_problems();
  return participants;
}

void print_people(const analysis::PeoplePowerFit& fit) {
  std::size_t width = std::string("participant").size();
  for (const auto& one : fit.people) width = std::max(width, one.participant.size());
  fmt::print("  {:<{}}  {:>9}  {:>9}  {:>9}  {:>9}  {:>5}\n", "participant", width, "k", "a",
             "own k", "own a", "rows");
  for (const auto& one : fit.people) {
    fmt::print("  {:<{}}  {:>9}  {:>9}  {:>9}  {:>9}  {:>5}\n", one.participant, width,
               number(one.k), number(one.a), number(one.own_k), number(one.own_a),
               one.num_rows);
  }
}

void print_power_people(const analysis::PeoplePowerFit& fit, const std::vector<int>& lines) {
  fmt::print(
      "  S = k I^a of {} participants, {} rows: a linear mixed model of the logarithms by "
      "restricted maximum likelihood\n",
      fit.num_people, fit.num_rows);
  print_excluded(fit.excluded, lines);
  for (const std::string& warning : fit.warnings) fmt::print("  note: {}\n", warning);
  if (fit.status != analysis::FitStatus::kOk) {
    fmt::print("  no power law: {}\n", fit.reason);
    return;
  }
  const auto print = [](const char* name, const std::optional<double>& value,
                        const analysis::Interval& ci95, const std::optional<double>& error) {
    fmt::print("  {:<10} {:<8}  95 % {}, standard error {}\n", name, number(value),
               whole_range(ci95), number(error));
  };
  print("k", fit.k, fit.k_ci95, fit.k_standard_error);
  print("a", fit.a, fit.a_ci95, fit.a_standard_error);
  if (fit.degrees_of_freedom) {
    fmt::print(
        "  intervals by Student's t with {:g} degrees of freedom, as there are fewer than {} "
        "participants\n",
        *fit.degrees_of_freedom, analysis::kFewPeople);
  } else {
    fmt::print("  intervals by the profile of the likelihood\n");
  }
  fmt::print(
      "  standard deviation between participants: a {}, ln k {}{}; of rows about their own "
      "law: "
      "{}\n",
      number(fit.a_sd), number(fit.ln_k_sd),
      fit.correlation ? ", correlation " + number(fit.correlation) : "",
      number(fit.residual_sd_ln));
  print_people(fit);
}

}  // namespace

void print_excluded(const std::vector<analysis::PowerFit::Excluded>& excluded,
                    const std::vector<int>& lines) {
  std::map<std::string, std::vector<int>> lines_by_reason;
  for (const analysis::PowerFit::Excluded& one : excluded) {
    lines_by_reason[one.reason].push_back(lines[one.row]);
  }
  for (const auto& [reason, of_it] : lines_by_reason) {
    const std::string who =
        of_it.size() == 1 ? "line" : fmt::format("{} rows, lines", of_it.size());
    fmt::print("  left out {} {}: {}\n", who, fmt::join(of_it, ", "), reason);
  }
}

int fit_power_people(const TableOptions& options, const std::string& participant) {
  if (std::ranges::find(options.group_by, participant) != options.group_by.end()) {
    throw UsageError(
        fmt::format("--group-by: expected columns other than that of --participant, found {}",
                    participant));
  }
  const analysis::CsvTable table = analysis::CsvTable::read(options.csv);
  const std::map<int, std::string> participants = participants_by_line(table, participant);
  std::vector<analysis::DrawnPowerLaw> laws;
  const int outcome = fit_groups(
      analysis::read_magnitudes(table, options.group_by), options, "power law",
      [&](const auto& group) {
        std::vector<analysis::PersonMagnitude> rows;
        for (std::size_t i = 0; i < group.rows.size(); ++i) {
          rows.push_back({participants.at(group.lines[i]), group.rows[i]});
        }
        analysis::PeoplePowerFit fit = analysis::fit_power_of_people(rows);
        laws.push_back(
            {.name = heading_of(group.key), .rows = group.rows, .k = fit.k, .a = fit.a});
        return fit;
      },
      [](const auto& fit, const auto& group) { print_power_people(fit, group.lines); });
  if (!options.figure.empty()) {
    analysis::write_single_figure(analysis::power_law_figure(laws), options.figure);
  }
  return outcome;
}

}  // namespace jnd::app
