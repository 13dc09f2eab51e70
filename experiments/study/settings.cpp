#include "experiments/study/settings.h"

#include <stdexcept>

namespace jnd::experiments {

template <typename T>
const T& Settings::get(const std::string& key) const {
  const auto found = values_.find(key);
  const T* value = found == values_.end() ? nullptr : std::get_if<T>(&found->second);
  if (value == nullptr) throw std::logic_error("settings: no value of this kind for " + key);
  return *value;
}

double Settings::number(const std::string& key) const { return get<double>(key); }

double Settings::number(const std::string& key, double otherwise) const {
  return has(key) ? number(key) : otherwise;
}

std::optional<double> Settings::optional_number(const std::string& key) const {
  return has(key) ? std::optional(number(key)) : std::nullopt;
}

int Settings::integer(const std::string& key) const { return static_cast<int>(number(key)); }

bool Settings::boolean(const std::string& key) const { return get<bool>(key); }

const std::string& Settings::word(const std::string& key) const {
  return get<std::string>(key);
}

std::vector<double> Settings::numbers(const std::string& key) const {
  return has(key) ? get<std::vector<double>>(key) : std::vector<double>{};
}

}  // namespace jnd::experiments
