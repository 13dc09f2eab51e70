#include "device/network/network_options.h"

#include "core/error.h"

namespace jnd::device {
namespace {

constexpr std::string_view kKey = "key=";

void apply(std::string_view option, NetworkOptions& options) {
  if (option == "simulated" || option == "real") {
    options.is_simulated = option == "simulated";
  } else if (option.starts_with(kKey) && option.size() > kKey.size()) {
    options.key_name = option.substr(kKey.size());
  } else {
    throw core::Error(
        "device network: expected key=NAME, simulated or real behind the address, with commas "
        "between, found \"" +
        std::string(option.substr(0, 80)) + "\"");
  }
}

}  // namespace

NetworkOptions network_options(std::string_view argument) {
  const std::size_t comma = argument.find(',');
  NetworkOptions options{.endpoint = endpoint_of(argument.substr(0, comma))};
  while (argument.find(',') != std::string_view::npos) {
    argument.remove_prefix(argument.find(',') + 1);
    apply(argument.substr(0, argument.find(',')), options);
  }
  return options;
}

}  // namespace jnd::device
