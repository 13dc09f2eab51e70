#include "experiments/device_profile/profile_reader.h"

#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "experiments/device_profile/device_profile_table.h"
#include "experiments/device_profile/profile_fields.h"
#include "experiments/device_profile/profile_rules.h"
#include "experiments/protocol/checked_file.h"
#include "experiments/protocol/located_json.h"
#include "experiments/protocol/structure_check.h"

namespace jnd::experiments {
namespace {

using nlohmann::json;

constexpr const char* kProfileKind = "device profile";

// These functions read each kind of field from JSON that has passed the checks.

template <class T>
requires std::is_arithmetic_v<T> || std::same_as<T, std::string>
void take(const json& value, T& field) { field = value.get<T>(); }

template <std::size_t N>
void take(const json& value, std::array<double, N>& field) {
  for (std::size_t i = 0; i < N; ++i) field[i] = value.at(i).get<double>();
}

template <class T>
requires(std::is_class_v<T> && !std::same_as<T, std::string>) void take(const json& value,
                                                                        T& field);

template <class T>
void take(const json& value, std::optional<T>& field) {
  take(value, field.emplace());
}

template <class T>
void take(const json& value, std::vector<T>& field) {
  for (const json& one : value) take(one, field.emplace_back());
}

template <class T>
requires(std::is_class_v<T> && !std::same_as<T, std::string>) void take(const json& value,
                                                                        T& field) {
  each_field(field, [&value](const char* key, auto& inner) {
    if (const auto found = value.find(key); found != value.end()) take(*found, inner);
  });
}

std::optional<LocatedJson> checked_profile(const std::string& text,
                                           const std::string& file_name,
                                           std::vector<StudyProblem>& problems) {
  if (!is_of_a_size(text, file_name, kProfileKind, problems)) return std::nullopt;
  LocatedJson file(text, file_name, problems);
  if (file.usable()) {
    StructureCheck(file, problems, device_profile_tables()).run();
    if (problems.empty()) check_profile_rules(file, problems);
  }
  arrange(problems, file_name);
  return file;
}

}  // namespace

DeviceProfile read_device_profile_text(const std::string& text, const std::string& file_name) {
  std::vector<StudyProblem> problems;
  const std::optional<LocatedJson> file = checked_profile(text, file_name, problems);
  if (!problems.empty()) throw ProtocolError(std::move(problems));
  DeviceProfile profile;
  take(file->root(), profile);
  return profile;
}

DeviceProfile read_device_profile(const std::filesystem::path& file) {
  std::vector<StudyProblem> problems;
  const std::optional<std::string> text = text_of_file(file, kProfileKind, problems);
  if (!text) throw ProtocolError(std::move(problems));
  return read_device_profile_text(*text, file.string());
}

std::vector<StudyProblem> device_profile_text_problems(const std::string& text,
                                                       const std::string& file_name) {
  std::vector<StudyProblem> problems;
  static_cast<void>(checked_profile(text, file_name, problems));
  return problems;
}

std::vector<StudyProblem> device_profile_problems(const std::filesystem::path& file) {
  std::vector<StudyProblem> problems;
  const std::optional<std::string> text = text_of_file(file, kProfileKind, problems);
  return text ? device_profile_text_problems(*text, file.string()) : problems;
}

}  // namespace jnd::experiments
