#include "analysis/export/hdf5_file.h"

#include <hdf5.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <limits>
#include <string_view>
#include <utility>

#include "core/error.h"

namespace jnd::analysis {
namespace {

static_assert(sizeof(hid_t) == sizeof(std::int64_t));
static_assert(sizeof(herr_t) == sizeof(int));

constexpr unsigned kDeflateLevel = 1;  // Higher levels cost much time and save few bytes.

[[noreturn]] void fail(const std::string& place) {
  const std::string reason = errno == 0 ? "" : std::string(": ") + std::strerror(errno);
  throw core::Error(place + ": expected to write this, found that it cannot be" + reason);
}

void check(herr_t result, const std::string& place) {
  if (result < 0) fail(place);
}

Hdf5Handle handle(hid_t identifier, herr_t (*closing)(hid_t), const std::string& place) {
  if (identifier < 0) fail(place);
  return {identifier, closing};
}

hid_t create_file(const std::string& file) {
  // A file that a full disk cut short cannot be closed, and the library would fail on it at the
  // end of the program. Everything that can be closed is closed here, so the library need not
  // do anything at exit.
  (void)H5dont_atexit();
  // Otherwise the library would print its own stack of errors.
  (void)H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  errno = 0;
  return H5Fcreate(file.c_str(), H5F_ACC_EXCL, H5P_DEFAULT, H5P_DEFAULT);
}

bool is_ascii(std::string_view bytes) {
  return std::ranges::all_of(bytes, [](char byte) { return (byte & 0x80) == 0; });
}

/// The type is ASCII if possible, because Octave does not read a text that is marked as UTF-8.
Hdf5Handle text_type(std::size_t num_bytes, std::string_view bytes, const std::string& place) {
  Hdf5Handle type = handle(H5Tcopy(H5T_C_S1), H5Tclose, place);
  check(H5Tset_size(type.get(), std::max<std::size_t>(num_bytes, 1)), place);
  check(H5Tset_cset(type.get(), is_ascii(bytes) ? H5T_CSET_ASCII : H5T_CSET_UTF8), place);
  check(H5Tset_strpad(type.get(), H5T_STR_NULLPAD), place);
  return type;
}

void write_attribute(const Hdf5Handle& object, const std::string& name, hid_t type,
                     hid_t memory_type, const void* value, const std::string& place) {
  const Hdf5Handle scalar = handle(H5Screate(H5S_SCALAR), H5Sclose, place);
  const Hdf5Handle attribute = handle(
      H5Acreate2(object.get(), name.c_str(), type, scalar.get(), H5P_DEFAULT, H5P_DEFAULT),
      H5Aclose, place);
  check(H5Awrite(attribute.get(), memory_type, value), place);
}

void write_text(const Hdf5Handle& object, const std::string& name, const std::string& text,
                const std::string& place) {
  const Hdf5Handle type = text_type(text.size(), text, place);
  write_attribute(object, name, type.get(), type.get(), text.c_str(), place);
}

hid_t file_type(Hdf5Number type) {
  switch (type) {
    case Hdf5Number::kInt64:
      return H5T_STD_I64LE;
    case Hdf5Number::kUint8:
      return H5T_STD_U8LE;
    case Hdf5Number::kDouble:
      break;
  }
  return H5T_IEEE_F64LE;
}

constexpr std::int32_t kMissingSteps = std::numeric_limits<std::int32_t>::min();

std::int32_t steps_of(double number, double step) {
  if (std::isnan(number)) return kMissingSteps;
  constexpr double kMost = std::numeric_limits<std::int32_t>::max();
  return static_cast<std::int32_t>(std::clamp(std::round(number / step), -kMost, kMost));
}

/// Settings without time stamps, which would make every file different.
Hdf5Handle dataset_settings(const std::string& place) {
  Hdf5Handle settings = handle(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, place);
  check(H5Pset_obj_track_times(settings.get(), false), place);
  return settings;
}

/// Compresses texts, because a column with one long text consists mostly of padding.
void compress_texts(const Hdf5Handle& settings, hsize_t count, std::size_t num_bytes,
                    const std::string& place) {
  constexpr hsize_t kChunkBytes = hsize_t{1} << 20U;
  if (count < 2) return;
  const hsize_t chunk = std::clamp<hsize_t>(kChunkBytes / num_bytes, 1, count);
  check(H5Pset_chunk(settings.get(), 1, &chunk), place);
  check(H5Pset_deflate(settings.get(), kDeflateLevel), place);
}

}  // namespace

Hdf5Handle::~Hdf5Handle() { (void)close(); }

Hdf5Handle::Hdf5Handle(Hdf5Handle&& other) noexcept
    : identifier_(std::exchange(other.identifier_, -1)), close_(other.close_) {}

bool Hdf5Handle::close() noexcept {
  const std::int64_t identifier = std::exchange(identifier_, -1);
  return identifier < 0 || close_(identifier) >= 0;
}

void Hdf5Column::append(const std::vector<double>& numbers) {
  append(numbers.data(), numbers.size(), H5T_NATIVE_DOUBLE);
}

void Hdf5Column::append(const std::vector<std::int64_t>& numbers) {
  append(numbers.data(), numbers.size(), H5T_NATIVE_INT64);
}

void Hdf5Column::append(const void* numbers, std::size_t num_numbers,
                        std::int64_t memory_type) {
  if (num_numbers == 0) return;
  errno = 0;
  const hsize_t first = num_rows_, count = num_numbers;
  num_rows_ += count;
  const hsize_t total = num_rows_;
  check(H5Dset_extent(dataset_.get(), &total), place_);
  const Hdf5Handle in_file = handle(H5Dget_space(dataset_.get()), H5Sclose, place_);
  check(H5Sselect_hyperslab(in_file.get(), H5S_SELECT_SET, &first, nullptr, &count, nullptr),
        place_);
  const Hdf5Handle in_memory = handle(H5Screate_simple(1, &count, nullptr), H5Sclose, place_);
  check(H5Dwrite(dataset_.get(), memory_type, in_memory.get(), in_file.get(), H5P_DEFAULT,
                 numbers),
        place_);
}

Hdf5Array::Hdf5Array(std::string place, Hdf5Handle dataset, std::vector<std::uint64_t> shape,
                     double step)
    : place_(std::move(place)),
      dataset_(std::move(dataset)),
      shape_(std::move(shape)),
      step_(step) {
  for (const std::uint64_t length : shape_) width_ *= length;
  waiting_.resize(width_ * kChunkRows);
}

void Hdf5Array::append(const double* numbers) {
  for (std::size_t i = 0; i < width_; ++i) {
    waiting_[i * kChunkRows + num_waiting_] = steps_of(numbers[i], step_);
  }
  if (++num_waiting_ == kChunkRows) finish();
}

void Hdf5Array::finish() {
  if (num_waiting_ == 0) return;
  errno = 0;
  std::vector<hsize_t> extent(shape_.begin(), shape_.end()), first(shape_.size(), 0),
      count = extent, waiting = extent;
  extent.push_back(num_rows_ + num_waiting_);
  first.push_back(num_rows_);
  count.push_back(num_waiting_);
  waiting.push_back(kChunkRows);
  const int rank = static_cast<int>(extent.size());
  check(H5Dset_extent(dataset_.get(), extent.data()), place_);
  const Hdf5Handle in_file = handle(H5Dget_space(dataset_.get()), H5Sclose, place_);
  check(H5Sselect_hyperslab(in_file.get(), H5S_SELECT_SET, first.data(), nullptr, count.data(),
                            nullptr),
        place_);
  const Hdf5Handle in_memory =
      handle(H5Screate_simple(rank, waiting.data(), nullptr), H5Sclose, place_);
  const std::vector<hsize_t> from(waiting.size(), 0);
  check(H5Sselect_hyperslab(in_memory.get(), H5S_SELECT_SET, from.data(), nullptr, count.data(),
                            nullptr),
        place_);
  check(H5Dwrite(dataset_.get(), H5T_NATIVE_INT32, in_memory.get(), in_file.get(), H5P_DEFAULT,
                 waiting_.data()),
        place_);
  num_rows_ += num_waiting_;
  num_waiting_ = 0;
}

Hdf5Group Hdf5Group::group(const std::string& name) const {
  const std::string place = place_ + "/" + name;
  errno = 0;
  const Hdf5Handle settings = handle(H5Pcreate(H5P_GROUP_CREATE), H5Pclose, place);
  check(H5Pset_obj_track_times(settings.get(), false), place);
  return {place, handle(H5Gcreate2(handle_.get(), name.c_str(), H5P_DEFAULT, settings.get(),
                                   H5P_DEFAULT),
                        H5Gclose, place)};
}

void Hdf5Group::attribute(const std::string& name, const std::string& text) const {
  write_text(handle_, name, text, place_);
}

void Hdf5Group::attribute(const std::string& name, double number) const {
  write_attribute(handle_, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, &number, place_);
}

void Hdf5Group::attribute(const std::string& name, std::int64_t number) const {
  write_attribute(handle_, name, H5T_STD_I64LE, H5T_NATIVE_INT64, &number, place_);
}

Hdf5Column Hdf5Group::column(const std::string& name, Hdf5Number type, const std::string& unit,
                             const std::string& meaning) const {
  const std::string place = place_ + "/" + name;
  errno = 0;
  const hsize_t none = 0, without_end = H5S_UNLIMITED, chunk = Hdf5Column::kChunkRows;
  const Hdf5Handle settings = dataset_settings(place);
  check(H5Pset_chunk(settings.get(), 1, &chunk), place);
  check(H5Pset_shuffle(settings.get()), place);
  check(H5Pset_deflate(settings.get(), kDeflateLevel), place);
  const Hdf5Handle space = handle(H5Screate_simple(1, &none, &without_end), H5Sclose, place);
  Hdf5Handle dataset = handle(H5Dcreate2(handle_.get(), name.c_str(), file_type(type),
                                         space.get(), H5P_DEFAULT, settings.get(), H5P_DEFAULT),
                              H5Dclose, place);
  if (!unit.empty()) write_text(dataset, "unit", unit, place);
  write_text(dataset, "meaning", meaning, place);
  return {place, std::move(dataset)};
}

Hdf5Array Hdf5Group::array(const Hdf5ArrayOptions& options) const {
  const std::string place = place_ + "/" + options.name;
  errno = 0;
  std::vector<hsize_t> none, without_end, chunk;
  std::string dimensions;
  for (std::size_t i = 0; i < options.parts.size(); ++i) {
    const hsize_t length = options.parts[i].size();
    for (auto* dimension : {&none, &without_end, &chunk}) dimension->push_back(length);
    dimensions += options.dimensions.at(i) + " ";
  }
  std::vector<std::uint64_t> shape(none.begin(), none.end());
  none.push_back(0);
  without_end.push_back(H5S_UNLIMITED);
  chunk.push_back(Hdf5Array::kChunkRows);
  const int rank = static_cast<int>(none.size());
  const Hdf5Handle settings = dataset_settings(place);
  check(H5Pset_chunk(settings.get(), rank, chunk.data()), place);
  check(H5Pset_fill_value(settings.get(), H5T_NATIVE_INT32, &kMissingSteps), place);
  check(H5Pset_shuffle(settings.get()), place);
  check(H5Pset_deflate(settings.get(), kDeflateLevel), place);
  const Hdf5Handle space =
      handle(H5Screate_simple(rank, none.data(), without_end.data()), H5Sclose, place);
  Hdf5Handle dataset = handle(H5Dcreate2(handle_.get(), options.name.c_str(), H5T_STD_I32LE,
                                         space.get(), H5P_DEFAULT, settings.get(), H5P_DEFAULT),
                              H5Dclose, place);
  if (!options.unit.empty()) write_text(dataset, "unit", options.unit, place);
  write_text(dataset, "meaning", options.meaning, place);
  write_text(dataset, "dimensions", dimensions + "tick", place);
  for (std::size_t i = 0; i < options.parts.size(); ++i) {
    std::string names;
    for (const std::string& part : options.parts[i]) names += (names.empty() ? "" : " ") + part;
    write_text(dataset, options.dimensions[i] + "_names", names, place);
  }
  write_attribute(dataset, "scale_factor", H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, &options.step,
                  place);
  write_attribute(dataset, "_FillValue", H5T_STD_I32LE, H5T_NATIVE_INT32, &kMissingSteps,
                  place);
  return {place, std::move(dataset), std::move(shape), options.step};
}

void Hdf5Group::texts(const std::string& name, const std::vector<std::string>& texts,
                      const std::string& meaning) const {
  const std::string place = place_ + "/" + name;
  errno = 0;
  std::size_t longest = 1;
  for (const std::string& text : texts) longest = std::max(longest, text.size());
  std::string bytes;
  for (const std::string& text : texts) {
    bytes += text;
    bytes.append(longest - text.size(), '\0');
  }
  const Hdf5Handle type = text_type(longest, bytes, place);
  const hsize_t count = texts.size();
  const Hdf5Handle space = handle(H5Screate_simple(1, &count, nullptr), H5Sclose, place);
  const Hdf5Handle settings = dataset_settings(place);
  compress_texts(settings, count, longest, place);
  const Hdf5Handle dataset =
      handle(H5Dcreate2(handle_.get(), name.c_str(), type.get(), space.get(), H5P_DEFAULT,
                        settings.get(), H5P_DEFAULT),
             H5Dclose, place);
  if (!texts.empty()) {
    check(H5Dwrite(dataset.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data()),
          place);
  }
  write_text(dataset, "meaning", meaning, place);
}

Hdf5File::Hdf5File(const std::filesystem::path& file)
    : place_(file.string()),
      file_(handle(create_file(place_), H5Fclose, place_)),
      root_(place_, handle(H5Gopen2(file_.get(), "/", H5P_DEFAULT), H5Gclose, place_)) {}

void Hdf5File::finish() {
  errno = 0;
  const bool written = H5Fflush(file_.get(), H5F_SCOPE_GLOBAL) >= 0;
  const int reason = errno;
  if (root_.handle_.close() && file_.close() && written) return;
  if (reason != 0) errno = reason;
  fail(place_);
}

}  // namespace jnd::analysis
