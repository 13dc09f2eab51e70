#include "chaos/force_log.h"

#include <algorithm>
#include <cstring>
#include <fstream>
#include <sstream>

namespace jnd::chaos {
namespace {

constexpr std::size_t kRecordBytes = 128;
constexpr double kRounding = 1e-6;
constexpr std::int64_t kNsPerMs = 1'000'000;

/// If a process pauses, no more than this much of the pause counts as time in which it could
/// have acted. The slowest of the clocks ticks every 2 ms.
constexpr std::int64_t kMostOfAPause_ns = 5 * kNsPerMs;
/// A tick may be interrupted in its middle and continue after any event, so a single sign
/// proves nothing.
constexpr int kLeastSigns = 2;

ForceLog::Record record_in(const char* bytes) {
  std::array<double, 3 * core::kNumContactPoints> numbers{};
  static_assert(sizeof numbers + sizeof(std::int64_t) == kRecordBytes);
  ForceLog::Record record;
  std::memcpy(&record.time_ns, bytes, sizeof record.time_ns);
  std::memcpy(numbers.data(), bytes + sizeof record.time_ns, sizeof numbers);
  for (std::size_t i = 0; i < record.force_n.size(); ++i) {
    record.force_n[i] = {numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2]};
  }
  return record;
}

std::string text_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

double total_n(const ForceLog::Record& record) {
  double sum_n = 0.0;
  for (const Eigen::Vector3d& force_n : record.force_n) sum_n += force_n.norm();
  return sum_n;
}

bool has_force(const ForceLog::Record& record) { return !(total_n(record) == 0.0); }

/// Returns the first moment at which the process with this clock has had `within_ms` to act
/// since `from_ns`.
std::int64_t deadline_ns(const std::vector<std::int64_t>& signs_ns, std::int64_t from_ns,
                         int within_ms) {
  std::int64_t counted_ns = 0, last_ns = from_ns;
  int num_signs = 0;
  for (auto sign = std::ranges::upper_bound(signs_ns, from_ns); sign != signs_ns.end();
       ++sign) {
    counted_ns += std::min(*sign - last_ns, kMostOfAPause_ns);
    last_ns = *sign;
    if (++num_signs >= kLeastSigns && counted_ns >= within_ms * kNsPerMs) return *sign;
  }
  return Revocation::kNever_ns;
}

class Judge {
 public:
  Judge(const ForceLog& log, const Happenings& happenings)
      : log_(log), happenings_(happenings) {
    for (const ForceLog::Record& record : log.records)
      record_times_ns_.push_back(record.time_ns);
  }

  std::string verdict() {
    for (std::size_t i = 0; i < log_.records.size(); ++i) {
      judge_size(i);
      judge_step(i);
      judge_standing(i);
    }
    if (!log_.records.empty()) {
      judge_start();
      for (const Revocation& revocation : happenings_.revocations) judge(revocation);
    }
    return violation_;
  }

 private:
  /// Returns until when the force of a record stood. After the last sign of its process, only
  /// the device's own controller can end the force.
  [[nodiscard]] std::int64_t until_ns(std::size_t i) const {
    if (i + 1 < log_.records.size()) return log_.records[i + 1].time_ns;
    return log_.beats_ns.empty() ? log_.records[i].time_ns : log_.beats_ns.back();
  }

  void judge_size(std::size_t i) {
    for (const Eigen::Vector3d& force_n : log_.records[i].force_n) {
      if (!force_n.allFinite()) return violated(i, "a force is no number");
      if (force_n.norm() > happenings_.most_per_point_n + kRounding) {
        return violated(i, in_text(force_n.norm()) + " N at one point");
      }
    }
    const double sum_n = total_n(log_.records[i]);
    if (sum_n > happenings_.most_in_all_n + kRounding) {
      violated(i, in_text(sum_n) + " N in all");
    }
  }

  void judge_step(std::size_t i) {
    const core::PointVectors& before_n = force_before(i);
    for (std::size_t point = 0; point < before_n.size(); ++point) {
      const Eigen::Vector3d& now_n = log_.records[i].force_n[point];
      const double step_n = (now_n - before_n[point]).norm();
      if (step_n > happenings_.most_step_n + kRounding && !now_n.isZero(0.0)) {
        return violated(i, "a step of " + in_text(step_n) + " N");
      }
    }
  }

  /// Returns the force before a record. A halt may come while a force is on its way to a
  /// driver, because a halt does not wait. This one force arrives after the halt and is taken
  /// back at once, so the next step counts from the force before it.
  [[nodiscard]] const core::PointVectors& force_before(std::size_t i) const {
    static const core::PointVectors kNone_n = core::zero_vectors();
    if (i == 0) return kNone_n;
    const bool is_taken_back = i + 1 < log_.records.size() && !has_force(log_.records[i + 1]) &&
                               until_ns(i) - log_.records[i].time_ns <= kMostOfAPause_ns;
    std::size_t last = i - 1;
    while (is_taken_back && last > 0 && !has_force(log_.records[last])) --last;
    return log_.records[last].force_n;
  }

