#include "experiments/study/drawing_rules.h"

#include <string>
#include <utility>

#include "core/error.h"
#include "core/random_stream.h"
#include "experiments/procedures/procedure_registry.h"
#include "experiments/study/rule_values.h"

namespace jnd::experiments {
namespace {

using nlohmann::json;

class Drawing {
 public:
  Drawing(const LocatedJson& file, std::vector<StudyProblem>& problems)
      : file_(file), problems_(problems) {}

  /// The same stages as they stand in the file and as they were built.
  void check(const json& written, const std::vector<Stage>& stages,
             const std::string& pointer) {
    for (std::size_t i = 0; i < stages.size(); ++i) {
      const std::string here = pointer + '/' + std::to_string(i);
      if (const auto* block = std::get_if<Block>(&stages[i].content)) {
        draw(written[i], *block, here);
      }
      const auto* counterbalance = std::get_if<Counterbalance>(&stages[i].content);
      if (counterbalance == nullptr) continue;
      for (std::size_t arm = 0; arm < counterbalance->arms.size(); ++arm) {
        check(written[i]["arms"][arm]["stages"], counterbalance->arms[arm].stages,
              here + "/arms/" + std::to_string(arm) + "/stages");
      }
      if (!counterbalance->between.empty()) {
        check(written[i]["between"], counterbalance->between, here + "/between");
      }
    }
  }

 private:
  void draw(const json& written, const Block& block, const std::string& pointer) {
    core::RandomStream stream(1, "order");
    try {
      const Procedure& procedure = procedure_named(block.procedure);
      (void)procedure.draw_next(block, {}, stream);
      procedure.check(block);
    } catch (const core::Error& error) {
      report(written, pointer, error.what());
    }
  }

  /// "staircase.start: expected ...", at the key that has this name, with its quantity or
  /// without.
  void report(const json& written, const std::string& pointer, const std::string& words) {
    const std::size_t colon = words.find(": ");
    const std::size_t dot = words.find('.');
    if (colon == std::string::npos || dot == std::string::npos || dot > colon) {
      return add(pointer, words);
    }
    const std::string name = words.substr(dot + 1, colon - dot - 1);
    const std::string message = words.substr(colon + 2);
    for (const auto& [key, value] : written.items()) {
      if (key == name || key.starts_with(name + '_')) return add(pointer + '/' + key, message);
    }
    add(pointer, words);
  }

  void add(const std::string& pointer, std::string message) {
    const TextPosition position = file_.value_position(pointer);
    add_problem(problems_,
                {file_.file(), position.line, position.column, pointer, std::move(message)});
  }

  const LocatedJson& file_;
  std::vector<StudyProblem>& problems_;
};

}  // namespace

void check_drawing(const LocatedJson& file, const Study& study,
                   std::vector<StudyProblem>& problems) {
  Drawing(file, problems).check(file.root()["stages"], study.stages, "/stages");
}

}  // namespace jnd::experiments
