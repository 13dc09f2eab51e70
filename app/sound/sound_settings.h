#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>

namespace jnd::app {

/// Stands for an output's name and means that nothing is played.
inline constexpr char kSoundOff[] = "off";

/// How loud an output is, as a laboratory has measured it at the ear of its headphones.
struct SoundCalibration {
  std::string output;  ///< The output's name, such as "default".
  /// The level of a sine of full scale, re 20 uPa.
  double full_scale_db_spl = 0.0;
  std::string measured_on;  ///< Such as "2026-11-26".
};

/// What this machine knows about its sound: which output is used, and how loud each one is. It
/// is one small file, in which calibrations are only added; the last one of an output counts.
/// Not real time.
class SoundSettings {
 public:
  /// The file in JND_SOUND_FILE; or else sound.json in XDG_CONFIG_HOME/jnd, or in
  /// ~/.config/jnd; "" if there is no home folder.
  [[nodiscard]] static std::filesystem::path default_file();
  /// Reads nothing yet.
  explicit SoundSettings(std::filesystem::path file = default_file())
      : file_(std::move(file)) {}

  /// The output that sessions use if nobody names one: the one that was last chosen here, or
  /// "default". Throws `Error` if the file exists but cannot be read.
  [[nodiscard]] std::string output() const;
  /// The calibration of an output; none if it is not calibrated. Throws as `output` does.
  [[nodiscard]] std::optional<SoundCalibration> calibration_of(const std::string& output) const;

  /// The choice is on disk when this returns. Throws `Error`.
  void choose(const std::string& output) const;
  void add(const SoundCalibration& calibration) const;

  [[nodiscard]] const std::filesystem::path& file() const noexcept { return file_; }

 private:
  std::filesystem::path file_;
};

}  // namespace jnd::app
