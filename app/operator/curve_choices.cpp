#include "app/operator/curve_choices.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include "analysis/data/answer_cells.h"
#include "analysis/fits/curve_model.h"
#include "app/command_line/rate_text.h"
#include "app/language/words.h"

namespace jnd::app {
namespace {

CurveChoice task_choice(const char* label, const std::string& task) {
  return {
      .label = label,
      .note = {},
      .is_chosen =
          [task](const CurveRequest& request) {
            // If nobody named a task, it is yes-no.
            return request.guess.empty() &&
                   (request.task == task || (request.task.empty() && task == "yes-no"));
          },
      .choose = [task](CurveRequest request) { return with_task(std::move(request), task); }};
}

CurveChoice lapse_choice(const char* label, const std::string& lapse) {
  return {.label = label,
          .note = {},
          .is_chosen = [lapse](const CurveRequest& request) { return request.lapse == lapse; },
          .choose =
              [lapse](CurveRequest request) {
                request.lapse = lapse;
                return request;
              }};
}

/// The numbers of redraws that the window offers for the bootstrap and the goodness of fit.
constexpr int kNumRedraws = 1000, kManyRedraws = 10'000;

CurveChoice interval_choice(const char* label, std::string note, int num_bootstrap,
                            const std::string& kind, bool posterior) {
  return {.label = label,
          .note = std::move(note),
          .is_chosen =
              [num_bootstrap, kind, posterior](const CurveRequest& now) {
                const bool is_drawn = now.num_bootstrap > 0;
                return is_drawn == (num_bootstrap > 0) && now.posterior == posterior &&
                       (!is_drawn || now.bootstrap_kind == kind);
              },
          .choose =
              [num_bootstrap, kind, posterior](CurveRequest now) {
                now.num_bootstrap = num_bootstrap;
                now.bootstrap_kind = kind;
                now.posterior = posterior;
                return now;
              }};
}

CurveChoice goodness_choice(std::string label, int num_redraws) {
  return {.label = std::move(label),
          .note = {},
          .is_chosen = [num_redraws](
                           const CurveRequest& now) { return now.num_goodness == num_redraws; },
          .choose =
              [num_redraws](CurveRequest now) {
                now.num_goodness = num_redraws;
                return now;
              }};
}

std::string rate_problem(const std::string& typed) {
  return tr("expected a rate from 0 to below 1, such as 0.5 or 1/3, found {}", typed);
}

}  // namespace

std::vector<CurveChoice> family_choices(const CurveRequest& request) {
  std::vector<CurveChoice> all;
  for (const analysis::CurveFamilyTraits& one : analysis::curve_families()) {
    const std::string name(one.name);
    all.push_back({.label = name,
                   .note = analysis::formula_words(one.family, request.axis == "log"),
                   .is_chosen = [name](const CurveRequest& now) { return now.family == name; },
                   .choose =
                       [name](CurveRequest now) {
                         now.family = name;
                         return now;
                       }});
  }
  return all;
}

std::vector<CurveChoice> task_choices() {
  std::vector<CurveChoice> all = {task_choice(tr("Answers of yes and no"), "yes-no"),
                                  task_choice(tr("Right answers among 2"), "mafc:2"),
                                  task_choice(tr("Right answers among 3"), "mafc:3"),
                                  task_choice(tr("Right answers among 4"), "mafc:4")};
  all.push_back({.label = tr("A guess rate that is fitted"),
                 .note = {},
                 .is_chosen = [](const CurveRequest& now) { return now.guess == "free"; },
                 .choose =
                     [](CurveRequest now) {
                       now.task.clear();
                       now.guess = "free";
                       return now;
                     }});
  return all;
}

std::vector<CurveChoice> lapse_choices() {
  return {lapse_choice("0", "0"), lapse_choice("0.01", "0.01"), lapse_choice("0.02", "0.02"),
          lapse_choice("0.05", "0.05"), lapse_choice(tr("A rate that is fitted"), "free")};
}

std::vector<CurveChoice> interval_choices() {
  const std::string plain = CurveRequest{}.bootstrap_kind;
  const std::string refits = trn("{} refit", "{} refits", std::int64_t{kNumRedraws});
  return {
      interval_choice(tr("Likelihood ratio"), tr("no redraws, no priors"), 0, plain, false),
      interval_choice(tr("Bootstrap from the curve"), refits, kNumRedraws, "parametric", false),
      interval_choice(tr("Bootstrap from the answers"), refits, kNumRedraws, "nonparametric",
                      false),
      interval_choice(tr("Posterior"), tr("with priors, which are told"), 0, plain, true)};
}

std::vector<CurveChoice> goodness_choices() {
  return {
      goodness_choice(tr("Not tested"), 0),
      goodness_choice(trn("{} redraw", "{} redraws", std::int64_t{kNumRedraws}), kNumRedraws),
      goodness_choice(trn("{} redraw", "{} redraws", std::int64_t{kManyRedraws}),
                      kManyRedraws)};
}

std::string chosen_label(const std::vector<CurveChoice>& choices, const CurveRequest& request) {
  const auto chosen = std::ranges::find_if(
      choices, [&request](const CurveChoice& one) { return one.is_chosen(request); });
  return chosen == choices.end() ? "" : chosen->label;
}

CurveRequest with_task(CurveRequest request, const std::string& task) {
  request.task = task;
  request.guess.clear();
  return request;
}

TypedRequest with_typed_guess(const CurveRequest& request, const std::string& typed) {
  const std::optional<double> rate =
      rate_of(analysis::without_spaces(with_decimal_points(typed)));
  if (!rate) return {request, rate_problem(typed)};
  TypedRequest done{request, ""};
  done.request.task.clear();
  done.request.guess = fmt::format("{}", *rate);
  return done;
}

TypedRequest with_typed_lapse(const CurveRequest& request, const std::string& typed) {
  const std::optional<double> rate =
      rate_of(analysis::without_spaces(with_decimal_points(typed)));
  if (!rate) return {request, rate_problem(typed)};
  TypedRequest done{request, ""};
  done.request.lapse = fmt::format("{}", *rate);
  return done;
}

TypedRequest with_typed_levels(const CurveRequest& request, const std::string& typed) {
  TypedRequest done{request, ""};
  done.request.at.clear();
  std::string words = with_decimal_points(typed);
  std::ranges::replace_if(
      words, [](char c) { return c == ',' || c == ';'; }, ' ');
  std::string_view rest = words;
  while (!(rest = analysis::without_spaces(rest)).empty()) {
    const std::string_view word = rest.substr(0, rest.find(' '));
    const double level = analysis::number_of(word, false);
    if (!(level > 0.0 && level < 1.0)) {
      return {request, tr("expected numbers between 0 and 1, such as 0.75, found {}",
                          std::string(word))};
    }
    if (std::ranges::find(done.request.at, level) == done.request.at.end()) {
      done.request.at.push_back(level);
    }
    rest.remove_prefix(word.size());
  }
  if (done.request.at.empty()) {
    return {request, tr("expected numbers between 0 and 1, such as 0.75, found nothing")};
  }
  return done;
}

}  // namespace jnd::app
