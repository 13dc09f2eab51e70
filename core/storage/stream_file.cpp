#include "core/storage/stream_file.h"

#include <zstd.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <utility>

#include "core/error.h"
#include "core/storage/database.h"
#include "core/storage/sha256.h"

namespace jnd::core {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kStreamFormat = 1;
constexpr std::size_t kMostSamplesOfBlock = 4096;
constexpr std::size_t kMostBytesOfBlock = std::size_t{1} << 20;
/// Limits how much memory a damaged length can ask for.
constexpr unsigned long long kLargestBlock = 1ULL << 28;
constexpr int kZstdLevel = 3;
constexpr const char* kStreamMark = ".stream-";

constexpr char kStreamSchema[] = R"sql(
CREATE TABLE stream_format (
  version INTEGER NOT NULL,
  name TEXT NOT NULL,
  type TEXT NOT NULL,
  channel_format TEXT NOT NULL,
  channel_count INTEGER NOT NULL,
  nominal_rate_hz REAL NOT NULL,
  xml TEXT NOT NULL
);
CREATE TABLE block (
  number INTEGER PRIMARY KEY,
  num_samples INTEGER NOT NULL,
  sha256 TEXT NOT NULL,
  data BLOB NOT NULL
);
CREATE TABLE clock_offset (
  number INTEGER PRIMARY KEY,
  time_s REAL NOT NULL,
  offset_s REAL NOT NULL,
  round_trip_s REAL NOT NULL
);
CREATE TABLE seal (
  num_samples INTEGER NOT NULL,
  num_offsets INTEGER NOT NULL,
  sha256 TEXT NOT NULL
);
)sql";

void put_bytes(std::string& bytes, const void* value, std::size_t size) {
  bytes.append(static_cast<const char*>(value), size);
}

/// Writes times, then values, channel after channel. Before each text stands its length in four
/// bytes.
std::string encoded(const std::vector<StreamSample>& samples) {
  std::string plain;
  for (const StreamSample& sample : samples) {
    put_bytes(plain, &sample.time_s, sizeof sample.time_s);
  }
  for (const StreamSample& sample : samples) {
    plain += sample.values;
    for (const std::string& text : sample.texts) {
      const auto size = static_cast<std::uint32_t>(text.size());
      put_bytes(plain, &size, sizeof size);
      plain += text;
    }
  }
  std::string packed(ZSTD_compressBound(plain.size()), '\0');
  const std::size_t size =
      ZSTD_compress(packed.data(), packed.size(), plain.data(), plain.size(), kZstdLevel);
  if (ZSTD_isError(size) != 0U) throw Error("stream: expected to pack a block of samples");
  packed.resize(size);
  return packed;
}

class BlockReader {
 public:
  BlockReader(std::string_view packed, std::string place) : place_(std::move(place)) {
    const unsigned long long size = ZSTD_getFrameContentSize(packed.data(), packed.size());
    if (size == ZSTD_CONTENTSIZE_ERROR || size == ZSTD_CONTENTSIZE_UNKNOWN ||
        size > kLargestBlock) {
      refuse();
    }
    plain_.resize(static_cast<std::size_t>(size));
    if (ZSTD_decompress(plain_.data(), plain_.size(), packed.data(), packed.size()) !=
        plain_.size()) {
      refuse();
    }
  }

  std::vector<StreamSample> samples(std::int64_t count, const StreamFileInfo& info) {
    if (count < 1 || static_cast<std::uint64_t>(count) > plain_.size() / sizeof(double)) {
      refuse();
    }
    std::vector<StreamSample> samples(static_cast<std::size_t>(count));
    for (StreamSample& sample : samples) std::memcpy(&sample.time_s, take(8), 8);
    const auto num_channels = static_cast<std::size_t>(info.channel_count);
    const std::size_t width = num_channels * value_bytes(info.format);
    for (StreamSample& sample : samples) {
      if (info.format != ChannelFormat::kString) {
        sample.values.assign(take(width), width);
        continue;
      }
      for (std::size_t i = 0; i < num_channels; ++i) {
        std::uint32_t size = 0;
        std::memcpy(&size, take(sizeof size), sizeof size);
        sample.texts.emplace_back(take(size), size);
      }
    }
    if (at_ != plain_.size()) refuse();
    return samples;
  }

 private:
  [[noreturn]] void refuse() const {
    throw Error(place_ + ": expected a block of samples, found it damaged");
  }
  const char* take(std::size_t size) {
    if (plain_.size() - at_ < size) refuse();
    return plain_.data() + std::exchange(at_, at_ + size);
  }

  std::string place_;
  std::string plain_;
  std::size_t at_ = 0;
};

}  // namespace

