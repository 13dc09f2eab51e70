#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace jnd::analysis {

/// What `hdf5.h` calls hid_t, closed when it goes. Not for use outside of these files.
class Hdf5Handle {
 public:
  using Close = int (*)(std::int64_t);
  Hdf5Handle(std::int64_t identifier, Close closing)
      : identifier_(identifier), close_(closing) {}
  ~Hdf5Handle();
  Hdf5Handle(Hdf5Handle&& other) noexcept;
  Hdf5Handle& operator=(Hdf5Handle&&) = delete;
  [[nodiscard]] std::int64_t get() const noexcept { return identifier_; }
  /// False if what was still to be written could not be.
  [[nodiscard]] bool close() noexcept;

 private:
  std::int64_t identifier_;
  Close close_;
};

enum class Hdf5Number { kDouble, kInt64, kUint8 };

/// A column of numbers that grows: chunks of `kChunkRows`, shuffled and deflated.
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

/// How an array of numbers is told and stored: as whole steps, which take an eighth of the room
/// of doubles.
struct Hdf5ArrayOptions {
  std::string name, unit, meaning;
  /// Names along the dimensions before that of time, as {"palm_inner", ...}, {"x", "y", "z"}.
  std::vector<std::vector<std::string>> parts;
  std::vector<std::string> dimensions;  ///< What these are: "point", "axis".
  double step = 1.0;                    ///< The number is this times what is stored.
};

/// An array of 32-bit steps that grows along its last dimension, time: parts x ... x time. The
/// attributes scale_factor and _FillValue are those of the CF conventions, which xarray and
/// others apply by themselves.
class Hdf5Array {
 public:
  static constexpr std::size_t kChunkRows = 2048;

  /// How many numbers one moment has.
  [[nodiscard]] std::size_t width() const noexcept { return width_; }
  /// The numbers of one moment, `width` of them, the last part fastest. NaN: missing; what is
  /// beyond 32 bits is stored as the largest. Throws `Error`.
  void append(const double* numbers);
  /// Has to be called once at the end. Throws `Error`.
  void finish();

 private:
  friend class Hdf5Group;
  Hdf5Array(std::string place, Hdf5Handle dataset, std::vector<std::uint64_t> shape,
            double step);

  std::string place_;
  Hdf5Handle dataset_;
  std::vector<std::uint64_t> shape_;  ///< Without time.
  double step_;
  std::size_t width_ = 1, num_waiting_ = 0;
  std::vector<std::int32_t> waiting_;  ///< width x kChunkRows
  std::uint64_t num_rows_ = 0;
};

/// A group of an HDF5 file, with attributes of text and numbers. All throw `Error` naming file
/// and object. Not real time.
class Hdf5Group {
 public:
  [[nodiscard]] Hdf5Group group(const std::string& name) const;
  void attribute(const std::string& name, const std::string& text) const;
  void attribute(const std::string& name, double number) const;
  void attribute(const std::string& name, std::int64_t number) const;

  /// With the attributes `unit`, if it has one, and `meaning`.
  [[nodiscard]] Hdf5Column column(const std::string& name, Hdf5Number type,
                                  const std::string& unit, const std::string& meaning) const;
  /// With the attributes `unit`, `meaning`, `dimensions`, the names of each dimension but time,
  /// `scale_factor` and `_FillValue`.
  [[nodiscard]] Hdf5Array array(const Hdf5ArrayOptions& options) const;
  /// A whole column of texts of one length, padded with zeros: ASCII, which every program
  /// reads, or UTF-8 where a text has more. With the attribute `meaning`.
  void texts(const std::string& name, const std::vector<std::string>& texts,
             const std::string& meaning) const;

 private:
  friend class Hdf5File;
  Hdf5Group(std::string place, Hdf5Handle handle)
      : place_(std::move(place)), handle_(std::move(handle)) {}

  std::string place_;
  Hdf5Handle handle_;
};

/// A new HDF5 file that any library since 1.8 reads: plain numbers and texts, no time stamps,
/// so that the same content gives the same bytes. Throws `Error`. Not thread-safe.
class Hdf5File {
 public:
  explicit Hdf5File(const std::filesystem::path& file);
  [[nodiscard]] const Hdf5Group& root() const noexcept { return root_; }
  /// Everything is in the file; groups and columns have to be gone. Throws `Error` if it is
  /// not.
  void finish();

 private:
  std::string place_;
  Hdf5Handle file_;
  Hdf5Group root_;
};

}  // namespace jnd::analysis
