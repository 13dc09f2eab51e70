#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace jnd::app {

/// A document as it is printed. Names of files and cells of tables may be no UTF-8; what stands
/// for them then is, so that the output is JSON whatever happens.
template <typename Json>
[[nodiscard]] std::string json_text(const Json& document) {
  return document.dump(2, ' ', false, Json::error_handler_t::replace);
}

}  // namespace jnd::app
