#include "app/manual/completions.h"

namespace jnd::app {

const std::vector<std::string>& words_named(const CommandWords& words,
                                            const std::string& list) {
  static const std::vector<std::string> kNoWords;
  if (list == "studies") return words.studies;
  if (list == "laboratories") return words.laboratories;
  if (list == "devices") return words.devices;
  return kNoWords;
}

std::string last_word(const ManualCommand& command) {
  return command.name.substr(command.name.rfind(' ') + 1);
}

}  // namespace jnd::app
