#include "app/operator/column_guess.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string_view>

#include "analysis/data/answer_cells.h"
#include "analysis/data/answer_file.h"

namespace jnd::app {
namespace {

using Words = std::initializer_list<std::string_view>;

std::string lower(std::string_view text) {
  std::string small(text);
  std::ranges::transform(small, small.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return small;
}

/// How well a name fits: 2 if it is one of the words of `whole`, 1 if it contains one of
/// `within`, otherwise 0.
int likeness(const std::string& name, const Words& whole, const Words& within) {
  const std::string small = lower(name);
  if (std::ranges::find(whole, small) != whole.end()) return 2;
  return std::ranges::any_of(
             within,
             [&](std::string_view word) { return small.find(word) != std::string::npos; })
             ? 1
             : 0;
}

int like_intensity(const std::string& name) {
  return likeness(name,
                  {"intensity", "level", "stimulus", "stim", "x", "soa", "delay", "contrast",
                   "coherence", "offset", "magnitude", "strength", "comparison", "test",
                   "difference", "delta", "distance", "value"},
                  {"intens",    "level",    "stim",      "soa",      "delay",  "contrast",
                   "coheren",   "offset",   "magnitude", "strength", "compar", "differ",
                   "delta",     "_ms",      "_mm",       "_hz",      "_deg",   "viscosity",
                   "stiffness", "duration", "freq",      "angle",    "speed"});
}

int like_answer(const std::string& name) {
  return likeness(name,
                  {"yes",      "num_yes",   "n_yes",    "response", "resp", "answer", "correct",
                   "corr",     "acc",       "accuracy", "said_yes", "hit",  "hits",   "choice",
                   "judgment", "judgement", "right",    "k",        "r",    "y"},
                  {"yes", "resp", "answer", "correct", "corr", "choice", "chose", "judg",
                   "longer", "more", "num_", "n_", "first"});
}

int like_trials(const std::string& name) {
  return likeness(
      name,
      {"num_trials", "n_trials", "ntrials", "trials", "n", "total", "num_asked", "count", "m"},
      {"trial", "asked", "total", "num_of", "n_obs"});
}

/// True for columns that count or time rows and say nothing about a stimulus.
bool is_bookkeeping(const std::string& name) {
  return likeness(name,
                  {"trial",      "trial_index", "index",  "row",   "rt",      "time", "date",
                   "age",        "seed",        "id",     "block", "session", "run",  "order",
                   "repetition", "frame",       "gender", "sex",   "url",     ""},
                  {"thisn", "thisrep", "thistrial", "thisindex", "_rt", ".rt", "elapsed",
                   "time_", "_id", "date", "framerate", "index", "version", "expname"}) > 0 ||
         analysis::tells_rows_apart(name);
}

/// Guesses from the rows of the preview, by columns and as numbers.
class Guesser {
 public:
  explicit Guesser(const DataPreview& preview) : preview_(preview) {}

  [[nodiscard]] CurveRequest guess() {
    CurveRequest request;
    request.csv = preview_.file.string();
    request.intensity.clear();
    guess_answers(request);
    guess_intensity(request);
    guess_groups(request);
    return request;
  }

 private:
  [[nodiscard]] std::size_t size() const { return preview_.columns.size(); }
  [[nodiscard]] const PreviewColumn& column(std::size_t place) const {
    return preview_.columns[place];
  }
  [[nodiscard]] double number(std::size_t row, std::size_t place) const {
    return analysis::number_of(preview_.rows[row][place], preview_.decimal_comma);
  }
  [[nodiscard]] bool is_used(std::size_t place) const { return used_.contains(place); }

  /// True if a column has two answers that the reader does not know, such as "left" and
  /// "right", or 1 and 2.
  [[nodiscard]] static bool has_two_cells(const PreviewColumn& one) {
    return !one.is_yes_or_no && !one.has_more_cells && one.cells.size() == 2;
  }

  /// True if the columns can be numbers of yes answers and of trials: the first is never more
  /// than the second, and sometimes less.
  [[nodiscard]] bool are_counts(std::size_t yes, std::size_t trials) const {
    if (!column(yes).is_whole || !column(trials).is_whole) return false;
    bool is_fewer = false, is_several = false;
    for (std::size_t row = 0; row < preview_.rows.size(); ++row) {
      const double part = number(row, yes), whole = number(row, trials);
      if (std::isnan(part) || std::isnan(whole)) continue;
      if (part > whole) return false;
      is_fewer = is_fewer || part < whole;
      is_several = is_several || whole > 1.0;
    }
    return is_fewer && is_several;
  }

  void guess_answers(CurveRequest& request) {
    int best = 0;
    std::optional<std::size_t> yes, trials;
    for (std::size_t i = 0; i < size(); ++i) {
      const PreviewColumn& one = column(i);
      const int likely = like_answer(one.name);
      if (one.is_yes_or_no && one.cells.size() >= 2) {
        const int score = 4 + 4 * likely - (is_bookkeeping(one.name) ? 6 : 0);
        if (score > best) best = score, yes = i, trials.reset();
      } else if (has_two_cells(one) && likely > 0) {
        if (3 + 2 * likely > best) best = 3 + 2 * likely, yes = i, trials.reset();
      }
    }
    for (std::size_t of = 0; of < size(); ++of) {
      for (std::size_t part = 0; part < size(); ++part) {
        if (part == of || is_bookkeeping(column(part).name) ||
            (is_bookkeeping(column(of).name) && like_trials(column(of).name) < 2) ||
            (column(part).is_yes_or_no && like_trials(column(of).name) == 0) ||
            !are_counts(part, of)) {
          continue;
        }
        const int score = 2 + 4 * like_trials(column(of).name) +
                          3 * like_answer(column(part).name) -
                          3 * like_intensity(column(part).name) -
                          3 * like_intensity(column(of).name) + (part + 1 == of ? 1 : 0) +
                          (column(of).cells.size() == 1   ? 3
                           : column(of).cells.size() <= 3 ? 2
                                                          : 0);
        if (score > best) best = score, yes = part, trials = of;
      }
    }
    if (!yes) return;
    request.yes = column(*yes).name;
    used_.insert(*yes);
    if (trials) {
      request.trials = column(*trials).name;
      used_.insert(*trials);
    } else {
      request.yes_value = guessed_yes_value(column(*yes));
    }
  }

  void guess_intensity(CurveRequest& request) {
    constexpr int kLeast = -2;
    int best = kLeast;
    std::optional<std::size_t> found;
    for (std::size_t i = 0; i < size(); ++i) {
      const PreviewColumn& one = column(i);
      if (is_used(i) || !one.is_numeric || one.cells.size() < 2) continue;
      const bool has_levels = !one.has_more_cells && one.cells.size() >= 3;
      const int score = 4 * like_intensity(one.name) + (has_levels ? 2 : 0) -
                        (one.is_yes_or_no ? 3 : 0) - (is_bookkeeping(one.name) ? 8 : 0);
      if (score > best) best = score, found = i;
    }
    if (!found) return;
    request.intensity = column(*found).name;
    used_.insert(*found);
  }

  /// The intensities of each cell of a column, in rows that have an answer.
  [[nodiscard]] std::map<std::string, std::set<std::string>> intensities_by_cell(
      const CurveRequest& request, std::size_t place) const {
    const std::size_t yes = preview_.place_of(request.yes);
    const std::size_t intensity = preview_.place_of(request.intensity);
    std::map<std::string, std::set<std::string>> cells;
    for (const std::vector<std::string>& row : preview_.rows) {
      if (analysis::is_missing(row[yes]) || analysis::is_missing(row[intensity])) continue;
      cells[row[place]].insert(row[intensity]);
    }
    return cells;
  }

  void guess_groups(CurveRequest& request) {
    if (request.yes.empty() || request.intensity.empty()) return;
    constexpr std::size_t kMostCurves = 48, kMostOfWords = 8;
    std::size_t num_curves = 1;
    const auto add = [&](std::size_t place, std::size_t most) {
      const auto cells = intensities_by_cell(request, place);
      // A cell that has one intensity only is just another name of that intensity.
      const bool have_curves = std::ranges::all_of(cells, [](const auto& cell) {
        return !cell.first.empty() && cell.second.size() > 1;
      });
      if (cells.size() < 2 || cells.size() > most || !have_curves ||
          num_curves * cells.size() > kMostCurves ||
          column(place).name.find(',') != std::string::npos) {
        return false;
      }
      num_curves *= cells.size();
      used_.insert(place);
      request.group_by.push_back(column(place).name);
      return true;
    };
    const auto is_condition = [](const std::string& name) {
      return likeness(name, {"condition", "cond", "group", "treatment"}, {"condition"}) > 0;
    };
    // Columns of conditions come first, then columns that say whose answers they are.
    for (std::size_t i = 0; i < size(); ++i) {
      if (!is_used(i) && is_condition(column(i).name)) add(i, kMostCurves);
    }
    for (std::size_t i = 0; i < size(); ++i) {
      if (!is_used(i) && analysis::tells_rows_apart(column(i).name)) add(i, kMostCurves);
    }
    if (!request.group_by.empty()) return;
    for (std::size_t i = 0; i < size(); ++i) {
      const PreviewColumn& one = column(i);
      const bool is_free = !is_used(i) && !one.is_numeric && !is_bookkeeping(one.name);
      if (is_free && like_answer(one.name) == 0 && add(i, kMostOfWords)) return;
    }
  }

  const DataPreview& preview_;
  std::set<std::size_t> used_;
};

}  // namespace

std::string guessed_yes_value(const PreviewColumn& column) {
  if (column.is_yes_or_no || column.cells.empty()) return "";
  static constexpr std::array<std::string_view, 15> kYes = {
      "y",      "yes",    "right",  "correct", "more",    "longer",   "larger", "greater",
      "second", "higher", "louder", "heavier", "thicker", "stronger", "test"};
  for (const std::string_view word : kYes) {
    for (const std::string& cell : column.cells) {
      if (lower(cell) == word) return cell;
    }
  }
  return column.cells.size() == 2 ? std::ranges::max(column.cells) : "";
}

CurveRequest guessed_request(const DataPreview& preview) { return Guesser(preview).guess(); }

}  // namespace jnd::app
