#include "analysis/export/csv_table_writer.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <system_error>
#include <utility>

#include "core/error.h"

namespace jnd::analysis {
namespace {

constexpr std::size_t kBufferBytes = 1U << 16U;
constexpr std::array<std::int64_t, 10> kPowerOfTen = {
    1, 10, 100, 1000, 10000, 100000, 1000000, 10000000, 100000000, 1000000000};

std::vector<std::string> names_of(const std::vector<CsvColumn>& columns) {
  std::vector<std::string> names;
  for (const CsvColumn& column : columns) names.emplace_back(column.name);
  return names;
}

bool needs_quotes(std::string_view text) {
  return std::ranges::any_of(text, [](char letter) {
    return letter == ',' || letter == '"' || letter == '\n' || letter == '\r';
  });
}

/// Whether the whole text is a number, such as "-3.2", "+4" or "-1e-6".
bool is_number_text(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double number = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size() && std::isfinite(number);
}

/// Whether a spreadsheet would run the text, or whether an initial apostrophe of the text would
/// be mistaken for a protecting one.
bool needs_apostrophe(std::string_view text) {
  constexpr std::string_view kBeginsFormula = "=+-@\t\r";
  const std::size_t first = text.find_first_not_of('\'');
  if (first == std::string_view::npos) return false;
  if (kBeginsFormula.find(text[first]) == std::string_view::npos) return false;
  return !is_number_text(text);
}

}  // namespace

CsvTableWriter::CsvTableWriter(std::filesystem::path file,
                               const std::vector<CsvColumn>& columns, TableStyle style)
    : CsvTableWriter(std::move(file), names_of(columns), style) {}

CsvTableWriter::CsvTableWriter(std::filesystem::path file,
                               const std::vector<std::string>& names, TableStyle style)
    : file_(std::move(file)), style_(style), num_columns_(names.size()) {
  stream_.reset(std::fopen(file_.c_str(), "wb"));
  if (!stream_) fail(errno);
  std::setvbuf(stream_.get(), nullptr, _IONBF, 0);  // `buffer_` serves as the buffer.
  buffer_.reserve(2 * kBufferBytes);
  if (style == TableStyle::kBidsWithoutNames) return;
  for (const std::string& name : names) cell(name);
  end_row();
}

void CsvTableWriter::put_text(std::string_view text) {
  if (needs_apostrophe(text)) return put_plain_text("'" + std::string(text));
  put_plain_text(text);
}

void CsvTableWriter::put_plain_text(std::string_view text) {
  if (style_ == TableStyle::kCsv) {
    return needs_quotes(text) ? put_quoted(text) : put(text);
  }
  if (text.empty()) return put_nothing();
  std::string plain(text);
  for (char& letter : plain) {
    if (letter == '\t' || letter == '\n' || letter == '\r') letter = ' ';
  }
  put(plain);
}

void CsvTableWriter::put_count(std::int64_t number) {
  char digits[24];
  char* const end = std::to_chars(digits, digits + sizeof digits, number).ptr;
  put({digits, static_cast<std::size_t>(end - digits)});
}

void CsvTableWriter::put_real(double number) {
  if (!std::isfinite(number)) return put_nothing();
  char digits[32];
  char* const end = std::to_chars(digits, digits + sizeof digits, number).ptr;
  put({digits, static_cast<std::size_t>(end - digits)});
}

CsvTableWriter& CsvTableWriter::fixed_cell(double number, int decimals, double tolerance) {
  const std::int64_t unit = kPowerOfTen.at(static_cast<std::size_t>(decimals));
  const double multiple = number * static_cast<double>(unit);
  // This is also false for NaN. A value off the grid by more than rounding is written with all
  // digits.
  if (!(std::abs(multiple) < 1e15) || std::abs(multiple - std::round(multiple)) > tolerance) {
    put_real(number);
    return *this;
  }
  const std::int64_t whole = std::llround(multiple);
  const std::int64_t magnitude = whole < 0 ? -whole : whole;
  char digits[32];
  char* end = digits;
  if (whole < 0) *end++ = '-';
  end = std::to_chars(end, digits + sizeof digits, magnitude / unit).ptr;
  std::int64_t rest = magnitude % unit;
  if (rest != 0) *end++ = '.';
  for (std::int64_t place = unit / 10; rest != 0; place /= 10) {
    *end++ = static_cast<char>('0' + rest / place);
    rest %= place;
  }
  put({digits, static_cast<std::size_t>(end - digits)});
  return *this;
}

void CsvTableWriter::put_nothing() { put(style_ == TableStyle::kCsv ? "" : "n/a"); }

void CsvTableWriter::put_quoted(std::string_view text) {
  put("\"");
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('"', at), text.size() - 1) + 1;
    buffer_ += text.substr(at, end - at);
    if (text[end - 1] == '"') buffer_ += '"';
    at = end;
  }
  buffer_ += '"';
}

void CsvTableWriter::put(std::string_view text) {
  if (num_cells_++ > 0) buffer_ += style_ == TableStyle::kCsv ? ',' : '\t';
  buffer_ += text;
}

void CsvTableWriter::end_row() {
  if (num_cells_ != num_columns_) {
    throw core::Error(file_.string() + ": expected " + std::to_string(num_columns_) +
                      " cells in a row, found " + std::to_string(num_cells_));
  }
  buffer_ += '\n';
  num_cells_ = 0;
  if (buffer_.size() >= kBufferBytes) flush();
}

void CsvTableWriter::flush() {
  errno = 0;
  if (std::fwrite(buffer_.data(), 1, buffer_.size(), stream_.get()) != buffer_.size()) {
    fail(errno);
  }
  buffer_.clear();
}

void CsvTableWriter::finish() {
  flush();
  // Some file systems report a full disk only here.
  if (std::fclose(stream_.release()) != 0) fail(errno);
}

void CsvTableWriter::fail(int reason) const {
  throw core::Error(
      file_.string() +
      ": expected to write this file, found that it cannot be: " + std::strerror(reason));
}

}  // namespace jnd::analysis
