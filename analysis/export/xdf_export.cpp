#include "analysis/export/xdf_export.h"

#include <nlohmann/json.hpp>

#include <cstdio>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "analysis/export/exported_recording.h"
#include "analysis/export/session_clock.h"
#include "analysis/export/unfinished_folder.h"
#include "analysis/export/xdf_file.h"
#include "core/error.h"
#include "core/storage/stream_file.h"
#include "core/streams/sample_stream.h"
#include "core/streams/session_markers.h"

namespace jnd::analysis {
namespace {

namespace fs = std::filesystem;

std::string xdf_name(std::int64_t session) {
  char name[40];
  std::snprintf(name, sizeof name, "session_%04lld.xdf", static_cast<long long>(session));
  return name;
}

/// The study's name in its file, or the name of its folder if the file cannot be read.
std::string study_name(const core::StudyStore& store, const core::SessionRow& session) {
  const std::string text = store.protocol(session.protocol_sha256).text;
  const auto study = nlohmann::json::parse(text, nullptr, /*allow_exceptions=*/false,
                                           /*ignore_comments=*/true);
  if (study.is_object() && study.contains("name") && study.at("name").is_string()) {
    return study.at("name").get<std::string>();
  }
  return store.folder().stem().string();
}

/// By which event each file of a stream was begun.
std::map<std::string, core::EventRow> openings(const std::vector<core::EventRow>& events) {
  std::map<std::string, core::EventRow> found;
  for (const core::EventRow& event : events) {
    if (event.kind != "stream_opened") continue;
    const auto data = nlohmann::json::parse(event.data, nullptr, /*allow_exceptions=*/false);
    if (data.is_object() && data.contains("file") && data.at("file").is_string()) {
      found.emplace(data.at("file").get<std::string>(), event);
    }
  }
  return found;
}

class XdfSession {
 public:
  XdfSession(const core::StudyStore& store, const core::SessionRow& session,
             const ExportOptions& options, const fs::path& file)
      : store_(store),
        session_(session),
        options_(options),
        events_(store.events(session.session)),
        facts_{.study_id = store.study_id(),
               .study = study_name(store, session),
               .session = session.session,
               .program_version = session.program_version},
        clock_(events_, session.rate_hz),
        recording_(store, session, options),
        file_(file) {}

  void write(ExportOutcome& outcome) {
    learn_times();
    write_markers();
    if (recording_.any()) {
      write_samples();
      outcome.samples = true;
    }
    for (const fs::path& stream : core::stream_files(store_.recording_file(session_.session))) {
      try {
        write_stream(stream);
      } catch (const core::Error& error) {
        outcome.problems.push_back(std::string(error.what()) +
                                   "; the rest of it is not in the file");
      }
    }
    file_.finish();
    if (!recording_.problem().empty()) outcome.problems.push_back(recording_.problem());
  }

 private:
  static constexpr std::int64_t kLastTick = std::numeric_limits<std::int64_t>::max() / 2;

  void learn_times() {
    if (recording_.any()) {
      recording_.read(0, kLastTick,
                      [this](const core::Sample& sample) { clock_.take(sample); });
    }
    clock_.finish();
  }

  /// Adds the clock offsets of our own streams, which need no correction.
  static void add_no_offsets(XdfStream& stream, double first_s, double last_s) {
    stream.add(core::ClockOffset{.time_s = first_s});
    if (last_s > first_s) stream.add(core::ClockOffset{.time_s = last_s});
  }

  void write_markers() {
    const core::StreamInfo info = with_session(core::marker_stream_info(facts_));
    XdfStream stream(file_, ++num_streams_, info.format, xml_of(info));
    core::SessionMarkers markers;
    std::optional<double> first_s;
    double last_s = 0.0;
    for (const core::EventRow& event : events_) {
      std::optional<std::string> marker = markers.marker_of(event);
      if (!marker) continue;
      last_s = clock_.time_s(event);
      if (!first_s) first_s = last_s;
      stream.add(core::StreamSample{.time_s = last_s, .values = {}, .texts = {*marker}});
    }
    if (first_s) add_no_offsets(stream, *first_s, last_s);
    stream.finish();
  }

  void write_samples() {
    const core::SampleStream samples(options_.selection.channels);
    const core::StreamInfo info = with_session(samples.info(facts_, session_.rate_hz));
    XdfStream stream(file_, ++num_streams_, info.format, xml_of(info));
    std::optional<double> first_s;
    double last_s = 0.0;
    recording_.read(0, kLastTick, [&](const core::Sample& sample) {
      last_s = clock_.time_s(sample);
      if (!first_s) first_s = last_s;
      stream.add(samples.sample(sample, last_s));
    });
    if (first_s) add_no_offsets(stream, *first_s, last_s);
    stream.finish();
  }

  void write_stream(const fs::path& file) {
    const core::StreamFileReader reader(file);
    const auto opened = openings_.find(file.filename().string());
    const double shift_s = opened == openings_.end() ? 0.0 : clock_.shift_s(opened->second);
    XdfStream stream(file_, ++num_streams_, reader.info().format, reader.info().xml);
    try {
      reader.read([&stream](const core::StreamSample& sample) { stream.add(sample); });
      for (core::ClockOffset offset : reader.offsets()) {
        offset.offset_s += shift_s;
        stream.add(offset);
      }
    } catch (const core::Error&) {
      stream.finish();
      throw;
    }
    stream.finish();
  }

  core::StreamInfo with_session(core::StreamInfo info) const {
    info.uid = info.source_id;
    info.facts.emplace_back("participant", session_.participant);
    info.facts.emplace_back("simulated", session_.simulated ? "yes" : "no");
    return info;
  }

  static std::string xml_of(const core::StreamInfo& info) {
    return core::xml_text(core::stream_xml(info, /*with_description=*/true));
  }

  const core::StudyStore& store_;
  const core::SessionRow& session_;
  const ExportOptions& options_;
  std::vector<core::EventRow> events_;
  std::map<std::string, core::EventRow> openings_ = openings(events_);
  core::SessionStreamFacts facts_;
  SessionClock clock_;
  ExportedRecording recording_;
  XdfFile file_;
  std::uint32_t num_streams_ = 0;
};

}  // namespace

ExportOutcome export_xdf(const core::StudyStore& store, const fs::path& folder,
                         const ExportOptions& options) {
  ExportOutcome outcome;
  write_folder(folder, [&](const UnfinishedFolder& unfinished) {
    const std::vector<core::SessionRow> sessions = exported_sessions(store, options);
    std::size_t num_done = 0;
    for (const core::SessionRow& session : sessions) {
      if (options.keep_going) options.keep_going();
      core::tell(options.on_progress, num_done++, sessions.size());
      XdfSession(store, session, options, unfinished.path() / xdf_name(session.session))
          .write(outcome);
    }
  });
  return outcome;
}

}  // namespace jnd::analysis
