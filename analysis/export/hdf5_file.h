#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace jnd::analysis {

/// Owns an hid_t of `hdf5.h` and closes it. Only these files should use it.
class Hdf5Handle {
 public:
  using Close = int (*)(std::int64_t);
  Hdf5Handle(std::int64_t identifier, Close closing)
      : identifier_(identifier), close_(closing) {}
  ~Hdf5Handle();
  Hdf5Handle(Hdf5Handle&& other) noexcept;
  Hdf5Handle& operator=(Hdf5Handle&&) = delete;
  [[nodiscard]] std::int64_t get() const noexcept { return identifier_; }
  /// Returns false if pending data could not be written.
  [[nodiscard]] bool close() noexcept;

 private:
  std::int64_t identifier_;
  Close close_;
};

enum class Hdf5Number { kDouble, kInt64, kUint8 };

/// A growing column of numbers, in chunks of `kChunkRows` that are shuffled and deflated.
class Hdf5Column {
 public:
  static constexpr std::size_t kChunkRows = 16384;

  /// Missing values are NaN. Throws `Error`.
  void append(const std::vector<double>& numbers);
  void append(const std::vector<std::int64_t>& numbers);

 private:
  friend class Hdf5Group;
  Hdf5Column(std::string place, Hdf5Handle dataset)
      : place_(std::move(place)), dataset_(std::move(dataset)) {}

  void append(const void* numbers, std::size_t num_numbers, std::int64_t memory_type);

  std::string place_;
  Hdf5Handle dataset_;
  std::uint64_t num_rows_ = 0;
};

/// How an array of numbers is described and stored: as whole steps, which need an eighth of the
/// space of doubles.
struct Hdf5ArrayOptions {
  std::string name, unit, meaning;
  /// The names along the dimensions before time, such as {"palm_inner", ...}, {"x", "y", "z"}.
  std::vector<std::vector<std::string>> parts;
  /// What these dimensions are, such as "point" and "axis".
  std::vector<std::string> dimensions;
  double step = 1.0;  ///< A number is its stored step times this.
};

/// An array of 32-bit steps that grows along its last dimension, time: parts x ... x time. Its
/// attributes scale_factor and _FillValue follow the CF conventions, which xarray and other
/// programs apply automatically.
class Hdf5Array {
 public:
  static constexpr std::size_t kChunkRows = 2048;

  /// The number of values at one time.
  [[nodiscard]] std::size_t width() const noexcept { return width_; }
  /// Appends the `width` numbers of one time, with the last part varying fastest. NaN means
  /// missing. A value beyond 32 bits is stored as the largest one. Throws `Error`.
  void append(const double* numbers);
  /// Must be called once at the end. Throws `Error`.
  void finish();

 private:
  friend class Hdf5Group;
  Hdf5Array(std::string place, Hdf5Handle dataset, std::vector<std::uint64_t> shape,
            double step);

  std::string place_;
  Hdf5Handle dataset_;
  std::vector<std::uint64_t> shape_;  ///< Without the dimension of time.
  double step_;
  std::size_t width_ = 1, num_waiting_ = 0;
  std::vector<std::int32_t> waiting_;  ///< width x kChunkRows
  std::uint64_t num_rows_ = 0;
};

/// A group of an HDF5 file, with attributes of text and numbers. All functions throw `Error`
/// that names file and object. Not real time.
class Hdf5Group {
 public:
  [[nodiscard]] Hdf5Group group(const std::string& name) const;
  void attribute(const std::string& name, const std::string& text) const;
  void attribute(const std::string& name, double number) const;
  void attribute(const std::string& name, std::int64_t number) const;

  /// The dataset has the attributes `unit`, if there is one, and `meaning`.
  [[nodiscard]] Hdf5Column column(const std::string& name, Hdf5Number type,
                                  const std::string& unit, const std::string& meaning) const;
  /// The dataset has the attributes `unit`, `meaning`, `dimensions`, the names along each
  /// dimension except time, `scale_factor` and `_FillValue`.
  [[nodiscard]] Hdf5Array array(const Hdf5ArrayOptions& options) const;
  /// Writes a whole column of texts of one length, padded with zeros. They are ASCII, which
  /// every program reads, or UTF-8 if a text needs it. The dataset has the attribute `meaning`.
  void texts(const std::string& name, const std::vector<std::string>& texts,
             const std::string& meaning) const;

 private:
  friend class Hdf5File;
  Hdf5Group(std::string place, Hdf5Handle handle)
      : place_(std::move(place)), handle_(std::move(handle)) {}

  std::string place_;
  Hdf5Handle handle_;
};

/// A new HDF5 file that every library since 1.8 can read: plain numbers and texts, and no time
/// stamps, so that the same content gives the same bytes. Throws `Error`. Not thread-safe.
class Hdf5File {
 public:
  explicit Hdf5File(const std::filesystem::path& file);
  [[nodiscard]] const Hdf5Group& root() const noexcept { return root_; }
  /// Completes the file. All groups and columns must be destroyed before. Throws `Error` if
  /// something was not written.
  void finish();

 private:
  std::string place_;
  Hdf5Handle file_;
  Hdf5Group root_;
};

}  // namespace jnd::analysis
