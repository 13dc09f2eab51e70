#include "experiments/protocol/reference_writer.h"

#include <algorithm>
#include <limits>
#include <set>
#include <vector>

#include "experiments/protocol/block_examples.h"
#include "experiments/protocol/reference_introduction.h"
#include "experiments/protocol/study_table.h"
#include "experiments/protocol/written_data.h"
#include "experiments/study/media.h"
#include "experiments/study/parameter_table.h"

namespace jnd::experiments {
namespace {

/// The key by whose words the keys of a block are divided into those of each procedure.
constexpr const char* kDivider = "procedure";

/// Returns a cell of a table, without line ends and with escaped bars.
std::string cell(const std::string& text) {
  std::string shown;
  for (const char c : text) {
    if (c == '|') shown += '\\';
    shown += c == '\n' ? ' ' : c;
  }
  return shown;
}

std::string row(const std::vector<std::string>& cells) {
  std::string line = "|";
  for (const std::string& one : cells)
    line += (one.empty() ? " " : ' ' + cell(one) + ' ') + '|';
  return line + '\n';
}

std::string heading_row(const std::vector<std::string>& names) {
  return row(names) + row(std::vector<std::string>(names.size(), "---"));
}

std::string counted(const Parameter& parameter, const std::string& what) {
  return "list of " + item_count(parameter) + what;
}

std::string link_to(const ParameterTable& table) {
  return "[" + table.name + "](#" + table.name + ")";
}

std::string type_words(const Parameter& parameter) {
  switch (parameter.kind) {
    case ValueKind::kString:
      if (parameter.allowed.size() == 1) return '`' + parameter.allowed.front() + '`';
      return parameter.allowed.empty() ? "words" : "one of several words";
    case ValueKind::kName:
      return "name";
    case ValueKind::kText:
      return "text in every language";
    case ValueKind::kNumber:
      return "number";
    case ValueKind::kInteger:
      return "whole number";
    case ValueKind::kBoolean:
      return "`true` or `false`";
    case ValueKind::kDate:
      return "date";
    case ValueKind::kMeasured:
      return "measured number";
    case ValueKind::kNumbers:
      return counted(parameter, "numbers");
    case ValueKind::kStrings:
      return counted(parameter, "words");
    case ValueKind::kTexts:
      return counted(parameter, "texts in every language");
    case ValueKind::kObject:
      return "object: " + link_to(*parameter.nested);
    case ValueKind::kObjects:
      return counted(parameter, "objects: ") + link_to(*parameter.nested);
    case ValueKind::kStages:
      return counted(parameter,
                     parameter.allowed.size() == 1
                         ? "stages: " + link_to(*stage_table(parameter.allowed.front()))
                         : "[stages](#stages)");
    case ValueKind::kArms:
      return "object: counterbalance and arm";
    case ValueKind::kLevels:
      return "object: factor and level";
    case ValueKind::kWeights:
      return "object: factor and weights of its levels";
  }
  return "";
}

std::string range_words(const Parameter& parameter) {
  const Range& range = parameter.range;
  if (range.low == range.high) return plain_number(range.low);
  std::string words;
  if (range.low > -std::numeric_limits<double>::infinity()) {
    words = (range.low_is_open ? "> " : ">= ") + plain_number(range.low);
  }
  if (range.high < std::numeric_limits<double>::infinity()) {
    words += (words.empty() ? "<= " : ", <= ") + plain_number(range.high);
  }
  return words;
}

std::string default_words(const Parameter& parameter) {
  if (parameter.required) return "required";
  if (parameter.default_json.empty()) return "optional";
  const std::string& json = parameter.default_json;
  return '`' + (json.ends_with(".0") ? json.substr(0, json.size() - 2) : json) + '`';
}

std::string condition_words(const Parameter& parameter, bool with_divider) {
  std::string words;
  for (const Condition& condition : parameter.only_where) {
    if (condition.key == kDivider && !with_divider) continue;
    words += (words.empty() ? " Only where `" : " and `") + condition.key + "` is " +
             one_of_words(condition.values);
  }
  return words.empty() ? "" : words + '.';
}

/// Returns the allowed words, unless the meaning explains each of them already.
std::string allowed_words(const Parameter& parameter) {
  const bool explained = std::all_of(
      parameter.allowed.begin(), parameter.allowed.end(), [&](const std::string& word) {
        return parameter.meaning.find('`' + word + '`') != std::string::npos;
      });
  if (parameter.allowed.size() < 2 || explained) return "";
  return " " + one_of_words(parameter.allowed) + '.';
}

std::string parameter_table(const std::vector<const Parameter*>& parameters,
                            bool with_divider) {
  std::string text = heading_row({"key", "type", "unit", "range", "default", "meaning"});
  for (const Parameter* parameter : parameters) {
    text += row({'`' + parameter->key + '`', type_words(*parameter), parameter->unit,
                 range_words(*parameter), default_words(*parameter),
                 parameter->meaning + allowed_words(*parameter) +
                     condition_words(*parameter, with_divider)});
  }
  return text + '\n';
}

std::string code(const std::string& json) { return "```json\n" + json + "\n```\n\n"; }

std::string written_table(const std::vector<WrittenColumn>& columns) {
  if (columns.empty()) return "";
  std::string text = heading_row({"data in", "column", "unit", "meaning"});
  for (const WrittenColumn& column : columns) {
    text += row({column.file, '`' + column.column + '`', column.unit, column.meaning});
  }
  return text + '\n';
}

/// Returns the condition of the dividing key, or nullptr for a key that every procedure has.
const Condition* divider_of(const std::vector<Condition>& conditions) {
  for (const Condition& condition : conditions) {
    if (condition.key == kDivider) return &condition;
  }
  return nullptr;
}

bool holds(const Condition* condition, const std::string& word) {
  return condition != nullptr && std::find(condition->values.begin(), condition->values.end(),
                                           word) != condition->values.end();
}

/// Writes each table once, below the first one that uses it.
class ReferenceWriter {
 public:
  [[nodiscard]] std::string text() && {
    text_ = kReferenceIntroduction;
    text_ += contents();
    section(study_table(), 2);
    write_media();
    text_ += "## stages\n\nA study is a list of these; `kind` says which one it is.\n\n";
    for (const ParameterTable* stage : stage_tables()) section(*stage, 3);
    write_common_data();
    return std::move(*this).trimmed();
  }

