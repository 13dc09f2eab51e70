#include "app/session/session_pulses.h"

#include <utility>

#include "core/markers/marker_kind.h"

namespace jnd::app {
namespace {

/// The end of a session may have to wait so long for its last pulses.
constexpr double kPatienceWithPulses_s = 0.5;

}  // namespace

SessionPulses::SessionPulses(const Parameters& parameters)
    : parameters_(parameters),
      writer_([open = parameters.open, wanted = parameters.wanted] { return open(wanted); },
              parameters.wanted.width_s) {}

void SessionPulses::send(std::int64_t event, core::MarkerKind kind) {
  if (const int code = parameters_.codes.of(kind); code != 0) writer_.send(event, code);
}

void SessionPulses::tell(const core::EventRow& event) {
  if (is_closed_) return;
  if (const auto kind = core::marker_kind_of(event)) send(event.sequence, *kind);
}

void SessionPulses::follow(experiments::Session& session) {
  core::PulseWriter::News news = writer_.take_news();
  const WantedMarkers& wanted = parameters_.wanted;
  if (news.is_opened) {
    experiments::MarkersOpened opened{
        .port = wanted.port, .way = core::way_of(wanted), .width_s = wanted.width_s};
    for (std::size_t kind = 0; kind < core::kNumMarkerKinds; ++kind) {
      opened.codes[std::string(core::kMarkerNames[kind])] = parameters_.codes.codes[kind];
    }
    session.markers_opened(opened);
  }
  if (!news.pulses.empty()) session.markers_sent({.pulses = std::move(news.pulses)});
  if (news.problem.empty()) return;
  problem_ = std::move(news.problem);
  session.markers_failed({.port = wanted.port, .problem = problem_});
}

void SessionPulses::close(experiments::Session& session) {
  if (std::exchange(is_closed_, true)) return;
  send(/*event=*/0, core::MarkerKind::kEnd);
  writer_.wait_until_sent(kPatienceWithPulses_s);
  follow(session);
  session.markers_closed({.port = parameters_.wanted.port,
                          .num_sent = writer_.num_sent(),
                          .num_dropped = writer_.num_dropped()});
}

}  // namespace jnd::app
