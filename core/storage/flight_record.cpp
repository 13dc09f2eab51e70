#include "core/storage/flight_record.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>
#include <fstream>

#include "core/error.h"
#include "core/sample_table.h"
#include "core/storage/files.h"

namespace jnd::core {
namespace {

namespace fs = std::filesystem;

constexpr const char* kMark = ".fault-";

/// Returns the shortest text that gives this number again, in any locale.
std::string text_of(double value) {
  std::array<char, 32> text;
  char* const end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  return {text.data(), end};
}

fs::path file_for(const fs::path& recording_file, std::int64_t tick) {
  std::array<char, 32> number;
  std::snprintf(number.data(), number.size(), "%09lld", static_cast<long long>(tick));
  return recording_file.parent_path() /
         (recording_file.stem().string() + kMark + number.data() + ".csv");
}

template <typename Cells>
void put_line(std::string& table, const Cells& cells) {
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (i > 0) table += ',';
    if constexpr (std::is_same_v<typename Cells::value_type, double>) {
      table += text_of(cells[i]);
    } else {
      table += cells[i];
    }
  }
  table += '\n';
}

}  // namespace

fs::path write_flight_record(const fs::path& recording_file,
                             const std::vector<Sample>& samples) {
  const SampleColumns columns{
      .times = std::ranges::any_of(samples, has_times),
      .joints = std::ranges::any_of(samples, has_joints),
      .channels = samples.empty() ? ChannelBits{0} : samples.front().channels.bits};
  std::string table;
  put_line(table, sample_column_names(columns));
  for (const Sample& sample : samples) put_line(table, sample_values(sample, columns));

  fs::path file = file_for(recording_file, samples.back().tick);
  if (fs::exists(file)) return file;
  fs::path unfinished = file;
  unfinished += ".unfinished";
  try {
    make_private_file(unfinished);
    std::ofstream(unfinished, std::ios::binary | std::ios::trunc) << table;
    // A full disk shows here, because the stream has been closed.
    if (fs::file_size(unfinished) != table.size()) {
      throw Error(file.string() + ": expected room for " + std::to_string(table.size()) +
                  " bytes, found " + std::to_string(fs::file_size(unfinished)) + " written");
    }
    sync_file(unfinished);
    fs::rename(unfinished, file);
    sync_folder(file.parent_path());
  } catch (const std::exception& failure) {
    std::error_code ignored;
    fs::remove(unfinished, ignored);
    throw Error(file.string() +
                ": expected to keep the last second before a fault, found: " + failure.what());
  }
  return file;
}

std::vector<fs::path> flight_records(const fs::path& recording_file) {
  const std::string start = recording_file.stem().string() + kMark;
  std::vector<fs::path> files;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(recording_file.parent_path(), error)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with(start)) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace jnd::core
