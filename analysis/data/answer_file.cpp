#include "analysis/data/answer_file.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <set>
#include <unordered_map>

#include "analysis/data/answer_rows.h"

namespace jnd::analysis {
namespace {

constexpr std::size_t kMostPooled = 1000;

/// Answers by intensity, with a hash table of their indices.
class Tallies {
 public:
  void add(double intensity, std::int64_t num_yes, std::int64_t num_trials) {
    if (intensity == 0.0) intensity = 0.0;  // Turns -0 into 0.
    if (2 * (tallies_.size() + 1) > places_.size()) grow();
    std::uint32_t& place = places_[slot_of(intensity)];
    if (place == kNone) {
      place = static_cast<std::uint32_t>(tallies_.size());
      tallies_.push_back({intensity, 0, 0});
    }
    tallies_[place].num_yes += num_yes;
    tallies_[place].num_trials += num_trials;
  }
  [[nodiscard]] std::vector<AnswerTally> take() {
    places_ = {};
    return std::move(tallies_);
  }

 private:
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;

  [[nodiscard]] std::size_t slot_of(double intensity) const {
    auto bits = std::bit_cast<std::uint64_t>(intensity);
    bits = (bits ^ (bits >> 31)) * 0x9E3779B97F4A7C15ULL;
    std::size_t slot = (bits ^ (bits >> 29)) & (places_.size() - 1);
    while (places_[slot] != kNone && tallies_[places_[slot]].intensity != intensity) {
      slot = (slot + 1) & (places_.size() - 1);
    }
    return slot;
  }
  void grow() {
    places_.assign(std::max<std::size_t>(64, 2 * places_.size()), kNone);
    for (std::size_t i = 0; i < tallies_.size(); ++i) {
      places_[slot_of(tallies_[i].intensity)] = static_cast<std::uint32_t>(i);
    }
  }

  std::vector<AnswerTally> tallies_;
  std::vector<std::uint32_t> places_;
};

/// Takes rows of cells in any format.
class AnswerCollector final : public RowSink {
 public:
  AnswerCollector(std::string name, const AnswerColumns& columns)
      : RowSink(std::move(name)),
        columns_(columns),
        words_{columns.yes, columns.yes_value, columns.trials} {}

  void set_header(std::vector<std::string> header, int line) override {
    file_.columns = std::move(header);
    intensity_ = problems().place_of(columns_.intensity, file_.columns, line);
    yes_ = problems().place_of(columns_.yes, file_.columns, line);
    if (columns_.trials) trials_ = problems().place_of(*columns_.trials, file_.columns, line);
    for (const std::string& name : columns_.group_by) {
      group_by_.push_back(problems().place_of(name, file_.columns, line));
    }
    for (const auto& [name, cell] : columns_.where)
      where_.push_back(problems().place_of(name, file_.columns, line));
    problems().throw_problems();
    find_response_of_jspsych();
    elsewhere_.resize(where_.size());
    for (std::size_t i = 0; i < file_.columns.size(); ++i) {
      const auto is_at = [i](std::size_t place) { return place == i; };
      if (tells_rows_apart(file_.columns[i]) && std::ranges::none_of(group_by_, is_at) &&
          std::ranges::none_of(where_, is_at)) {
        pooled_.push_back(i);
      }
    }
    pooled_cells_.resize(pooled_.size());
  }
  void add_row(const std::vector<std::string_view>& cells, int line,
               bool decimal_comma) override {
    ++file_.num_rows;
    const auto cell = [&](std::size_t place) {
      return place < cells.size() ? cells[place] : std::string_view();
    };
    for (std::size_t i = 0; i < where_.size(); ++i) {
      if (!is_same_cell(cell(where_[i]), columns_.where[i].second, decimal_comma)) {
        ++file_.num_elsewhere;
        constexpr std::size_t kMostCells = 8;
        std::set<std::string>& others = elsewhere_[i];
        if (others.size() < kMostCells) others.emplace(cell(where_[i]));
        return;
      }
    }
    if (skips(cell(intensity_), columns_.intensity) || skips(cell(yes_), columns_.yes)) return;
    if (trials_ && skips(cell(*trials_), *columns_.trials)) return;
    for (std::size_t i = 0; i < group_by_.size(); ++i) {
      if (skips_name(cell(group_by_[i]), columns_.group_by[i])) return;
    }
    const double intensity = number_of(cell(intensity_), decimal_comma);
    if (std::isnan(intensity)) {
      problems().report(line, columns_.intensity, "a number", cell(intensity_));
      return;
    }
    if (intensity < 0.0 && !columns_.signed_intensities) {
      problems().report(line, columns_.intensity, "a number >= 0 on a logarithmic axis",
                        cell(intensity_));
      return;
    }
    const std::optional<CountedAnswers> counted =
        counted_answers(words_, cell(yes_), trials_ ? cell(*trials_) : std::string_view(),
                        decimal_comma, line, problems());
    if (!counted) return;
    if (columns_.yes_value && counted->num_yes == 0) {
      constexpr std::size_t kMostWords = 20;
      const auto [word, is_new] = file_.num_no.try_emplace(std::string(cell(yes_)), 0);
      if (is_new && file_.num_no.size() > kMostWords) {
        file_.num_no.erase(word);
      } else {
        word->second += counted->num_trials;
      }
    }
    for (std::size_t i = 0; i < pooled_.size(); ++i) {
      if (pooled_cells_[i].size() < kMostPooled) pooled_cells_[i].emplace(cell(pooled_[i]));
    }
    const std::size_t group = group_of(cells);
    if (response_ && is_missing(cell(*response_))) {
      unanswered_.push_back({group, intensity, counted->num_yes, counted->num_trials});
    } else {
      tallies_[group].add(intensity, counted->num_yes, counted->num_trials);
    }
  }