/// Hashes everything in the file, one text after another.
class SealedText {
 public:
  explicit SealedText(const StreamFileInfo& info) {
    text_ = info.name + "\n" + info.type + "\n" + std::string(name(info.format)) + "\n" +
            std::to_string(info.channel_count) + "\n" + number(info.nominal_rate_hz) + "\n" +
            sha256(info.xml) + "\n";
  }
  void add_block(std::int64_t num_samples, const std::string& hash) {
    text_ += std::to_string(num_samples) + " " + hash + "\n";
  }
  void add_offset(const ClockOffset& offset) {
    offsets_ += number(offset.time_s) + " " + number(offset.offset_s) + " " +
                number(offset.round_trip_s) + "\n";
  }
  [[nodiscard]] std::string hash() const { return sha256(text_ + offsets_); }

 private:
  static std::string number(double value) {
    char text[40];
    std::snprintf(text, sizeof text, "%.17g", value);
    return text;
  }
  std::string text_, offsets_;
};

struct StreamFileWriter::Implementation {
  Implementation(const fs::path& file, const StreamFileInfo& info)
      : database(require_new(file), Database::Mode::kCreate, Durability::kEveryCommit),
        sealed(info) {
    Transaction transaction(database);
    database.execute(kStreamSchema);
    Statement(database, "INSERT INTO stream_format VALUES (?, ?, ?, ?, ?, ?, ?)")
        .bind(kStreamFormat)
        .bind(info.name)
        .bind(info.type)
        .bind(std::string(name(info.format)))
        .bind(static_cast<std::int64_t>(info.channel_count))
        .bind(info.nominal_rate_hz)
        .bind(info.xml)
        .run();
    transaction.commit();
  }

  static const fs::path& require_new(const fs::path& file) {
    if (!fs::exists(file)) return file;
    throw Error(file.string() +
                ": expected to make this file, found that it is there; what "
                "was recorded stays as it is");
  }

  void write() {
    if (is_sealed) {
      throw Error(database.file().string() +
                  ": expected no more samples, found some behind "
                  "its end");
    }
    if (pending.empty() && pending_offsets.empty()) return;
    database.require_in_place();
    Transaction transaction(database);
    if (!pending.empty()) {
      const std::string bytes = encoded(pending);
      const auto count = static_cast<std::int64_t>(pending.size());
      const std::string hash = sha256(bytes);
      Statement(database, "INSERT INTO block (num_samples, sha256, data) VALUES (?, ?, ?)")
          .bind(count)
          .bind(hash)
          .bind_bytes(bytes)
          .run();
      sealed.add_block(count, hash);
      told.num_samples += count;
    }
    for (const ClockOffset& offset : pending_offsets) {
      Statement(database,
                "INSERT INTO clock_offset (time_s, offset_s, round_trip_s) VALUES (?, ?, ?)")
          .bind(offset.time_s)
          .bind(offset.offset_s)
          .bind(offset.round_trip_s)
          .run();
      sealed.add_offset(offset);
      ++told.num_offsets;
    }
    transaction.commit();
    pending.clear();
    pending_offsets.clear();
    num_pending_bytes = 0;
  }

  Database database;
  SealedText sealed;
  StreamFileSeal told;
  bool is_sealed = false;
  std::vector<StreamSample> pending;
  std::size_t num_pending_bytes = 0;
  std::vector<ClockOffset> pending_offsets;
};

StreamFileWriter::StreamFileWriter(const fs::path& file, const StreamFileInfo& info)
    : implementation_(std::make_unique<Implementation>(file, info)) {}

StreamFileWriter::~StreamFileWriter() {
  try {
    if (!implementation_->is_sealed) flush();
  } catch (const std::exception&) {
    // `flush` reports failures. A destructor must not throw.
  }
}

void StreamFileWriter::append(const StreamSample& sample) {
  Implementation& my = *implementation_;
  my.pending.push_back(sample);
  my.num_pending_bytes += sample.values.size();
  for (const std::string& text : sample.texts) my.num_pending_bytes += text.size();
  const bool is_full =
      my.pending.size() >= kMostSamplesOfBlock || my.num_pending_bytes >= kMostBytesOfBlock;
  if (is_full) my.write();
}

void StreamFileWriter::append(const ClockOffset& offset) {
  implementation_->pending_offsets.push_back(offset);
}

void StreamFileWriter::flush() { implementation_->write(); }

StreamFileSeal StreamFileWriter::seal() {
  Implementation& my = *implementation_;
  my.write();
  my.told.sha256 = my.sealed.hash();
  Statement(my.database, "INSERT INTO seal VALUES (?, ?, ?)")
      .bind(my.told.num_samples)
      .bind(my.told.num_offsets)
      .bind(my.told.sha256)
      .run();
  my.is_sealed = true;
  my.database.checkpoint();
  return my.told;
}

