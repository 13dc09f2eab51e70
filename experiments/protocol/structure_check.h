#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "experiments/protocol/study_check.h"
#include "experiments/study/parameter_table.h"

namespace jnd::experiments {

/// Checks a file against its parameter tables: unknown and missing keys, keys that do not
/// belong together, types, ranges, allowed words, and every text in every language. Nothing is
/// coerced: 5.0 is not a whole number and "5" is not a number. Not real time.
class StructureCheck : StudyCheck {
 public:
  /// `tables`: those of this kind of file, that of the whole file first.
  StructureCheck(const LocatedJson& file, std::vector<StudyProblem>& problems,
                 std::vector<const ParameterTable*> tables)
      : StudyCheck(file, problems), tables_(std::move(tables)) {}
  /// Of a study.
  StructureCheck(const LocatedJson& file, std::vector<StudyProblem>& problems);

  void run();

 private:
  void check_object(const nlohmann::json& object, const std::string& pointer,
                    const ParameterTable& table);
  void check_keys(const nlohmann::json& object, const std::string& pointer,
                  const ParameterTable& table);
  void check_value(const nlohmann::json& value, const std::string& pointer,
                   const Parameter& parameter);
  void check_string(const nlohmann::json& value, const std::string& pointer,
                    const Parameter& parameter);
  void check_number(const nlohmann::json& value, const std::string& pointer,
                    const Parameter& parameter);
  void check_date(const nlohmann::json& value, const std::string& pointer,
                  const Parameter& parameter);
  void check_measured(const nlohmann::json& value, const std::string& pointer,
                      const Parameter& parameter);
  void check_text(const nlohmann::json& value, const std::string& pointer);
  void check_list(const nlohmann::json& list, const std::string& pointer,
                  const Parameter& parameter);
  /// `allowed`: the kinds that may stand there; none: any.
  void check_stage(const nlohmann::json& stage, const std::string& pointer,
                   const std::vector<std::string>& allowed);
  void check_arms(const nlohmann::json& arms, const std::string& pointer);
  void check_weights(const nlohmann::json& weights, const std::string& pointer);
  void read_languages();

  [[nodiscard]] const ParameterTable& whole_file() const { return *tables_.front(); }
  [[nodiscard]] std::string file_hint(const nlohmann::json& value) const;
  [[nodiscard]] std::string home_hint(const std::string& key) const;
  void report_key(const std::string& pointer, std::string message);

  std::vector<const ParameterTable*> tables_;
  std::vector<std::string> languages_;  ///< Empty where the file does not say them rightly.
};

/// A value as it is told to the author: "-1.5", "the text "x"", "a list of 3", "an object".
[[nodiscard]] std::string found_words(const nlohmann::json& value);

/// [a-z0-9_], 1 to 64 of them: a name is also that of a folder and stands in every row.
[[nodiscard]] bool is_name(std::string_view text) noexcept;

}  // namespace jnd::experiments
