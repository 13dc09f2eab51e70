#include "app/operator/appointments.h"

#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <set>

#include "app/language/words.h"
#include "app/session/pseudonym.h"

namespace jnd::app {
namespace {

constexpr std::int64_t kNanoseconds = 1'000'000'000;
constexpr std::int64_t kPatience_ns = 15LL * 60 * kNanoseconds;

std::tm local_parts(std::int64_t time_ns) {
  const std::time_t seconds = time_ns / kNanoseconds;
  std::tm parts{};
  ::localtime_r(&seconds, &parts);
  return parts;
}

std::set<std::string> taken_pseudonyms(const core::StudyStore& store) {
  std::set<std::string> taken;
  for (const core::SessionRow& row : store.sessions()) taken.insert(row.participant);
  for (const core::WithdrawalRow& gone : store.withdrawals()) taken.insert(gone.participant);
  return taken;
}

/// True if the whole `text` has the form, such as "0000-00-00", in which 0 stands for any
/// digit.
bool has_form(const std::string& text, const std::string& form) {
  return std::ranges::equal(text, form, [](char letter, char wanted) {
    return wanted == '0' ? letter >= '0' && letter <= '9' : letter == wanted;
  });
}

}  // namespace

std::vector<ScheduleLine> schedule_of(const std::vector<core::AppointmentRow>& appointments,
                                      const StudyFolder& study, std::int64_t now_ns) {
  std::vector<ScheduleLine> lines;
  for (const core::AppointmentRow& row : appointments) {
    if (row.cancelled) continue;
    ScheduleLine line{
        .appointment = row.appointment,
        .participant = row.participant,
        .when = day_in_words(row.starts_time_ns, now_ns) + hour_in_words(row.starts_time_ns)};
    const bool came = std::ranges::find(study.sessions, row.participant,
                                        &SessionLine::participant) != study.sessions.end();
    if (came) {
      line.state = ScheduleLine::State::kCame;
    } else if (row.starts_time_ns + kPatience_ns < now_ns) {
      line.state = ScheduleLine::State::kMissed;
    }
    lines.push_back(std::move(line));
  }
  return lines;
}

std::string free_pseudonym(const core::StudyStore& store,
                           const std::vector<core::AppointmentRow>& appointments) {
  std::set<std::string> taken = taken_pseudonyms(store);
  for (const core::AppointmentRow& row : appointments) {
    if (!row.cancelled) taken.insert(row.participant);
  }
  return next_participants(taken, 1).front();
}

std::string next_participant(const core::StudyStore& store,
                             const std::vector<core::AppointmentRow>& appointments,
                             std::int64_t now_ns) {
  const std::set<std::string> taken = taken_pseudonyms(store);
  const std::string today = date_text(now_ns);
  for (const core::AppointmentRow& row : appointments) {
    const bool is_over = row.starts_time_ns < now_ns && date_text(row.starts_time_ns) != today;
    if (!row.cancelled && !is_over && !taken.contains(row.participant)) return row.participant;
  }
  return free_pseudonym(store, appointments);
}

std::string date_text(std::int64_t time_ns) {
  const std::tm parts = local_parts(time_ns);
  return fmt::format("{:04}-{:02}-{:02}", parts.tm_year + 1900, parts.tm_mon + 1,
                     parts.tm_mday);
}

std::string hour_text(std::int64_t time_ns) {
  const std::tm parts = local_parts(time_ns);
  return fmt::format("{:02}:{:02}", parts.tm_hour, parts.tm_min);
}

std::optional<std::int64_t> time_of_texts(const std::string& date, const std::string& hour) {
  if (!has_form(date, "0000-00-00") || !has_form(hour, "00:00")) return std::nullopt;
  std::tm parts{};
  parts.tm_year = std::stoi(date.substr(0, 4)) - 1900;
  parts.tm_mon = std::stoi(date.substr(5, 2)) - 1;
  parts.tm_mday = std::stoi(date.substr(8, 2));
  parts.tm_hour = std::stoi(hour.substr(0, 2));
  parts.tm_min = std::stoi(hour.substr(3, 2));
  parts.tm_isdst = -1;
  const std::int64_t time_ns = std::int64_t{std::mktime(&parts)} * kNanoseconds;
  // The 31st of June does not exist, but the system would turn it into the first of July.
  if (date_text(time_ns) != date || hour_text(time_ns) != hour) return std::nullopt;
  return time_ns;
}

}  // namespace jnd::app
