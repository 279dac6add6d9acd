// A context as JSON and back, to the last bit. It needs nlohmann/json, as no other header here
// does: include it where you use it.
#pragma once

#include <concepts>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "saltus/model/detail/context_data.hpp"
#include "saltus/model/system.hpp"

namespace saltus {

namespace detail {

/// JSON with the fields in the order in which they were set; see detail/context_data.hpp.
struct JsonTree {
  using Value = nlohmann::ordered_json;

  static Value record() { return Value::object(); }
  static Value list() { return Value::array(); }
  static Value row(const auto&... values) { return Value::array({values...}); }

  static void set(Value& record, const char* key, const auto& value) { record[key] = value; }
  static void append(Value& list, const auto& value) { list.push_back(value); }

  template <class T>
  static T get(const Value& record, const char* key) {
    return as<T>(record.at(key));
  }
  template <class T>
  static T entry(const Value& row, std::size_t index) {
    return as<T>(row.at(index));
  }
  static std::vector<Value> items(const Value& record, const char* key) {
    const Value& list = listed(record.at(key));
    return {list.begin(), list.end()};
  }
  static bool has(const Value& record, const char* key) { return record.contains(key); }

  static bool is(const Value& value, const char* text) { return value == text; }
  static std::string shown(const Value& value) {
    return value.is_string() ? value.dump() : value.type_name();
  }

 private:
  [[noreturn]] static void refuse(const char* expected, const Value& found) {
    throw ModelError(text("a context in JSON: expected ", expected, ", found ", found.type_name()));
  }
  static const Value& listed(const Value& value) {
    if (!value.is_array()) refuse("a list", value);
    return value;
  }

  /// The value as a T. The library itself would turn 1e300 into some integer.
  template <class T>
  static T as(const Value& value) {
    if constexpr (std::same_as<T, bool>) {
      if (!value.is_boolean()) refuse("true or false", value);
    } else if constexpr (std::integral<T>) {
      return integer<T>(value);
    } else if constexpr (std::floating_point<T>) {
      if (!value.is_number()) refuse("a number", value);
    }
    return value.template get<T>();
  }
  template <class T>
    requires(std::same_as<T, std::vector<double>> || std::same_as<T, std::vector<int>> ||
             std::same_as<T, std::vector<std::int64_t>>)
  static T as(const Value& value) {
    T all;
    for (const Value& item : listed(value)) all.push_back(as<typename T::value_type>(item));
    return all;
  }
  template <class T>
  static T integer(const Value& value) {
    if (!value.is_number_integer()) refuse("an integer", value);
    const bool fits = value.is_number_unsigned()
                          ? std::in_range<T>(value.template get<std::uint64_t>())
                          : std::in_range<T>(value.template get<std::int64_t>());
    if (!fits)
      throw ModelError(text("a context in JSON: the integer ", value.dump(), " is too large"));
    return value.template get<T>();
  }
};

}  // namespace detail

/// The values of a context, block by block, with the continuation of its run. Numbers are written
/// so that reading them gives the same bits.
inline std::string to_json(const Context& context) {
  return detail::data_of<detail::JsonTree>(context).dump(1);
}

/// The context of `system` that to_json wrote. Throws ModelError for text that is not such a
/// context, and for a context of a system with other blocks.
inline Context context_from_json(const System& system, std::string_view json_text) {
  using detail::JsonTree;
  try {
    const Context blank = system.create_context();
    return blank.with_values(
        detail::values_from<JsonTree>(blank.layout(), JsonTree::Value::parse(json_text)));
  } catch (const JsonTree::Value::exception& error) {
    throw ModelError(text("a context in JSON: ", error.what()));
  }
}

}  // namespace saltus
