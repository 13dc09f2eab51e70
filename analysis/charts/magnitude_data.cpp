#include "analysis/charts/magnitude_data.h"

#include "analysis/statistics/summary.h"

namespace jnd::analysis {

std::map<double, double> MagnitudeData::Own::means() const {
  std::map<double, double> means;
  for (const auto& [x, list] : values) {
    double sum = 0.0;
    for (const double value : list) sum += value;
    means[x] = sum / static_cast<double>(list.size());
  }
  return means;
}

std::map<double, std::vector<std::pair<std::string, double>>> MagnitudeData::by_x() const {
  std::map<double, std::vector<std::pair<std::string, double>>> all;
  for (const Own& own : participants) {
    for (const auto& [x, mean] : own.means()) all[x].emplace_back(own.participant, mean);
  }
  return all;
}

MagnitudeData magnitude_data(const FigureSource& source, const BlockDesign& block) {
  MagnitudeData data{.block = block.block,
                     .title = source.titles.title_of(block.block),
                     .quantity = block.quantity,
                     .is_production = block.produces()};
  for (const ParticipantData& participant : source.data.participants) {
    MagnitudeData::Own own{.participant = participant.participant};
    for (const core::TrialRow& trial : participant.trials_in(block.block)) {
      if (data.is_production) {
        if (!trial.target_percent || !trial.response) continue;
        own.values[*trial.target_percent / 100.0].push_back(*trial.response);
      } else if (trial.intensity && trial.response) {
        own.values[*trial.intensity].push_back(*trial.response / 100.0);
        own.repetitions[trial.repetition][*trial.intensity] = *trial.response / 100.0;
      }
    }
    if (!own.values.empty()) data.participants.push_back(std::move(own));
  }
  return data;
}

FigureTable own_means_table(const MagnitudeData& data) {
  FigureTable table{
      .name = file_word(data.block) + "_participants",
      .columns = {"series", "participant", "intensity", "magnitude", "low", "high"}};
  int series = 0;
  for (const MagnitudeData::Own& own : data.participants) {
    ++series;
    for (const auto& [x, values] : own.values) {
      const Summary summary = summary_of(values);
      const double mean = *summary.mean;
      const std::optional<double> sd = summary.standard_deviation;
      table.rows.push_back({series, own.participant, data.is_production ? mean : x,
                            data.is_production ? x : mean,
                            sd ? FigureCell(mean - *sd) : FigureCell(),
                            sd ? FigureCell(mean + *sd) : FigureCell()});
    }
  }
  return table;
}

FigureTable group_means_table(const MagnitudeData& data) {
  FigureTable table{
      .name = file_word(data.block) + "_means",
      .columns = {"intensity", "magnitude", "sd", "low", "high", "num_participants"}};
  for (const auto& [x, people] : data.by_x()) {
    std::vector<double> values;
    for (const auto& [who, mean] : people) values.push_back(mean);
    const Summary summary = summary_of(values);
    const double sd = summary.standard_deviation.value_or(0.0);
    table.rows.push_back({data.is_production ? *summary.mean : x,
                          data.is_production ? x : *summary.mean, summary.standard_deviation,
                          *summary.mean - sd, *summary.mean + sd, summary.num_values});
  }
  return table;
}

}  // namespace jnd::analysis
