#include "app/commissioning/commissioning_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <map>
#include <set>

#include "analysis/commissioning/single_mass.h"
#include "analysis/report/commissioning_figures.h"
#include "analysis/report/html_text.h"
#include "app/commissioning/commissioned_profile.h"
#include "app/commissioning/measured_quantities.h"
#include "app/commissioning/report_chapters.h"
#include "app/profile/profile_choice.h"
#include "core/error.h"
#include "core/storage/sha256.h"
#include "experiments/device_profile/device_profile.h"
#include "experiments/device_profile/profile_writer.h"

namespace jnd::app {
namespace {

namespace fs = std::filesystem;
using analysis::HtmlTable;
using analysis::HtmlText;

/// The styles of boxes, equations and lines to sign on, in addition to those of every report.
constexpr char kFiledStyle[] = R"css(
.verdict { border: 2px solid #1b1b1b; padding: .5rem .8rem; margin: .8rem 0; }
.verdict p { margin: .2rem 0; }
.verdict ul { margin: .3rem 0; padding-left: 1.2rem; }
.verdict .words { font-weight: 600; }
.equation { margin: .4rem 0 .4rem 1.6rem; font-style: italic; }
.signatures { display: table; width: 100%; margin: 1.4rem 0 .6rem; border-spacing: 1.2rem 0;
  break-inside: avoid; font-size: .8rem; color: #444; }
.signatures div { display: table-cell; width: 33%; border-bottom: 1px solid #1b1b1b;
  height: 3.2rem; vertical-align: top; }
@media print { #section-1 { break-before: page; border-top: none; margin-top: 0; } h2 { margin-top: 1.2rem; } figure { margin: .8rem 0; } }
)css";

std::string bytes_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

std::string newest_of(const CommissioningResults& results) {
  return *std::ranges::max_element(results.measured_at);
}

std::string oldest_of(const CommissioningResults& results) {
  std::string oldest;
  for (const std::string& at : results.measured_at) {
    if (!at.empty() && (oldest.empty() || at < oldest)) oldest = at;
  }
  return oldest;
}

std::string date_of_moment(const std::string& at) { return at.substr(0, 10); }

/// The time in nanoseconds; 0 if the text is no time.
std::int64_t time_ns_of(const std::string& at) {
  using namespace std::chrono;
  int numbers[6] = {};
  if (std::sscanf(at.c_str(), "%4d-%2d-%2dT%2d:%2d:%2d", &numbers[0], &numbers[1], &numbers[2],
                  &numbers[3], &numbers[4], &numbers[5]) != 6) {
    return 0;
  }
  const sys_days day = year(numbers[0]) / month(static_cast<unsigned>(numbers[1])) /
                       std::chrono::day(static_cast<unsigned>(numbers[2]));
  return duration_cast<nanoseconds>(day.time_since_epoch() + hours(numbers[3]) +
                                    minutes(numbers[4]) + seconds(numbers[5]))
      .count();
}

/// The steps that do not count as measured, such as "force, delay".
std::string missing_steps(const CommissioningResults& results) {
  std::string missing;
  for (const CommissioningStep step : kCommissioningSteps) {
    if (results.has(step)) continue;
    missing += (missing.empty() ? "" : ", ") + std::string(words_of(step).name);
  }
  return missing;
}

/// True if this profile comes from these measurements: it contains those of every step to the
/// last digit. Every step has to be measured.
bool is_of(const experiments::DeviceProfile& profile, const CommissioningResults& results) {
  const auto& gain = profile.force.gain;
  // No delay is given for a device that is not a single mass.
  constexpr double kNotTold = -1.0;
  const double told_s = profile.delay_s ? profile.delay_s->value : kNotTold;
  const double found_s = analysis::is_single_mass(*results.delay, *results.force)
                             ? std::max(0.0, results.delay->delay_s.value)
                             : kNotTold;
  const Eigen::Vector3d& offset_m = results.frame->offset_m;
  return profile.measured_on == date_of_moment(newest_of(results)) && gain &&
         gain->value == results.force->gain.value && told_s == found_s && profile.stability &&
         profile.stability->viscosity_pa_s.value == results.stability->viscosity_pa_s &&
         profile.frame.offset_m == std::array{offset_m.x(), offset_m.y(), offset_m.z()} &&
         profile.noise.position_sd_m == results.noise->position_sd_m.value;
}

/// Adds attempts that failed after what counts, because whoever signs has to know of them.
void add_failures(const CommissioningRecord& record, std::vector<std::string>& lacks) {
  std::map<std::string, const RecordedEntry*> last;  // The last attempt at each step.
  for (const RecordedEntry& entry : record.entries) last[entry.step] = &entry;
  for (const auto& [step, entry] : last) {
    if (entry->fate != RecordedFate::kFailed) continue;
    lacks.push_back(fmt::format("The last attempt at the step {}, on {}, failed: {}.", step,
                                date_of_moment(entry->at), entry->why));
  }
}

/// Everybody who measured, each once, in order.
std::string operators_of(const CommissioningRecord& record, const std::string& given) {
  if (!given.empty()) return given;
  std::string names;
  std::set<std::string> told;
  for (const RecordedEntry& entry : record.entries) {
    if (entry.operator_name.empty() || !told.insert(entry.operator_name).second) continue;
    names += (names.empty() ? "" : ", ") + entry.operator_name;
  }
  return names;
}

struct Filed {
  const CommissioningReportRequest& request;
  const CommissioningRecord& record;
  std::string record_bytes;
  CommissioningVerdict verdict;
  std::string operators;
};

std::string or_dash(const std::string& text) { return text.empty() ? "–" : text; }

std::string measured_words(const CommissioningResults& results) {
  const std::string oldest = oldest_of(results), newest = newest_of(results);
  if (newest.empty()) return "not yet";
  return date_of_moment(oldest) == date_of_moment(newest)
             ? date_of_moment(newest)
             : date_of_moment(oldest) + " to " + date_of_moment(newest);
}

HtmlTable device_table(const Filed& filed) {
  const CommissioningRecord& record = filed.record;
  const std::optional<KnownProfile>& profile = filed.request.profile;
  return {.caption = "The device",
          .columns = {{"What"}, {"Which"}},
          .rows = {{"Device, as after --device", record.device},
                   {"Kind", record.simulated ? "SIMULATED device" : "real device"},
                   {"Model", or_dash(record.identity.model)},
                   {"Serial", or_dash(record.identity.serial)},
                   {"Firmware", or_dash(record.identity.firmware)},
                   {"Measured on", measured_words(record.results)},
                   {"Measured by", or_dash(filed.operators)},
                   {"Profile", profile ? fs::path(profile->place).filename().string() : "none"},
                   {"Valid until", profile ? profile->profile.valid_until : "–"}}};
}

std::string verdict_box(const CommissioningVerdict& verdict) {
  std::string box = "<div class=\"verdict\">\n<p class=\"words\">" +
                    analysis::html_escaped(verdict.words) + "</p>\n";
  HtmlText lacks;
  if (!verdict.lacks.empty()) lacks.paragraph("What is missing or stands against it:");
  lacks.list(verdict.lacks);
  return box + lacks.text() + "</div>\n";
}

std::string title_of(const CommissioningRecord& record) {
  return "Commissioning of " + (record.device.empty() ? record.identity.model : record.device);
}

std::string front_of(const Filed& filed) {
  const CommissioningRecord& record = filed.record;
  std::string text =
      "<h1>" + analysis::html_escaped(title_of(record)) + "</h1>\n<p class=\"authors\">" +
      analysis::html_escaped(
          fmt::format("Measured {}{}. Report of {}, by jnd {}.", measured_words(record.results),
                      filed.operators.empty() ? "" : " by " + filed.operators,
                      filed.request.written_on, filed.request.program_version)) +
      "</p>\n";
  if (record.simulated) {
    text +=
        "<p class=\"banner\">SIMULATED device: nothing here was measured on hardware, and "
        "nothing of it holds for a real device.</p>\n";
  }
  return text + verdict_box(filed.verdict);
}

constexpr char kSignatures[] =
    "<div class=\"signatures\"><div>Measured by (name, date, signature)</div>"
    "<div>Checked by (name, date, signature)</div>"
    "<div>Released for sessions (name, date, signature)</div></div>\n";

void write_provenance(HtmlText& html, const Filed& filed) {
  html.heading(2, "Provenance");
  HtmlTable table{.caption = "What this report rests on",
                  .columns = {{"What"}, {"Which", false, true}}};
  table.rows.push_back({"Record", filed.request.record.filename().string()});
  table.rows.push_back(
      {fmt::format("SHA-256 of its first {} bytes, which is all that there was",
                   filed.record_bytes.size()),
       core::sha256(filed.record_bytes)});
  if (filed.request.profile) {
    table.rows.push_back(
        {"Profile", fs::path(filed.request.profile->place).filename().string()});
    table.rows.push_back({"SHA-256 of the profile", core::sha256(filed.request.profile->text)});
    table.rows.push_back(
        {"Profile written by jnd", filed.request.profile->profile.program_version});
  }
  table.rows.push_back({"Report written by jnd", filed.request.program_version});
  table.notes = {
      "The record only ever grows: head -c BYTES RECORD | sha256sum gives this sum again. "
      "Files "
      "of the figures, with the tables that they are drawn from, are in the folder figures "
      "beside this report."};
  html.table(table);
}

/// Writes the figures of a step, if it has any.
void write_step_figures(HtmlText& html, const Filed& filed, const std::string& section,
                        const std::vector<analysis::Figure>& figures,
                        const std::vector<analysis::DrawnFigure>& drawn) {
  for (std::size_t i = 0; i < figures.size(); ++i) {
    if (figures[i].section != section) continue;
    std::string caption = figures[i].caption;
    if (filed.record.simulated) caption += " SIMULATED device.";
    if (drawn[i].svg.empty()) caption += " Not drawn: " + drawn[i].problem + ".";
    (void)html.figure(figures[i].name, drawn[i].svg, figures[i].title, caption);
  }
}

std::string report_text(const Filed& filed, const std::vector<analysis::Figure>& figures,
                        const std::vector<analysis::DrawnFigure>& drawn) {
  const CommissioningResults& results = filed.record.results;
  HtmlText facts;
  facts.list(main_findings(results));
  HtmlText html;
  html.table(device_table(filed));
  const std::string first_page = front_of(filed) + facts.text() + html.text() + kSignatures;
  HtmlText body = html;
  body.heading(2, "What was measured");
  write_quantities(body, results);
  for (const CommissioningStep step : kCommissioningSteps) {
    write_step_figures(body, filed, std::string(words_of(step).name), figures, drawn);
  }
  if (figures.empty() && !newest_of(results).empty()) {
    body.paragraph(
        "The program that made this record did not keep single readings in it, so there are no "
        "figures.");
  }
  body.heading(2, "Methods");
  write_commissioning_methods(body, results);
  body.heading(2, "Conditions");
  write_conditions(body, results, filed.request.profile);
  body.heading(2, "History");
  write_history(body, filed.record, filed.request.profile);
  write_provenance(body, filed);
  write_commissioning_references(body, results);
  // The numbers of tables continue from those of the first page.
  const std::string rest = body.text().substr(html.text().size());
  return analysis::html_document(title_of(filed.record),
                                 filed.record.simulated ? "SIMULATED device" : "",
                                 first_page + rest, kFiledStyle);
}

}  // namespace

CommissioningVerdict verdict_of(const CommissioningRecord& record,
                                const std::optional<KnownProfile>& profile,
                                const std::string& on_day) {
  CommissioningVerdict verdict;
  const CommissioningResults& results = record.results;
  const std::string missing = missing_steps(results);
  const std::string newest = date_of_moment(newest_of(results));
  std::string against;
  if (!missing.empty()) {
    verdict.lacks.push_back("Not measured: " + missing + ".");
    against = "not every step is measured";
  } else if (!profile) {
    verdict.lacks.emplace_back(
        "There is no profile of these measurements; jnd commission writes it.");
    against = "there is no profile";
  } else if (!is_of(profile->profile, results)) {
    verdict.lacks.push_back(
        fmt::format("The profile, of {}, does not hold what the record says, which was last "
                    "measured on {}; "
                    "jnd commission writes another.",
                    profile->profile.measured_on, newest));
    against = "the profile is not of these measurements";
  } else if (const std::string words = outdated_words(*profile, on_day); !words.empty()) {
    verdict.lacks.push_back(words + ".");
    against = profile->profile.valid_until < on_day ? "the profile has ended"
                                                    : "the last daily check failed";
  }
  add_failures(record, verdict.lacks);
  if (profile && !profile->profile.stability) {
    verdict.lacks.emplace_back(
        "The profile has no limits of stability: nothing says how thick a fluid or how stiff a "
        "wall the device renders without trembling.");
  }
  verdict.is_fit = against.empty();
  if (!verdict.is_fit) {
    verdict.words = "NOT FIT FOR SESSIONS: " + against + ".";
    if (!record.simulated) {
      verdict.words += " A real device without a valid profile gives no force in a session.";
    }
    return verdict;
  }
  const std::string file = fs::path(profile->place).filename().string();
  verdict.words =
      record.simulated
          ? fmt::format(
                "Every step is measured. The profile {} holds until {}, for this "
                "simulated device alone.",
                file, profile->profile.valid_until)
          : fmt::format("Fit for sessions until {}, by the profile {}: every step is measured.",
                        profile->profile.valid_until, file);
  return verdict;
}

analysis::ReportOutcome write_commissioning_report(const CommissioningReportRequest& request) {
  analysis::require_free_folder(request.out);
  const CommissioningRecord record = read_commissioning_record(request.record);
  const Filed filed{.request = request,
                    .record = record,
                    .record_bytes = bytes_of(request.record),
                    .verdict = verdict_of(record, request.profile, request.written_on),
                    .operators = operators_of(record, request.operator_name)};
  const CommissioningResults& results = record.results;
  const auto counting = [&](CommissioningStep step, const auto& fit) {
    return results.has(step) ? fit : std::nullopt;
  };
  return analysis::write_document(
      {.figures = analysis::commissioning_figures(
           {.noise = counting(CommissioningStep::kNoise, results.noise),
            .frame = counting(CommissioningStep::kFrame, results.frame),
            .force = counting(CommissioningStep::kForce, results.force),
            .delay = counting(CommissioningStep::kDelay, results.delay)}),
       .simulated = record.simulated,
       .date_time_ns = time_ns_of(newest_of(results)),
       .html =
           [&filed](const std::vector<analysis::Figure>& figures,
                    const std::vector<analysis::DrawnFigure>& drawn) {
             return report_text(filed, figures, drawn);
           }},
      request.out, request.tools);
}

std::optional<KnownProfile> profile_of_record(const fs::path& record, const std::string& file,
                                              const std::string& on_day) {
  const CommissioningRecord told = read_commissioning_record(record);
  if (!file.empty()) {
    KnownProfile known = read_known_profile(file);
    const std::string foreign = foreign_words(known, told.identity, told.simulated, true);
    if (!foreign.empty()) throw core::Error(foreign);
    return known;
  }
  std::vector<fs::path> folders = {record.has_parent_path() ? record.parent_path()
                                                            : fs::path(".")};
  for (const fs::path& folder : profile_folders()) folders.push_back(folder);
  return find_profile(
             {.name = told.device, .identity = told.identity, .says_simulated = told.simulated},
             folders, on_day)
      .known;
}

fs::path report_folder_beside(const fs::path& profile) {
  std::string name = profile.filename().string();
  if (name.ends_with(experiments::kDeviceProfileEnding)) {
    name.resize(name.size() - experiments::kDeviceProfileEnding.size());
  }
  const fs::path folder = profile.parent_path();
  fs::path free = folder / (name + ".report");
  for (int number = 2; fs::exists(fs::symlink_status(free)); ++number) {
    free = folder / (name + "-" + std::to_string(number) + ".report");
  }
  return free;
}

CommissioningFiles write_commissioning_files(const Commissioning& commissioning,
                                             const device::DeviceIdentity& identity,
                                             const std::filesystem::path& folder,
                                             const std::string& program_version,
                                             const std::string& today) {
  const std::filesystem::path profile = experiments::write_device_profile(
      profile_of(commissioning, identity, program_version), folder);
  return {
      .profile = profile,
      .report = write_commissioning_report({.record = commissioning.record(),
                                            .profile = read_known_profile(profile),
                                            .operator_name = commissioning.plan().operator_name,
                                            .program_version = program_version,
                                            .written_on = today,
                                            .out = report_folder_beside(profile),
                                            .tools = analysis::installed_report_tools()})};
}

}  // namespace jnd::app
