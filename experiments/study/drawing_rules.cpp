#include "experiments/study/drawing_rules.h"

#include <map>
#include <string>
#include <utility>

#include "core/error.h"
#include "core/random_stream.h"
#include "experiments/procedures/procedure_registry.h"
#include "experiments/study/rule_values.h"
#include "experiments/study/stage_walk.h"

namespace jnd::experiments {
namespace {

using nlohmann::json;

class Drawing {
 public:
  Drawing(const LocatedJson& file, std::vector<StudyProblem>& problems)
      : file_(file), problems_(problems) {}

  void run(const Study& study) {
    std::map<std::string, const Block*> blocks;
    for_each_stage(study.stages, [&](const Stage& stage) {
      if (const auto* block = std::get_if<Block>(&stage.content)) blocks[stage.name] = block;
    });
    for_each_written_stage(file_.root(), [&](const json& stage, const std::string& pointer) {
      const auto block = blocks.find(word(stage, "name"));
      if (block != blocks.end()) draw(stage, *block->second, pointer);
    });
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
  Drawing(file, problems).run(study);
}

}  // namespace jnd::experiments
