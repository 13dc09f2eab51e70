#include "support/reference_data.h"

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "support/places.h"

namespace jnd::test_support {

const nlohmann::json& reference_data(const std::string& file) {
  static std::map<std::string, nlohmann::json> read;
  const auto known = read.find(file);
  if (known != read.end()) return known->second;
  const auto path = source_folder() / "data" / "reference" / file;
  std::ifstream stream(path);
  if (!stream) {
    throw std::runtime_error(path.string() + ": expected reference values, found no such file");
  }
  nlohmann::json document = nlohmann::json::parse(stream, nullptr, false);
  if (document.is_discarded()) {
    throw std::runtime_error(path.string() + ": expected one JSON document, found other text");
  }
  return read.emplace(file, std::move(document)).first->second;
}

}  // namespace jnd::test_support