  void judge_standing(std::size_t i) {
    if (!has_force(log_.records[i]) || happenings_.longest_standing_ms == 0) return;
    const std::int64_t due_ns =
        deadline_ns(log_.beats_ns, log_.records[i].time_ns, happenings_.longest_standing_ms);
    if (due_ns < until_ns(i)) violated(i, "a force stood that nobody renewed");
  }

  /// Judges that there is no force before any program could have armed the device.
  void judge_start() {
    const auto& starts_ns = happenings_.program_starts_ns;
    const std::int64_t first_ns = starts_ns.empty() ? Revocation::kNever_ns : starts_ns.front();
    require_none("no program was started yet", log_.records.front().time_ns, first_ns);
  }

  void judge(const Revocation& revocation) {
    const bool by_beats = revocation.clock == Revocation::Clock::kBeats;
    const std::int64_t due_ns = deadline_ns(by_beats ? log_.beats_ns : record_times_ns_,
                                            revocation.from_ns, revocation.within_ms);
    if (due_ns >= revocation.over_by_ns) return;
    require_none(revocation.cause, due_ns, next_start_ns(revocation.from_ns));
  }

  [[nodiscard]] std::int64_t next_start_ns(std::int64_t after_ns) const {
    const auto& starts_ns = happenings_.program_starts_ns;
    const auto next = std::ranges::upper_bound(starts_ns, after_ns);
    if (next == starts_ns.end()) return Revocation::kNever_ns;
    // The program of a later start has opened a device of its own.
    const bool is_anothers = log_.is_of_one_program && *next > log_.records.front().time_ns;
    return is_anothers ? Revocation::kNever_ns : *next;
  }

  void require_none(const std::string& cause, std::int64_t from_ns, std::int64_t to_ns) {
    for (std::size_t i = 0; i < log_.records.size(); ++i) {
      if (log_.records[i].time_ns >= to_ns) return;
      if (until_ns(i) <= from_ns || !has_force(log_.records[i])) continue;
      return violated(i, in_text(total_n(log_.records[i])) + " N although " + cause + ", " +
                             in_text(1e-6 * static_cast<double>(until_ns(i) - from_ns)) +
                             " ms after it had to be gone");
    }
  }

  static std::string in_text(double number) {
    std::ostringstream text;
    text << number;
    return text.str();
  }

  void violated(std::size_t i, const std::string& what) {
    if (!violation_.empty()) return;
    const std::int64_t begin_ns = happenings_.program_starts_ns.empty()
                                      ? log_.records.front().time_ns
                                      : happenings_.program_starts_ns.front();
    violation_ = std::to_string((log_.records[i].time_ns - begin_ns) / kNsPerMs) +
                 " ms, record " + std::to_string(i) + ": " + what + around(i, begin_ns);
  }

  /// Returns the records around a violation, because no other run has the same records.
  [[nodiscard]] std::string around(std::size_t i, std::int64_t begin_ns) const {
    std::ostringstream text;
    const std::size_t first = i < 4 ? 0 : i - 4;
    for (std::size_t k = first; k < std::min(i + 5, log_.records.size()); ++k) {
      text << "\n  record " << k << " at "
           << 1e-6 * static_cast<double>(log_.records[k].time_ns - begin_ns)
           << " ms: " << total_n(log_.records[k]) << " N in all";
    }
    return text.str();
  }

  const ForceLog& log_;
  const Happenings& happenings_;
  std::vector<std::int64_t> record_times_ns_;
  std::string violation_;
};

}  // namespace

ForceLog read_force_log(const std::filesystem::path& file, const std::filesystem::path& beats) {
  ForceLog log;
  const std::string text = text_of(file);
  for (std::size_t at = 0; at + kRecordBytes <= text.size(); at += kRecordBytes) {
    log.records.push_back(record_in(text.data() + at));
  }
  if (beats.empty()) {
    for (const ForceLog::Record& record : log.records) log.beats_ns.push_back(record.time_ns);
    return log;
  }
  const std::string times = text_of(beats);
  log.beats_ns.resize(times.size() / sizeof(std::int64_t));
  std::memcpy(log.beats_ns.data(), times.data(), sizeof(std::int64_t) * log.beats_ns.size());
  return log;
}

bool ForceWatch::has_new_force(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  stream.seekg(static_cast<std::streamoff>(offset_bytes_ - offset_bytes_ % kRecordBytes));
  std::array<char, kRecordBytes> bytes{};
  while (stream.read(bytes.data(), bytes.size())) {
    offset_bytes_ = static_cast<std::uintmax_t>(stream.tellg());
    has_force_ = has_force(record_in(bytes.data()));
    was_without_ |= !has_force_;
  }
  return was_without_ && has_force_;
}

std::string judged(const ForceLog& log, const Happenings& happenings) {
  return Judge(log, happenings).verdict();
}

int milliseconds_with_force(const ForceLog& log) {
  std::int64_t sum_ns = 0;
  for (std::size_t i = 0; i + 1 < log.records.size(); ++i) {
    if (has_force(log.records[i]))
      sum_ns += log.records[i + 1].time_ns - log.records[i].time_ns;
  }
  return static_cast<int>(sum_ns / kNsPerMs);
}

}  // namespace jnd::chaos
