#include "core/storage/recording.h"

#include <algorithm>
#include <optional>

#include "core/sample_table.h"
#include "core/storage/database.h"
#include "core/storage/sample_codec.h"
#include "core/storage/sha256.h"

namespace jnd::core {
namespace {

// About four seconds at 1 kHz, which is long enough to compress well and short enough to lose
// little.
constexpr std::size_t kSamplesPerChunk = 4096;
// In format 2 chunks may hold joints. In format 3 they may hold times, and a table holds the
// ticks that never ran. In format 4 they may hold what else a device measures. A recording
// takes format 3 or 4 with the first of these, so that all others stay as they were.
constexpr std::int64_t kFormat = 4, kFormatWithChannels = 4, kFormatWithTimes = 3,
                       kFormatWithoutTimes = 2;

constexpr char kSchema[] = R"sql(
CREATE TABLE recording_format (
  version INTEGER NOT NULL,
  rate_hz REAL NOT NULL,
  position_unit_m REAL NOT NULL,
  velocity_unit_m_per_s REAL NOT NULL,
  force_unit_n REAL NOT NULL,
  joint_position_unit_rad REAL NOT NULL,
  joint_torque_unit_n_m REAL NOT NULL
);
CREATE TABLE chunk (
  segment INTEGER NOT NULL,
  first_tick INTEGER NOT NULL,
  num_samples INTEGER NOT NULL,
  sha256 TEXT NOT NULL,
  data BLOB NOT NULL,
  PRIMARY KEY (segment, first_tick)
);
)sql";

constexpr char kTimesSchema[] = R"sql(
CREATE TABLE IF NOT EXISTS missed (
  segment INTEGER NOT NULL,
  first_tick INTEGER NOT NULL,
  num_ticks INTEGER NOT NULL,
  PRIMARY KEY (segment, first_tick)
);
)sql";

bool has_missed_ticks(Database& database) {
  return Statement(database,
                   "SELECT 1 FROM sqlite_master WHERE type = 'table' AND name = 'missed'")
      .step();
}

}  // namespace

struct RecordingWriter::Implementation {
  Implementation(const std::filesystem::path& file, double rate_hz, Durability durability)
      : database(file,
                 std::filesystem::exists(file) ? Database::Mode::kReadWrite
                                               : Database::Mode::kCreate,
                 durability) {
    // A program that died while it made the file leaves one without tables.
    if (is_empty(database)) {
      Transaction transaction(database);
      database.execute(kSchema);
      Statement(database, "INSERT INTO recording_format VALUES (?, ?, ?, ?, ?, ?, ?)")
          .bind(kFormatWithoutTimes)
          .bind(rate_hz)
          .bind(kPositionUnitM)
          .bind(kVelocityUnitMPerS)
          .bind(kForceUnitN)
          .bind(kJointPositionUnitRad)
          .bind(kJointTorqueUnitNM)
          .run();
      transaction.commit();
    }
    Statement next(database, "SELECT COALESCE(MAX(segment), 0) + 1 FROM chunk");
    if (next.step()) segment = next.integer(0);
    insert.emplace(database, "INSERT INTO chunk VALUES (?, ?, ?, ?, ?)");
    pending.reserve(kSamplesPerChunk);
  }

  void write_chunk() {
    if (pending.empty()) return;
    database.require_in_place();
    const Sample& first = pending.front();
    if (first.monotonic_ns != 0 || first.num_missed_before > 0) keep_times();
    if (first.num_missed_before > 0) {
      insert_missed->bind(segment)
          .bind(first.tick - first.num_missed_before)
          .bind(first.num_missed_before)
          .run();
    }
    if (first.channels.bits != 0 && !keeps_channels) {
      become(kFormatWithChannels);
      keeps_channels = true;
    }
    const std::string bytes = encode_samples(pending);
    insert->bind(segment)
        .bind(pending.front().tick)
        .bind(static_cast<std::int64_t>(pending.size()))
        .bind(sha256(bytes))
        .bind_bytes(bytes)
        .run();
    pending.clear();
  }

  void keep_times() {
    if (insert_missed) return;
    Transaction transaction(database);
    database.execute(kTimesSchema);
    become(kFormatWithTimes);
    transaction.commit();
    insert_missed.emplace(database, "INSERT OR REPLACE INTO missed VALUES (?, ?, ?)");
  }

  void become(std::int64_t format) {
    Statement(database, "UPDATE recording_format SET version = MAX(version, ?)")
        .bind(format)
        .run();
  }