struct StreamFileReader::Implementation {
  explicit Implementation(const fs::path& file)
      : database(file, Database::Mode::kReadOnly, Durability::kEveryCommit) {
    if (is_empty(database)) {
      throw Error(file.string() +
                  ": expected a stream, found a file that was being made when "
                  "its program died; it holds nothing");
    }
    Statement format(database,
                     "SELECT version, name, type, channel_format, channel_count, "
                     "nominal_rate_hz, xml FROM stream_format");
    if (!format.step() || format.integer(0) > kStreamFormat) {
      throw Error(file.string() + ": expected a stream of format " +
                  std::to_string(kStreamFormat) + ", found another; open it with a newer jnd");
    }
    info.name = format.text(1);
    info.type = format.text(2);
    const auto known = channel_format_of(format.text(3));
    const std::int64_t count = format.integer(4);
    constexpr std::int64_t kMostChannels = 1 << 16;
    if (!known || count < 1 || count > kMostChannels) {
      throw Error(file.string() + ": expected a stream with channels, found it damaged");
    }
    info.format = *known;
    info.channel_count = static_cast<int>(count);
    info.nominal_rate_hz = format.number(5);
    info.xml = format.text(6);
  }

  std::vector<StreamSample> block(const Statement& row) const {
    const std::string place =
        database.file().string() + ": block " + std::to_string(row.integer(0));
    const std::string_view bytes = row.bytes(3);
    if (sha256(bytes.data(), bytes.size()) != row.text(2)) {
      throw Error(place + ": expected bytes that fit their hash, found them damaged");
    }
    return BlockReader(bytes, place).samples(row.integer(1), info);
  }

  mutable Database database;
  StreamFileInfo info;
};

namespace {
constexpr char kAllBlocks[] =
    "SELECT number, num_samples, sha256, data FROM block ORDER BY number";
}  // namespace

StreamFileReader::StreamFileReader(const fs::path& file)
    : implementation_(std::make_unique<Implementation>(file)) {}

StreamFileReader::~StreamFileReader() = default;

const StreamFileInfo& StreamFileReader::info() const noexcept { return implementation_->info; }

void StreamFileReader::read(const std::function<void(const StreamSample&)>& visit) const {
  Statement rows(implementation_->database, kAllBlocks);
  while (rows.step()) {
    for (const StreamSample& sample : implementation_->block(rows)) visit(sample);
  }
}

std::vector<ClockOffset> StreamFileReader::offsets() const {
  Statement rows(implementation_->database,
                 "SELECT time_s, offset_s, round_trip_s FROM clock_offset ORDER BY number");
  std::vector<ClockOffset> all;
  while (rows.step()) all.push_back({rows.number(0), rows.number(1), rows.number(2)});
  return all;
}

std::optional<StreamFileSeal> StreamFileReader::seal() const {
  Statement row(implementation_->database, "SELECT num_samples, num_offsets, sha256 FROM seal");
  if (!row.step()) return std::nullopt;
  return StreamFileSeal{row.integer(0), row.integer(1), row.text(2)};
}

std::vector<std::string> StreamFileReader::problems() const {
  std::vector<std::string> found;
  SealedText sealed(implementation_->info);
  StreamFileSeal told;
  Statement rows(implementation_->database, kAllBlocks);
  while (rows.step()) {
    try {
      (void)implementation_->block(rows);
    } catch (const Error& error) {
      found.emplace_back(error.what());
    }
    sealed.add_block(rows.integer(1), rows.text(2));
    told.num_samples += rows.integer(1);
  }
  for (const ClockOffset& offset : offsets()) {
    sealed.add_offset(offset);
    ++told.num_offsets;
  }
  told.sha256 = sealed.hash();
  if (const auto kept = seal(); kept && *kept != told) {
    found.push_back(implementation_->database.file().string() +
                    ": expected what it was sealed with, found something added, taken away or "
                    "changed");
  }
  return found;
}

std::vector<fs::path> stream_files(const fs::path& recording_file) {
  const std::string start = recording_file.stem().string() + kStreamMark;
  std::vector<fs::path> files;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(recording_file.parent_path(), error)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with(start) && name.ends_with(".sqlite")) files.push_back(entry.path());
  }
  std::ranges::sort(files);
  return files;
}

fs::path next_stream_file(const fs::path& recording_file) {
  for (int number = 1;; ++number) {
    char digits[16];
    std::snprintf(digits, sizeof digits, "%02d", number);
    fs::path file = recording_file.parent_path() /
                    (recording_file.stem().string() + kStreamMark + digits + ".sqlite");
    if (!fs::exists(file)) return file;
  }
}

fs::path recording_beside(const fs::path& stream_file) {
  const std::string name = stream_file.filename().string();
  const std::size_t mark = name.find(kStreamMark);
  if (mark == std::string::npos || !name.ends_with(".sqlite")) return {};
  return stream_file.parent_path() / (name.substr(0, mark) + ".sqlite");
}

void copy_stream_file(const fs::path& source, const fs::path& target) {
  Database from(source, Database::Mode::kReadOnly, Durability::kEveryCommit);
  Database to(target, fs::exists(target) ? Database::Mode::kReadWrite : Database::Mode::kCreate,
              Durability::kEveryCommit);
  from.copy_to(to);
  to.checkpoint();
}

}  // namespace jnd::core
