#include "analysis/results/predictive_people.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <set>

#include "analysis/results/magnitude_section.h"
#include "core/error.h"

namespace jnd::analysis {
namespace {

using nlohmann::ordered_json;

constexpr int kFormat = 1;
constexpr std::string_view kYes = "num_yes.", kTrials = "num_trials.", kMean = "mean.";

/// One person's values by column. Values that are not whole have six digits.
std::map<std::string, double> columns_of(const PersonOutcome& person) {
  std::map<std::string, double> values = person.numbers;
  for (const auto& [block, levels] : person.counts) {
    for (const auto& [intensity, count] : levels) {
      const std::string level = block + "@" + number_text(intensity);
      values[std::string(kYes) + level] = static_cast<double>(count.num_yes);
      values[std::string(kTrials) + level] = static_cast<double>(count.num_trials);
    }
  }
  for (const auto& [block, means] : person.means) {
    for (const auto& [x, mean] : means) {
      values[std::string(kMean) + block + "@" + number_text(x)] = mean;
    }
  }
  return values;
}

ordered_json six_digits(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  const double rounded = std::strtod(text, nullptr);
  if (rounded == std::floor(rounded)) return static_cast<std::int64_t>(rounded);
  return rounded;
}

/// The block and x in a column's name after its prefix, such as "group_d@1.093".
struct Place {
  std::string block;
  double x = 0.0;
};
Place place_in(const std::string& column, std::string_view prefix) {
  const std::size_t at = column.rfind('@');
  if (at == std::string::npos) throw core::Error("column " + column + " without `@`");
  return {column.substr(prefix.size(), at - prefix.size()), std::stod(column.substr(at + 1))};
}

void set_value(PersonOutcome& person, const std::string& column, double value) {
  if (column.starts_with(kYes) || column.starts_with(kTrials)) {
    const bool is_yes = column.starts_with(kYes);
    const auto [block, intensity] = place_in(column, is_yes ? kYes : kTrials);
    AnswerCount& count = person.counts[block][intensity];
    count.intensity = intensity;
    (is_yes ? count.num_yes : count.num_trials) = std::llround(value);
  } else if (column.starts_with(kMean)) {
    const auto [block, x] = place_in(column, kMean);
    person.means[block][x] = value;
  } else {
    person.numbers[column] = value;
  }
}

ordered_json header_of(const PredictivePeople& people) {
  return {{"format", kFormat},
          {"comment",
           "Simulated people, one a line, from whom studies are drawn to compare published "
           "values with: see README.md beside this file. Nothing published is in it."},
          {"study", people.key.study},
          {"study_sha256", people.key.study_sha256},
          {"laboratory", people.key.laboratory},
          {"laboratory_sha256", people.key.laboratory_sha256},
          {"device", people.key.device},
          {"seed", people.seed}};
}

PredictivePeople people_of(const ordered_json& document) {
  if (document.at("format") != kFormat) throw core::Error("another format than 1");
  const auto text = [&](const char* key) { return document.at(key).get<std::string>(); };
  PredictivePeople people{.key = {.study = text("study"),
                                  .study_sha256 = text("study_sha256"),
                                  .laboratory = text("laboratory"),
                                  .laboratory_sha256 = text("laboratory_sha256"),
                                  .device = text("device")},
                          .seed = document.at("seed").get<std::uint64_t>()};
  const auto columns = document.at("columns").get<std::vector<std::string>>();
  for (const ordered_json& row : document.at("people")) {
    if (row.size() != columns.size()) throw core::Error("a person without all columns");
    const auto group = row.at(0).get<std::size_t>();
    if (group > people.groups.size()) throw core::Error("groups out of their order");
    if (group == people.groups.size()) people.groups.emplace_back();
    PersonOutcome person{.cells = row.at(1).get<std::string>()};
    for (std::size_t i = 2; i < columns.size(); ++i) {
      if (!row[i].is_null()) set_value(person, columns[i], row[i].get<double>());
    }
    people.groups[group].push_back(std::move(person));
  }
  return people;
}

}  // namespace

int PredictivePeople::num_people() const noexcept {
  std::size_t num = 0;
  for (const auto& group : groups) num += group.size();
  return static_cast<int>(num);
}

std::string to_text(const PredictivePeople& people) {
  std::vector<std::map<std::string, double>> values;
  std::set<std::string> names;
  for (const auto& group : people.groups) {
    for (const PersonOutcome& person : group) {
      values.push_back(columns_of(person));
      for (const auto& [name, value] : values.back()) names.insert(name);
    }
  }
  ordered_json columns = {"group", "cells"};
  for (const std::string& name : names) columns.push_back(name);
  std::string rows;
  std::size_t place = 0;
  for (std::size_t group = 0; group < people.groups.size(); ++group) {
    for (const PersonOutcome& person : people.groups[group]) {
      ordered_json row = {group, person.cells};
      for (const std::string& name : names) {
        const auto found = values[place].find(name);
        row.push_back(found == values[place].end() ? ordered_json(nullptr)
                                                   : six_digits(found->second));
      }
      rows += (place == 0 ? "\n" : ",\n") + row.dump();
      ++place;
    }
  }
  std::string text = header_of(people).dump(2);
  // The final "\n}" is removed, because two more keys follow.
  text.resize(text.size() - 2);
  return text + ",\n  \"columns\": " + columns.dump() + ",\n  \"people\": [" + rows +
         "\n  ]\n}\n";
}

PredictivePeople predictive_people_from(const std::string& text, const std::string& place) {
  try {
    return people_of(ordered_json::parse(text));
  } catch (const std::exception& error) {
    throw core::Error(place + ": expected simulated people, found: " + error.what());
  }
}

}  // namespace jnd::analysis
