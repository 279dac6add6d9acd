// A context as JSON and back, to the last bit. It needs nlohmann/json, as no other header here
// does: include it where you use it.
#pragma once

#include <string>
#include <string_view>
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
    return record.at(key);
  }
  template <class T>
  static T entry(const Value& row, std::size_t index) {
    return row.at(index);
  }
  static std::vector<Value> items(const Value& record, const char* key) {
    const Value& list = record.at(key);
    return {list.begin(), list.end()};
  }
  static bool has(const Value& record, const char* key) { return record.contains(key); }

  static bool is(const Value& value, const char* text) { return value == text; }
  static std::string shown(const Value& value) { return value.dump(); }
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
    return detail::context_from<JsonTree>(system.create_context(),
                                          JsonTree::Value::parse(json_text));
  } catch (const JsonTree::Value::exception& error) {
    throw ModelError(text("a context in JSON: ", error.what()));
  }
}

}  // namespace saltus
