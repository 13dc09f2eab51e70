// Shows what happened in a session, and when: stages and pauses as bars, answers as points, and
// everything as a list.

#include <algorithm>
#include <string>
#include <vector>

#include "app/gui/plot.h"
#include "app/gui/views/layout.h"
#include "app/gui/views/record_parts.h"
#include "app/gui/views/run_parts.h"
#include "app/language/words.h"
#include "app/operator/study_words.h"

namespace jnd::app::gui {
namespace {

constexpr float kBar = 30;
constexpr double kSecondsPerMinute = 60.0;

/// The answers that `is_one` accepts, as points of one look.
PlotSeries answer_points(const SessionRecord& record, const char* name, Colour colour,
                         bool (*is_one)(const RecordAnswer&)) {
  PlotSeries series{
      .style = PlotSeries::Style::kPoints, .name = name, .colour = colour, .hollow = false};
  for (const RecordAnswer& answer : record.answers) {
    if (!answer.response_time_s || !is_one(answer)) continue;
    series.x.push_back(answer.at_s / kSecondsPerMinute);
    series.y.push_back(*answer.response_time_s);
    series.names.push_back(
        tr("{}, trial {}: {}", answer.block, answer.in_block, answer.answer));
    series.radii.push_back(3.0f);
  }
  return series;
}

PlotModel answers_over_time(const SessionRecord& record) {
  PlotModel plot{.title = tr("How long each answer took"),
                 .unit = as_is("s"),
                 .x = {.label = tr("time at the device"),
                       .unit = tr("min"),
                       .minimum = 0.0,
                       .maximum = std::max(1.0, record.duration_s) / kSecondsPerMinute},
                 .y = {.minimum = 0.0},
                 .series = {},
                 .boxes = {},
                 .marks = {}};
  plot.series.push_back(
      answer_points(record, tr("answers"), Colour::kBlue,
                    [](const RecordAnswer& one) { return !one.excluded && one.hint.empty(); }));
  plot.series.push_back(answer_points(
      record, tr("unlikely"), Colour::kAmber,
      [](const RecordAnswer& one) { return !one.excluded && !one.hint.empty(); }));
  plot.series.push_back(answer_points(record, tr("left out"), Colour::kSoft,
                                      [](const RecordAnswer& one) { return one.excluded; }));
  std::erase_if(plot.series, [](const PlotSeries& series) { return series.x.empty(); });
  for (const RecordFault& fault : record.faults) {
    plot.marks.push_back(
        {.at = fault.at_s / kSecondsPerMinute, .label = tr("fault"), .colour = Colour::kRed});
  }
  for (const RecordSpan& gap : record.interruptions) {
    plot.marks.push_back({.at = gap.begin_s / kSecondsPerMinute,
                          .label = tr("resumed"),
                          .colour = Colour::kSoft});
  }
  return plot;
}

void draw_span(Ui& ui, const Rect& bar, const RecordSpan& span, Colour ground, Colour ink) {
  ui.fill(bar, ground, 5);
  if (bar.width > 34) {
    ui.text(bar.inset(4), span.title, {.font = Font::kTiny, .colour = ink, .any_length = true});
  }
  if (ui.hovered(bar)) {
    ui.tooltip(ui.mouse_x(), ui.mouse_y(),
               tr("{}: {}, from {}", span.title, duration_words(span.end_s - span.begin_s),
                  clock_words(span.begin_s)));
  }
}

/// Draws each span as a bar, at its times on the axis of the plot below.
void draw_spans(Ui& ui, const Rect& strip, const PlotArea& area,
                const std::vector<RecordSpan>& spans, bool is_pause) {
  for (std::size_t i = 0; i < spans.size(); ++i) {
    const float begin = area.x(spans[i].begin_s / kSecondsPerMinute);
    const float end = area.x(spans[i].end_s / kSecondsPerMinute);
    // A span that ended at once can be seen, too.
    const Rect bar{begin, strip.y, std::max(2.0f, end - begin - 1), strip.height};
    if (is_pause) {
      draw_span(ui, bar, spans[i], Colour::kAmber, Colour::kOnFilled);
    } else {
      draw_span(ui, bar, spans[i], i % 2 == 0 ? Colour::kBlueSoft : Colour::kLine,
                Colour::kInk);
    }
  }
}

struct Moment {
  double at_s;
  std::string words;
  Colour colour;
};

std::vector<Moment> moments_of(const SessionRecord& record) {
  std::vector<Moment> moments;
  for (const RecordSpan& stage : record.stages) {
    moments.push_back({stage.begin_s,
                       tr("{}, {}", stage.title, duration_words(stage.end_s - stage.begin_s)),
                       Colour::kInk});
  }
  for (const RecordSpan& pause : record.pauses) {
    const std::string length = duration_words(pause.end_s - pause.begin_s);
    moments.push_back({pause.begin_s,
                       pause.title.empty() ? tr("Paused for {}", length)
                                           : tr("Paused for {}: {}", length, pause.title),
                       Colour::kAmber});
  }
  for (const RecordSpan& gap : record.interruptions) {
    moments.push_back({gap.begin_s, tr("Resumed, {}", gap.title), Colour::kAmber});
  }
  for (const RecordFault& fault : record.faults) {
    moments.push_back({fault.at_s, fault.words, Colour::kRed});
  }
  for (const RecordNote& note : record.notes) {
    if (note.kind == RecordNote::Kind::kNote && note.at_s >= 0.0) {
      moments.push_back({note.at_s, tr("Note: {}", note.text), Colour::kBlue});
    }
  }
  std::ranges::stable_sort(moments, {}, &Moment::at_s);
  return moments;
}

void draw_moments(Ui& ui, const Rect& place, const SessionRecord& record,
                  RecordViewState& state) {
  Rect inside = ui.begin_scroll("moments", place, state.timeline_height);
  const float top = inside.y;
  for (const Moment& moment : moments_of(record)) {
    const TextStyle style{.font = Font::kSmall, .colour = moment.colour, .wrap = true};
    constexpr float kClock = 64;
    const float height =
        std::max(22.0f, ui.text_height(inside.width - kClock, moment.words, style));
    Rect row = inside.take_top(height, 4);
    Rect clock = row.take_left(kClock);
    ui.text(clock.take_top(ui.line_height(Font::kMono)), clock_words(moment.at_s),
            {.font = Font::kMono, .colour = Colour::kSoft});
    ui.text(row, moment.words, style);
  }
  state.timeline_height = inside.y - top;
  ui.end_scroll();
}

}  // namespace

void draw_record_timeline(Ui& ui, const Rect& place, const SessionRecord& record,
                          RecordViewState& state) {
  Rect inside = draw_card(ui, place, tr("Timeline"));
  if (record.stages.empty()) {
    draw_notice(ui, inside,
                record.is_over ? tr("Nothing happened in this session.")
                               : tr("Nothing has happened in this session yet. Resume it to "
                                    "begin."));
    return;
  }
  Rect stages = inside.take_top(kBar, 4);
  Rect pauses = inside.take_top(record.pauses.empty() ? 0 : 20, 8);
  const float plot_height = std::clamp(inside.height * 0.5f, 130.0f, 300.0f);
  const PlotArea area =
      draw_plot(ui, inside.take_top(plot_height, 12), answers_over_time(record));
  draw_spans(ui, stages, area, record.stages, false);
  draw_spans(ui, pauses, area, record.pauses, true);
  ui.heading(inside.take_top(18, 6), tr("What happened"));
  draw_moments(ui, inside, record, state);
}

}  // namespace jnd::app::gui