  [[nodiscard]] AnswerFile finish() {
    problems().throw_problems();
    take_unanswered();
    require_some_rows();
    if (columns_.group_by.empty() && tallies_.empty()) tallies_.emplace_back();
    if (columns_.group_by.empty() && file_.groups.empty()) file_.groups.emplace_back();
    for (std::size_t i = 0; i < tallies_.size(); ++i) {
      file_.groups[i].tallies = tallies_[i].take();
    }
    for (std::size_t i = 0; i < pooled_.size(); ++i) {
      if (pooled_cells_[i].size() > 1) {
        file_.num_pooled[file_.columns[pooled_[i]]] = pooled_cells_[i].size();
      }
    }
    return std::move(file_);
  }

 private:
  /// jsPsych writes `"response": null` for a trial that was not answered in time, and most
  /// experiments then store `correct` as false. Such a trial is missing and no wrong answer.
  void find_response_of_jspsych() {
    const auto place_of = [this](std::string_view name) -> std::optional<std::size_t> {
      const auto found = std::ranges::find(file_.columns, name);
      if (found == file_.columns.end()) return std::nullopt;
      return static_cast<std::size_t>(found - file_.columns.begin());
    };
    if (!place_of("trial_type") || !place_of("trial_index") || !place_of("rt")) return;
    response_ = place_of("response");
    if (response_ == yes_) response_.reset();
  }

  /// A cell that no row has is a slip: another case of letters, or another language.
  void require_some_rows() {
    if (file_.num_rows == 0 || file_.num_elsewhere < file_.num_rows) return;
    for (std::size_t i = 0; i < where_.size(); ++i) {
      if (elsewhere_[i].empty()) continue;
      std::string found;
      for (const std::string& cell : elsewhere_[i]) {
        found += (found.empty() ? "" : ", ") + shown_cell(cell);
      }
      throw core::Error(problems().name() + ": " + columns_.where[i].first +
                        ": expected rows with " + shown_cell(columns_.where[i].second) +
                        ", which --where asks for, found none; there are " + found);
    }
  }
  bool skips(std::string_view cell, const std::string& column) {
    if (is_missing(cell)) ++file_.num_missing[column];
    return is_missing(cell);
  }
  bool skips_name(std::string_view cell, const std::string& column) {
    if (is_missing_name(cell)) ++file_.num_missing[column];
    return is_missing_name(cell);
  }

  /// Where some trials without a response are a yes, no response is an answer, as in tasks of
  /// go and no-go, and all of them count. Otherwise the trials were missed.
  void take_unanswered() {
    const bool is_answer =
        std::ranges::any_of(unanswered_, [](const Unanswered& one) { return one.num_yes > 0; });
    if (!is_answer && !unanswered_.empty()) {
      file_.num_missing[file_.columns[*response_]] +=
          static_cast<std::int64_t>(unanswered_.size());
      return;
    }
    for (const Unanswered& one : unanswered_) {
      tallies_[one.group].add(one.intensity, one.num_yes, one.num_trials);
    }
  }

  /// The place of a row's group.
  std::size_t group_of(const std::vector<std::string_view>& cells) {
    if (group_by_.empty()) {
      if (tallies_.empty()) {
        tallies_.emplace_back();
        file_.groups.emplace_back();
      }
      return 0;
    }
    key_.clear();
    for (const std::size_t place : group_by_) {
      if (place < cells.size()) key_ += cells[place];
      key_ += '\x1F';
    }
    const auto [found, is_new] = group_places_.try_emplace(key_, tallies_.size());
    if (is_new) {
      tallies_.emplace_back();
      AnswerGroup group;
      for (std::size_t i = 0; i < group_by_.size(); ++i) {
        group.key.emplace_back(columns_.group_by[i],
                               group_by_[i] < cells.size() ? cells[group_by_[i]] : "");
      }
      file_.groups.push_back(std::move(group));
    }
    return found->second;
  }

  const AnswerColumns& columns_;
  AnswerWords words_;
  AnswerFile file_;
  std::size_t intensity_ = 0, yes_ = 0;
  std::optional<std::size_t> trials_;
  std::optional<std::size_t> response_;  ///< Of jsPsych, if another column says what is a yes.
  /// A row of jsPsych without a response.
  struct Unanswered {
    std::size_t group = 0;
    double intensity = 0.0;
    std::int64_t num_yes = 0, num_trials = 0;
  };
  std::vector<Unanswered> unanswered_;
  std::vector<std::size_t> group_by_, where_, pooled_;
  std::vector<std::set<std::string>> pooled_cells_;
  /// The other cells found for each entry of `where_`.
  std::vector<std::set<std::string>> elsewhere_;
  std::vector<Tallies> tallies_;
  std::unordered_map<std::string, std::size_t> group_places_;
  std::string key_;
};

}  // namespace

bool tells_rows_apart(std::string_view column) noexcept {
  static constexpr std::array<std::string_view, 9> kTellingApart = {
      "participant", "participant_id", "subject",  "Subject", "subj", "observer",
      "obs",         "condition",      "Condition"};
  return std::ranges::find(kTellingApart, column) != kTellingApart.end();
}

AnswerFile parse_answers(std::string_view text, const std::string& name,
                         const AnswerColumns& columns) {
  AnswerCollector collector(name, columns);
  parse_rows(text, collector);
  return collector.finish();
}

AnswerFile read_answer_file(const std::filesystem::path& file, const AnswerColumns& columns) {
  AnswerCollector collector(file.string(), columns);
  read_rows(file, collector);
  return collector.finish();
}

}  // namespace jnd::analysis
