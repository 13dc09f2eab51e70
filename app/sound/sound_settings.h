#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>

namespace jnd::app {

/// In place of an output's name: nothing is played.
inline constexpr char kSoundOff[] = "off";

/// How loud an output is, as a laboratory has measured it at the ear of its headphones.
struct SoundCalibration {
  std::string output;              ///< Its name: "default".
  double full_scale_db_spl = 0.0;  ///< What a sine of full scale comes to, re 20 uPa.
  std::string measured_on;         ///< "2026-11-26"
};

/// What this machine knows of its sound: which output is used, and how loud each is. One small
/// file, in which calibrations are only added; the last one of an output counts. Not real time.
class SoundSettings {
 public:
  /// JND_SOUND_FILE, else sound.json in XDG_CONFIG_HOME/jnd, else in ~/.config/jnd; "" without
  /// a home.
  [[nodiscard]] static std::filesystem::path default_file();
  /// Nothing is read yet.
  explicit SoundSettings(std::filesystem::path file = default_file())
      : file_(std::move(file)) {}

  /// The output that sessions use where nobody names one: that which was chosen here last, else
  /// "default". Throws `Error` for a file that is there and cannot be read.
  [[nodiscard]] std::string output() const;
  /// Of an output; none where it is not calibrated. Throws likewise.
  [[nodiscard]] std::optional<SoundCalibration> calibration_of(const std::string& output) const;

  /// On disk when it returns. Throws `Error`.
  void choose(const std::string& output) const;
  void add(const SoundCalibration& calibration) const;

  [[nodiscard]] const std::filesystem::path& file() const noexcept { return file_; }

 private:
  std::filesystem::path file_;
};

}  // namespace jnd::app
