#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "experiments/protocol/study_check.h"
#include "experiments/study/parameter_table.h"

namespace jnd::experiments {

/// Checks a file against its parameter tables: unknown and missing keys, keys that do not
/// belong together, types, ranges, allowed words, and every text in every language. Values are
/// never converted: 5.0 is no integer and "5" is no number. Not real time.
class StructureCheck : StudyCheck {
 public:
  /// `tables` are those of this kind of file. The first is that of the whole file.
  StructureCheck(const LocatedJson& file, std::vector<StudyProblem>& problems,
                 std::vector<const ParameterTable*> tables)
      : StudyCheck(file, problems), tables_(std::move(tables)) {}
  /// Checks a study.
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
  /// `allowed` are the kinds of stages that may stand there; empty allows any.
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
  std::vector<std::string> languages_;  ///< Empty if the file does not state them correctly.
};

/// Returns words for a value in a message to the author: "-1.5", "the text "x"", "a list of 3",
/// "an object".
[[nodiscard]] std::string found_words(const nlohmann::json& value);

/// Whether the text consists of 1 to 64 letters of [a-z0-9_]. A name is also the name of a
/// folder and stands in every row.
[[nodiscard]] bool is_name(std::string_view text) noexcept;

}  // namespace jnd::experiments