  Database database;
  std::int64_t segment = 1;
  bool keeps_channels = false;
  std::optional<Statement> insert;
  std::optional<Statement> insert_missed;  ///< Used in a recording with times.
  std::vector<Sample> pending;
};

RecordingWriter::RecordingWriter(const std::filesystem::path& file, double rate_hz,
                                 Durability durability)
    : implementation_(std::make_unique<Implementation>(file, rate_hz, durability)) {}

RecordingWriter::~RecordingWriter() {
  try {
    flush();
  } catch (const std::exception&) {
    // `flush` reports failures. A destructor must not throw.
  }
}

void RecordingWriter::append(const Sample& sample) {
  std::vector<Sample>& pending = implementation_->pending;
  const bool follows = pending.empty() || sample.tick == pending.back().tick + 1;
  if (!follows || pending.size() == kSamplesPerChunk) implementation_->write_chunk();
  pending.push_back(sample);
}

void RecordingWriter::flush() { implementation_->write_chunk(); }

struct RecordingReader::Implementation {
  explicit Implementation(const std::filesystem::path& file)
      : database(file, Database::Mode::kReadOnly, Durability::kEveryCommit) {
    if (is_empty(database)) return;
    Statement format(database, "SELECT version, rate_hz FROM recording_format");
    if (!format.step()) {
      throw Error(file.string() + ": expected a recording of jnd, found no format in it");
    }
    if (format.integer(0) > kFormat) {
      throw Error(file.string() + ": expected recording format " + std::to_string(kFormat) +
                  " or older, found " + std::to_string(format.integer(0)) +
                  "; open it with a newer jnd");
    }
    rate_hz = format.number(1);
  }

  mutable Database database;
  double rate_hz = 0.0;
};

RecordingReader::RecordingReader(const std::filesystem::path& file)
    : implementation_(std::make_unique<Implementation>(file)) {}

RecordingReader::~RecordingReader() = default;

double RecordingReader::rate_hz() const noexcept { return implementation_->rate_hz; }

bool RecordingReader::has_joints() const {
  if (is_empty(implementation_->database)) return false;
  Statement first(implementation_->database,
                  "SELECT first_tick, num_samples FROM chunk ORDER BY segment, first_tick");
  if (!first.step()) return false;
  bool found = false;
  read(first.integer(0), first.integer(0) + first.integer(1) - 1,
       [&found](const Sample& sample) { found |= jnd::core::has_joints(sample); });
  return found;
}

ChannelBits RecordingReader::channels() const {
  if (is_empty(implementation_->database)) return 0;
  Statement format(implementation_->database, "SELECT version FROM recording_format");
  if (!format.step() || format.integer(0) < kFormatWithChannels) return 0;
  ChannelBits bits = 0;
  // Another robot may have continued the session, so one sample of each segment is read.
  Statement firsts(implementation_->database,
                   "SELECT MIN(first_tick) FROM chunk GROUP BY segment");
  while (firsts.step()) {
    read(firsts.integer(0), firsts.integer(0), [&bits](const Sample& sample) {
      bits = static_cast<ChannelBits>(bits | sample.channels.bits);
    });
  }
  return bits;
}

/// Whether the bytes decode to the numbers of the row. The hash does not cover the row's
/// numbers, but the bytes contain them.
static bool decodes(const RecordingChunk& chunk, std::string_view bytes) {
  if (chunk.num_samples < 1) return false;
  try {
    (void)decode_samples(bytes, chunk.first_tick, chunk.num_samples, "chunk");
    return true;
  } catch (const Error&) {
    return false;
  }
}

bool RecordingReader::has_times() const {
  if (is_empty(implementation_->database)) return false;
  Statement format(implementation_->database, "SELECT version FROM recording_format");
  if (!format.step() || format.integer(0) <= kFormatWithoutTimes) return false;
  if (format.integer(0) == kFormatWithTimes) return true;
  // The first sample tells. Simulated time has times that are all zero, or none.
  Statement first(implementation_->database, "SELECT MIN(first_tick) FROM chunk");
  bool found = false;
  if (!first.step()) return found;
  read(first.integer(0), first.integer(0),
       [&found](const Sample& sample) { found |= jnd::core::has_times(sample); });
  return found;
}

