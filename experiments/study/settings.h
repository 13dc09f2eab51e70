#pragma once

#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace jnd::experiments {

/// The values of a procedure's keys in a block, with defaults, each under its name without the
/// quantity: "reference", "repetitions". Reading a key that the procedure does not declare, or
/// as another type, throws `std::logic_error`, because it is a mistake of the program.
class Settings {
 public:
  using Value =
      std::variant<bool, double, std::string, std::vector<double>, std::vector<std::string>>;

  void set(const std::string& key, Value value) { values_[key] = std::move(value); }

  [[nodiscard]] bool operator==(const Settings&) const = default;

  [[nodiscard]] bool has(const std::string& key) const { return values_.contains(key); }
  [[nodiscard]] double number(const std::string& key) const;
  [[nodiscard]] double number(const std::string& key, double otherwise) const;
  [[nodiscard]] std::optional<double> optional_number(const std::string& key) const;
  [[nodiscard]] int integer(const std::string& key) const;
  [[nodiscard]] bool boolean(const std::string& key) const;
  [[nodiscard]] const std::string& word(const std::string& key) const;
  /// Returns an empty list if the key is absent.
  [[nodiscard]] std::vector<double> numbers(const std::string& key) const;

 private:
  template <typename T>
  [[nodiscard]] const T& get(const std::string& key) const;

  std::map<std::string, Value> values_;
};

}  // namespace jnd::experiments