  [[nodiscard]] std::string text_of(const ParameterTable& root,
                                    const std::string& introduction) && {
    text_ = introduction + '\n';
    section(root, 2);
    return std::move(*this).trimmed();
  }

 private:
  [[nodiscard]] std::string trimmed() && {
    while (text_.ends_with("\n\n")) text_.pop_back();
    return std::move(text_);
  }

  static std::string contents() {
    std::string text = "\nContents: " + link_to(study_table()) +
                       " (the whole file), [media](#media), [stages](#stages):";
    for (const ParameterTable* stage : stage_tables()) text += ' ' + link_to(*stage) + ',';
    text.pop_back();
    return text + "; [data](#data)\n\n";
  }

  void section(const ParameterTable& table, int level) {
    if (!written_.insert(&table).second) return;
    text_ += std::string(level, '#') + ' ' + table.name + "\n\n" + table.meaning + "\n\n";
    std::vector<const Parameter*> common;
    for (const Parameter& parameter : table.parameters) {
      if (divider_of(parameter.only_where) == nullptr) common.push_back(&parameter);
    }
    text_ += parameter_table(common, true);
    const Parameter* divider = table.find(kDivider);
    if (divider == nullptr) {
      if (!table.example.empty()) text_ += "Example:\n\n" + code(table.example);
      text_ += written_table(written_columns(table));
    } else {
      write_common_columns(table);
      for (const std::string& word : divider->allowed) write_procedure(table, word, level + 1);
    }
    for (const Parameter& parameter : table.parameters) {
      if (parameter.nested != nullptr) section(*parameter.nested, level + 1);
    }
  }

  void write_common_columns(const ParameterTable& table) {
    std::vector<WrittenColumn> columns = written_columns(table);
    std::erase_if(columns,
                  [](const auto& column) { return divider_of(column.only_where) != nullptr; });
    text_ += written_table(columns);
  }

  void write_procedure(const ParameterTable& table, const std::string& word, int level) {
    text_ += std::string(level, '#') + ' ' + word + "\n\n";
    std::vector<const Parameter*> own;
    for (const Parameter& parameter : table.parameters) {
      if (holds(divider_of(parameter.only_where), word)) own.push_back(&parameter);
    }
    if (!own.empty()) {
      text_ += "Besides the keys of every block:\n\n" + parameter_table(own, false);
    }
    for (const BlockExample& example : block_examples()) {
      if (example.procedure == word) text_ += "Example:\n\n" + code(example.json);
    }
    std::vector<WrittenColumn> columns = written_columns(table);
    std::erase_if(columns, [&](const auto& column) {
      return !holds(divider_of(column.only_where), word);
    });
    if (!columns.empty()) {
      text_ += "Besides the columns of every block:\n\n" + written_table(columns);
    }
  }

  void write_media() {
    text_ +=
        "## media\n\nWhat can be felt, as `medium`, and the key that says how much of it.\n\n";
    text_ += heading_row({"medium", "key", "unit", "range", "meaning of the key"});
    for (const Medium& medium : media()) {
      const Parameter quantity = {.range = medium.range};
      text_ += row({'`' + medium.name + '`',
                    medium.quantity.empty() ? "none" : '`' + medium.quantity + '`',
                    quantity_unit(medium.quantity),
                    medium.quantity.empty() ? "" : range_words(quantity), medium.meaning});
    }
    text_ += '\n';
  }

  void write_common_data() {
    text_ +=
        "## data\n\n`jnd export csv STUDY_FOLDER --out FOLDER` writes the files named above. "
        "Every row of `trials.csv` and "
        "`answers.csv` also says `session` and `participant`, every answer its `stage`; "
        "`events.csv` has "
        "one row for everything that happened, `presentations.csv` one for every stimulus "
        "felt, with how "
        "the hand moved. `codebook.csv` explains every column. Stages that write nothing of "
        "their own are in "
        "`events.csv`: when they began and ended.\n";
  }

  std::string text_;
  std::set<const ParameterTable*> written_;
};

}  // namespace

std::string study_reference() { return ReferenceWriter().text(); }

std::string file_reference(const ParameterTable& root, const std::string& introduction) {
  return ReferenceWriter().text_of(root, introduction);
}

}  // namespace jnd::experiments