std::vector<RecordingChunk> RecordingReader::chunks() const {
  if (is_empty(implementation_->database)) return {};
  Statement rows(implementation_->database,
                 "SELECT segment, first_tick, num_samples, sha256, data FROM chunk "
                 "ORDER BY segment, first_tick");
  std::vector<RecordingChunk> all;
  while (rows.step()) {
    const std::string_view bytes = rows.bytes(4);
    RecordingChunk chunk{.segment = rows.integer(0),
                         .first_tick = rows.integer(1),
                         .num_samples = rows.integer(2),
                         .num_bytes = static_cast<std::int64_t>(bytes.size())};
    chunk.intact = sha256(bytes.data(), bytes.size()) == rows.text(3) && decodes(chunk, bytes);
    all.push_back(chunk);
  }
  return all;
}

std::int64_t RecordingReader::last_tick() const {
  if (is_empty(implementation_->database)) return -1;
  Statement rows(implementation_->database,
                 "SELECT MAX(first_tick + num_samples) - 1 FROM chunk");
  return rows.step() ? rows.optional_integer(0).value_or(-1) : -1;
}

/// Returns the ranges of rows that have a first tick and a number of ticks.
static std::vector<TickRange> ranges_of(Statement& rows) {
  std::vector<TickRange> ranges;
  while (rows.step()) {
    // Damaged numbers stand for no samples; `read` reports them.
    constexpr std::int64_t kBeyond = std::int64_t{1} << 53;
    const std::int64_t first = rows.integer(0), count = rows.integer(1);
    if (first < 0 || first >= kBeyond || count < 1 || count >= kBeyond) continue;
    ranges.push_back({first, first + count - 1});
  }
  return merged(std::move(ranges));
}

std::vector<TickRange> RecordingReader::ticks() const {
  if (is_empty(implementation_->database)) return {};
  Statement rows(implementation_->database, "SELECT first_tick, num_samples FROM chunk");
  return ranges_of(rows);
}

std::vector<TickRange> RecordingReader::missed() const {
  if (is_empty(implementation_->database) || !has_missed_ticks(implementation_->database)) {
    return {};
  }
  Statement rows(implementation_->database, "SELECT first_tick, num_ticks FROM missed");
  return ranges_of(rows);
}

std::vector<TickRange> RecordingReader::accounted() const {
  std::vector<TickRange> ranges = ticks();
  const std::vector<TickRange> never_ran = missed();
  ranges.insert(ranges.end(), never_ran.begin(), never_ran.end());
  return merged(std::move(ranges));
}

std::int64_t RecordingReader::missing_ticks() const {
  const std::vector<TickRange> ranges = accounted();
  if (ranges.empty()) return 0;
  return num_ticks(missing_in(ranges, {ranges.front().first_tick, ranges.back().last_tick}));
}

static void require_intact_chunk(const std::string& place, std::string_view bytes,
                                 const std::string& hash) {
  if (sha256(bytes.data(), bytes.size()) == hash) return;
  throw Error(
      place +
      ": expected bytes that fit their hash, found them damaged; `jnd verify` tells all "
      "that is, and a backup may have them whole");
}

void RecordingReader::read(std::int64_t first_tick, std::int64_t last_tick,
                           const std::function<void(const Sample&)>& visit) const {
  if (is_empty(implementation_->database)) return;
  Statement rows(implementation_->database,
                 "SELECT first_tick, num_samples, data, sha256 FROM chunk "
                 "WHERE first_tick <= ? AND first_tick + num_samples > ? "
                 "ORDER BY first_tick, segment");
  rows.bind(last_tick).bind(first_tick);
  while (rows.step()) {
    const std::string place = implementation_->database.file().string() + ": chunk at tick " +
                              std::to_string(rows.integer(0));
    require_intact_chunk(place, rows.bytes(2), rows.text(3));
    for (const Sample& sample :
         decode_samples(rows.bytes(2), rows.integer(0), rows.integer(1), place)) {
      if (sample.tick >= first_tick && sample.tick <= last_tick) visit(sample);
    }
  }
}

void RecordingReader::require_intact() const {
  if (is_empty(implementation_->database)) return;
  Statement rows(implementation_->database,
                 "SELECT first_tick, data, sha256 FROM chunk ORDER BY first_tick, segment");
  while (rows.step()) {
    require_intact_chunk(implementation_->database.file().string() + ": chunk at tick " +
                             std::to_string(rows.integer(0)),
                         rows.bytes(1), rows.text(2));
  }
}

}  // namespace jnd::core
