#pragma once

#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace jnd::experiments {

/// What the keys of a procedure were given in a block, defaults filled in, each under its own
/// name without the quantity: "reference", "repetitions". Reading a key that the procedure does
/// not declare, or as something that it is not, throws `std::logic_error`: a mistake of ours.
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
  /// Empty where it is absent.
  [[nodiscard]] std::vector<double> numbers(const std::string& key) const;

 private:
  template <typename T>
  [[nodiscard]] const T& get(const std::string& key) const;

  std::map<std::string, Value> values_;
};

}  // namespace jnd::experiments
