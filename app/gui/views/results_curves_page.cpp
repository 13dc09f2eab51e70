// Psychometric curves with what they come to, and magnitudes with their power laws.

#include <algorithm>
#include <cmath>

#include "analysis/fits/bounded_interval.h"
#include "app/gui/views/results_cards.h"
#include "app/gui/views/results_parts.h"
#include "app/gui/views/results_plots.h"

namespace jnd::app::gui {
namespace {

using namespace results;

std::string joined(const std::vector<std::string>& parts) {
  std::string all;
  for (const std::string& part : parts) {
    if (!part.empty()) all += (all.empty() ? "" : " · ") + part;
  }
  return all;
}

void draw_discrimination(Ui& ui, const Rect& place, const Discrimination& block,
                         const std::string& who) {
  ui.card(place);
  Rect inside = place.inset(kPadding);
  const PsychometricFigure* figure = figure_of(block, who);
  if (figure == nullptr) {
    return draw_notice(ui, inside, who + " has no answers in " + block.title + ".");
  }
  const std::string others = joined(figure->others);
  if (!figure->weber_fraction) {
    return draw_without_value(ui, inside, psychometric_plot(block, *figure),
                              "No Weber fraction: " + figure->reason + "." +
                                  (others.empty() ? "" : " Otherwise: " + others + "."));
  }
  for (const std::string& caution : figure->cautions) {
    const TextStyle amber{.font = Font::kSmall, .colour = Colour::kAmber, .wrap = true};
    ui.text(inside.take_bottom(ui.text_height(inside.width, caution, amber), 2), caution,
            amber);
  }
  const Rect value = inside.take_bottom(30, 4);
  (void)draw_plot(ui, inside, psychometric_plot(block, *figure));
  const std::string whose = who == kEveryone ? "median person" : "";
  draw_value(
      ui, value, "w = " + two_digits(*figure->weber_fraction),
      joined({interval_words(analysis::bounded_by_data(figure->ci95, figure->weber_fraction)),
              whose, others}));
}

/// A large number under its name, for the card below the curves.
struct KeyFigure {
  std::string name, value, detail;
};

const NumberLine* number_named(const ResultsModel& results, const std::string& name) {
  const auto found = std::find_if(results.numbers.begin(), results.numbers.end(),
                                  [&](const NumberLine& line) { return line.name == name; });
  return found == results.numbers.end() || found->value.empty() ? nullptr : &*found;
}

void add_number(const ResultsModel& results, const std::string& name, const std::string& title,
                std::vector<KeyFigure>& figures) {
  const NumberLine* line = number_named(results, name);
  if (line == nullptr) return;
  figures.push_back({title, line->value,
                     joined({line->interval,
                             line->published.empty() ? "" : "published " + line->published})});
}

std::vector<KeyFigure> key_figures(const ResultsModel& results) {
  std::vector<KeyFigure> figures;
  // What the study is about, where blocks are compared.
  if (!results.comparisons.empty() && results.comparisons.front().is_primary &&
      results.num_participants > 1) {
    const ComparisonLine& first = results.comparisons.front();
    // Who is left out of it stands on the page of tests.
    figures.push_back({first.name.substr(0, first.name.find(", without")),
                       first.estimate ? two_digits(*first.estimate) : "none", first.detail});
  }
  add_number(results, "trial_correlation_median", "Correlation of repetitions", figures);
  add_number(results, "max_speed_m_per_s", "Largest speed", figures);
  add_number(results, "stroke_width_m", "Stroke width", figures);
  return figures;
}

/// Key figures side by side and the chips below.
void draw_summary(Ui& ui, const Rect& place, const ResultsModel& results,
                  ResultsViewState& state) {
  Rect inside =
      draw_card(ui, place,
                std::to_string(results.num_participants) +
                    (results.num_participants == 1 ? " participant" : " participants"));
  inside = ui.begin_scroll("summary", inside, state.summary_height);
  const float top = inside.y;
  const std::vector<KeyFigure> figures = key_figures(results);
  const TextStyle soft{.font = Font::kSmall, .colour = Colour::kSoft, .wrap = true};
  if (!figures.empty()) {
    const auto count = static_cast<float>(figures.size());
    const float width = (inside.width - 24 * (count - 1)) / count;
    float height = 0;
    for (std::size_t i = 0; i < figures.size(); ++i) {
      Rect column{inside.x + static_cast<float>(i) * (width + 24), inside.y, width,
                  inside.height};
      const float name = ui.text_height(width, figures[i].name, soft);
      ui.text(column.take_top(name, 2), figures[i].name, soft);
      ui.text(column.take_top(32, 2), figures[i].value, {.font = Font::kAnswer});
      const float detail = ui.text_height(width, figures[i].detail, soft);
      ui.text(column.take_top(detail), figures[i].detail, soft);
      height = std::max(height, name + 36 + detail);
    }
    inside.take_top(height, 14);
  }
  inside.take_top(draw_quality(ui, inside, results));
  state.summary_height = inside.y - top;
  ui.end_scroll();
}

/// "0.66 I⁰·⁶⁶"
std::string law_words(double k, double a) {
  static const char* const kDigits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string words = two_digits(k) + " I";
  for (const char letter : two_digits(a)) {
    if (letter >= '0' && letter <= '9') words += kDigits[letter - '0'];
    if (letter == '.') words += "·";
    if (letter == '-') words += "⁻";
  }
  return words;
}

/// As high as what is in it, while the figures keep enough.
float summary_height(const Rect& place, float figures, const ResultsViewState& state) {
  const float wanted = state.summary_height + 28 + 2 * kPadding;
  return std::clamp(wanted, 120.0f, std::max(120.0f, place.height - figures - kGap));
}

struct Law {
  const char* name;
  Colour colour;
  const std::optional<PowerCurve>* curve;
};

/// "95 % k 0.54 to 0.77, a 0.59 to 0.73"
std::string law_interval(const PowerCurve& curve) {
  if (!curve.k_ci95.low || !curve.k_ci95.high || !curve.a_ci95.low || !curve.a_ci95.high) {
    return "";
  }
  return "95 % k " + two_digits(*curve.k_ci95.low) + " to " + two_digits(*curve.k_ci95.high) +
         ", a " + two_digits(*curve.a_ci95.low) + " to " + two_digits(*curve.a_ci95.high);
}

std::string law_published(const PowerCurve& curve) {
  if (!curve.published_k || !curve.published_a) return "";
  return "published " + law_words(*curve.published_k, *curve.published_a);
}

void draw_law(Ui& ui, Rect line, const Law& law) {
  const PowerCurve& curve = **law.curve;
  ui.dot(line.x + 6, line.y + line.height / 2, 5, law.colour);
  line.take_left(22);
  ui.text(line.take_left(100, 8), law.name, {});
  if (!curve.k || !curve.a) {
    ui.text(line, "no power law: " + curve.reason, {.colour = Colour::kAmber});
    return;
  }
  ui.text(line.take_left(110, 10), law_words(*curve.k, *curve.a), {.font = Font::kStrong});
  ui.text(line, joined({law_interval(curve), law_published(curve)}),
          {.font = Font::kSmall, .colour = Colour::kSoft});
}

void draw_magnitude(Ui& ui, const Rect& place, const Magnitude& magnitude,
                    const std::string& who) {
  ui.card(place);
  Rect inside = place.inset(kPadding);
  const MagnitudeFigure* figure = figure_of(magnitude, who);
  if (figure == nullptr) {
    return draw_notice(ui, inside, who + " has no answers in " + magnitude.title + ".");
  }
  const Law laws[] = {{"estimation", Colour::kBlue, &figure->estimation_curve},
                      {"production", Colour::kAmber, &figure->production_curve},
                      {"combined", Colour::kInk, &figure->combined_curve}};
  for (auto law = std::rbegin(laws); law != std::rend(laws); ++law) {
    if (law->curve->has_value()) draw_law(ui, inside.take_bottom(28), *law);
  }
  inside.take_bottom(8);
  (void)draw_plot(ui, inside, magnitude_plot(magnitude, *figure));
}

}  // namespace

std::string two_digits(double value) {
  return std::isfinite(value) ? table_number(value) : "none";
}

std::string interval_words(const analysis::Interval& ci95) {
  if (!ci95.low && !ci95.high) return "";
  if (!ci95.low) return "95 % below " + two_digits(*ci95.high);
  if (!ci95.high) return "95 % above " + two_digits(*ci95.low);
  return "95 % " + two_digits(*ci95.low) + " to " + two_digits(*ci95.high);
}

void draw_curves_page(Ui& ui, Rect place, const ResultsModel& results,
                      ResultsViewState& state) {
  draw_summary(ui, place.take_bottom(summary_height(place, 280, state), kGap), results, state);
  const std::string who = shown_participant(results, state);
  draw_grid(ui, "figures", place, results.discriminations, 340, 270,
            [&](const Rect& card, const Discrimination& block) {
              draw_discrimination(ui, card, block, who);
            });
}

void draw_magnitudes_page(Ui& ui, Rect place, const ResultsModel& results,
                          ResultsViewState& state) {
  const bool has_chips_elsewhere = !results.discriminations.empty();
  if (!has_chips_elsewhere) {
    draw_summary(ui, place.take_bottom(summary_height(place, 410, state), kGap), results,
                 state);
  }
  const std::string who = shown_participant(results, state);
  draw_grid(ui, "figures", place, results.magnitudes, 480, 330,
            [&](const Rect& card, const Magnitude& magnitude) {
              draw_magnitude(ui, card, magnitude, who);
            });
}

}  // namespace jnd::app::gui
