#include <algorithm>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>

#include "analysis/export/bids_blocks.h"
#include "analysis/export/bids_text.h"
#include "analysis/export/csv_table_writer.h"
#include "analysis/export/study_tables.h"
#include "analysis/export/table_columns.h"

namespace jnd::analysis {
namespace {

namespace fs = std::filesystem;

const std::vector<CsvColumn>& bids_event_columns() {
  static const std::vector<CsvColumn> kColumns = {
      {"onset", "s", "From the first sample of the task"},
      {"duration", "s", "Until the stimulus ended or samples came again"},
      {"trial_type", "",
       "test, reference or free_space: what was presented in a trial; medium_explored: felt "
       "outside of trials; missing_samples: a gap in the recording, in which nothing is filled "
       "in"},
      {"trial", "", "Running number in the session, from 1"},
      {"attempt", "", "1, or more if the trial was repeated"},
      {"presentation", "", "Within the attempt, from 1"},
      {"medium", "", "What was rendered"},
      {"intensity", "unit of quantity", "What was presented; its quantity is told in beh"},
      {"response", "",
       "Of the trial: percent; 1 yes, 0 no, n/a cannot tell; in production the value set"},
      {"response_time", "s", "Of the trial: from the start of its last stimulus to the answer"},
      {"sample", "", "Ticks since the first of the task: the row in its motion file, from 0"},
      {"excluded", "", "1: the trial is set aside"},
      {"simulated", "", "1: SIMULATED participant and apparatus"},
  };
  return kColumns;
}

/// The columns of measurements that events have.
const Columns<core::PresentationMeasures>& measured_columns() {
  static const Columns<core::PresentationMeasures> kColumns = [] {
    auto all = stored_columns<core::PresentationMeasures>(
        [](const core::PresentationMeasures& it) -> const auto& { return it; });
    core::for_each_column<core::PresentationMeasures>([&](const auto& column, const auto&) {
      if (column.bids_events == core::BidsEvents::kHave) return;
      std::erase_if(all, [&](const auto& one) {
        return std::string_view(one.column.name) == column.name;
      });
    });
    return all;
  }();
  return kColumns;
}

std::vector<CsvColumn> all_event_columns() {
  std::vector<CsvColumn> all = bids_event_columns();
  std::ranges::copy(told(measured_columns()), std::back_inserter(all));
  return all;
}

struct BidsEvent {
  std::int64_t first_tick = 0, last_tick = 0;
  // If both are null, samples are missing.
  const ExportedPresentation* presentation = nullptr;
  const BidsExploration* explored = nullptr;
};

std::vector<BidsEvent> events_of(const BidsBlock& block,
                                 const std::vector<core::TickRange>& gaps) {
  std::vector<BidsEvent> events;
  for (const ExportedPresentation& one : block.presentations) {
    events.push_back({one.row.first_tick, one.row.last_tick, &one});
  }
  for (const BidsExploration& one : block.explored) {
    events.push_back({one.first_tick, one.last_tick, nullptr, &one});
  }
  for (const core::TickRange& gap : gaps) events.push_back({gap.first_tick, gap.last_tick});
  std::ranges::stable_sort(events, {}, &BidsEvent::first_tick);
  return events;
}

void write_presented(TableWriter& table, const core::PresentationRow& row,
                     const core::TrialRow& trial) {
  table.cell(row.interval).cell(row.trial).cell(row.attempt).cell(row.presentation);
  table.cell(row.interval == "free_space" ? row.interval : trial.medium).cell(row.intensity);
  table.cell(trial.response).cell(trial.measures.response_time_s);
}

/// Writes the measurements of a presentation, or empty cells without one.
void write_measured(TableWriter& table, const ExportedPresentation* presentation) {
  for (const auto& column : measured_columns()) {
    if (presentation != nullptr) {
      column.put(table, presentation->row.measures);
    } else {
      table.nothing();
    }
  }
}

void write_explored(TableWriter& table, const BidsExploration& one) {
  table.cell("medium_explored").nothing().nothing().nothing().cell(one.medium);
  table.cell(one.intensity).nothing().nothing();
}

void write_missing(TableWriter& table) {
  table.cell("missing_samples").nothing().nothing().nothing().nothing();
  table.nothing().nothing().nothing();
}

}  // namespace

void write_bids_events(const fs::path& front, const BidsBlock& block,
                       const core::SessionRow& session,
                       const std::vector<core::TickRange>& gaps) {
  std::map<std::int64_t, const core::TrialRow*> trials;
  for (const ExportedTrial& trial : block.trials) trials[trial.row.trial] = &trial.row;
  CsvTableWriter table(front.string() + "_events.tsv", all_event_columns(), TableStyle::kBids);
  for (const BidsEvent& event : events_of(block, gaps)) {
    const std::int64_t sample = event.first_tick - block.first_tick;
    table.cell(static_cast<double>(sample) / session.rate_hz);
    table.cell(static_cast<double>(event.last_tick - event.first_tick + 1) / session.rate_hz);
    if (event.presentation != nullptr) {
      const core::PresentationRow& row = event.presentation->row;
      write_presented(table, row, *trials.at(row.trial));
    } else if (event.explored != nullptr) {
      write_explored(table, *event.explored);
    } else {
      write_missing(table);
    }
    table.cell(sample);
    if (event.presentation != nullptr) {
      table.cell(event.presentation->excluded);
    } else {
      table.nothing();
    }
    table.cell(session.simulated);
    write_measured(table, event.presentation);
    table.end_row();
  }
  table.finish();
  write_json(front.string() + "_events.json", described(all_event_columns()));
}

namespace {

/// A question after the trials of a block, as a column of the trials.
struct QuestionColumn {
  std::string question, name, unit, words;
};

std::vector<QuestionColumn> question_columns_of(const BidsBlock& block) {
  std::vector<QuestionColumn> columns;
  for (const ExportedAnswer& one : block.answers) {
    if (std::ranges::find(columns, one.row.question, &QuestionColumn::question) !=
        columns.end()) {
      continue;
    }
    columns.push_back({one.row.question, "question_" + one.row.question, one.unit,
                       "Answer after the trial: " + one.asked});
  }
  return columns;
}

}  // namespace

void write_bids_beh(const fs::path& folder, const BidsTask& task, const BidsBlock& block,
                    const core::SessionRow& session, FactorColumns& factors) {
  const std::vector<CsvColumn>& all = factors.columns();
  std::vector<CsvColumn> columns(all.begin() + kNumTrialOwners, all.end());
  const std::vector<QuestionColumn> asked = question_columns_of(block);
  for (const QuestionColumn& one : asked) {
    columns.push_back({one.name.c_str(), one.unit.c_str(), one.words.c_str()});
  }
  CsvTableWriter table(folder / (task.front + "_beh.tsv"), columns, TableStyle::kBids);
  for (const ExportedTrial& trial : block.trials) {
    write_trial_cells(table, session, trial, factors);
    for (const QuestionColumn& one : asked) {
      const auto given = std::ranges::find_if(block.answers, [&](const ExportedAnswer& answer) {
        return answer.row.trial == trial.row.trial && answer.row.question == one.question;
      });
      table.cell(given == block.answers.end() ? std::string() : given->row.answer);
    }
    table.end_row();
  }
  table.finish();
  nlohmann::ordered_json sidecar = {{"TaskName", task.task_name},
                                    {"TaskDescription", task.description},
                                    {"FirstTick", block.first_tick}};
  sidecar.update(described(columns));
  for (const char* tick : {"first_tick", "last_tick"}) {
    sidecar[tick]["Description"] = sidecar[tick]["Description"].get<std::string>() +
                                   ", counted in the session; less FirstTick it is the row in "
                                   "the motion file, if there is one, from 0, where that has "
                                   "the rate of the loop";
  }
  sidecar["excluded"]["Description"] =
      "1: set aside with a reason, which the study in sourcedata has";
  write_json(folder / (task.front + "_beh.json"), sidecar);
}

}  // namespace jnd::analysis
