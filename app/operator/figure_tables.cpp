#include "app/operator/figure_tables.h"

#include "analysis/export/csv_table_writer.h"

namespace jnd::app {
namespace {

using namespace results;
using analysis::CsvTableWriter;

template <typename Figure, typename Write>
void for_everyone(const Figure& figure, const Write& write) {
  write(figure.pooled);
  for (const auto& one : figure.participants) write(one);
}

void write_answers(const Discrimination& figure, const std::filesystem::path& file) {
  CsvTableWriter table(file, {{"who", "", ""},
                              {"intensity", "", ""},
                              {"ratio", "", ""},
                              {"ci95_low", "", ""},
                              {"ci95_high", "", ""},
                              {"num_yes", "", ""},
                              {"num_trials", "", ""}});
  for_everyone(figure, [&table](const PsychometricFigure& one) {
    for (const Proportion& point : one.points) {
      table.cell(one.who).cell(point.intensity).cell(point.ratio);
      table.cell(point.low).cell(point.high).cell(point.num_yes).cell(point.num_trials);
      table.end_row();
    }
  });
  table.finish();
}

void write_curves(const Discrimination& figure, const std::filesystem::path& file) {
  CsvTableWriter table(file, {{"who", "", ""},
                              {"intensity", "", ""},
                              {"probability", "", ""},
                              {"band_low", "", ""},
                              {"band_high", "", ""}});
  for_everyone(figure, [&table](const PsychometricFigure& one) {
    for (std::size_t i = 0; i < one.curve.size(); ++i) {
      table.cell(one.who).cell(one.curve[i].x).cell(one.curve[i].y);
      const bool has_band = i < one.band.size();
      table.cell(has_band ? std::optional(one.band[i].low) : std::nullopt);
      table.cell(has_band ? std::optional(one.band[i].high) : std::nullopt);
      table.end_row();
    }
  });
  table.finish();
}

void write_means(const Magnitude& figure, const std::filesystem::path& file) {
  CsvTableWriter table(file, {{"who", "", ""},
                              {"part", "", ""},
                              {"at", "", ""},
                              {"mean", "", ""},
                              {"sd_low", "", ""},
                              {"sd_high", "", ""},
                              {"geometric_mean", "", ""},
                              {"n", "", ""}});
  const auto add = [&table](const std::string& who, const std::string& part,
                            const std::vector<Mean>& means) {
    for (const Mean& mean : means) {
      table.cell(who).cell(part).cell(mean.at).cell(mean.arithmetic);
      table.cell(mean.arithmetic_low).cell(mean.arithmetic_high).cell(mean.geometric);
      table.cell(std::int64_t{mean.n});
      table.end_row();
    }
  };
  for_everyone(figure, [&add](const MagnitudeFigure& one) {
    add(one.who, "estimation", one.estimation);
    add(one.who, "production", one.production);
  });
  table.finish();
}

void write_power_laws(const Magnitude& figure, const std::filesystem::path& file) {
  CsvTableWriter table(file, {{"who", "", ""},
                              {"curve", "", ""},
                              {"k", "", ""},
                              {"a", "", ""},
                              {"published_k", "", ""},
                              {"published_a", "", ""}});
  const auto add = [&table](const std::string& who, const std::optional<PowerCurve>& curve) {
    if (!curve) return;
    table.cell(who).cell(curve->name).cell(curve->k).cell(curve->a);
    table.cell(curve->published_k).cell(curve->published_a);
    table.end_row();
  };
  for_everyone(figure, [&add](const MagnitudeFigure& one) {
    add(one.who, one.estimation_curve);
    add(one.who, one.production_curve);
    add(one.who, one.combined_curve);
  });
  table.finish();
}

void write_boxes(const std::vector<BoxFigure>& figures, const std::filesystem::path& file) {
  CsvTableWriter table(file, {{"quantity", "", ""},
                              {"block", "", ""},
                              {"n", "", ""},
                              {"median", "", ""},
                              {"lower_quartile", "", ""},
                              {"upper_quartile", "", ""},
                              {"lower_whisker", "", ""},
                              {"upper_whisker", "", ""},
                              {"num_outliers", "", ""}});
  for (const BoxFigure& figure : figures) {
    for (const Box& box : figure.boxes) {
      table.cell(figure.name).cell(box.label).cell(std::int64_t{box.n}).cell(box.median);
      table.cell(box.lower_quartile).cell(box.upper_quartile);
      table.cell(box.lower_whisker).cell(box.upper_whisker);
      table.cell(static_cast<std::int64_t>(box.outliers.size()));
      table.end_row();
    }
  }
  table.finish();
}

}  // namespace

int write_figure_tables(const ResultsModel& model, const std::filesystem::path& folder) {
  int num_files = 0;
  const auto place = [&](const std::string& name) {
    ++num_files;
    return folder / (name + ".csv");
  };
  for (const Discrimination& figure : model.discriminations) {
    write_answers(figure, place(figure.block + "_answers"));
    write_curves(figure, place(figure.block + "_curves"));
  }
  for (const Magnitude& figure : model.magnitudes) {
    const std::string name =
        figure.estimation_block.empty() ? figure.production_block : figure.estimation_block;
    write_means(figure, place(name + "_means"));
    write_power_laws(figure, place(name + "_power_laws"));
  }
  if (!model.boxes.empty()) write_boxes(model.boxes, place("boxes"));
  return num_files;
}

}  // namespace jnd::app
