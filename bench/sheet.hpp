// Sheet: the results of one benchmark, as a table for people and as JSON for bench/page.py.
#pragma once

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <saltus/report/environment.hpp>
#include <string>
#include <vector>

namespace bench {

using Row = nlohmann::ordered_json;  // column by column, in the order in which they are named

/// The folder of the results: build/bench/results, unless it was built elsewhere.
inline std::filesystem::path results_folder() { return SALTUS_BENCH_RESULTS; }

inline Row machine() {
  const saltus::Environment e = saltus::environment();
  return {{"cpu", e.cpu},     {"cores", e.cores},       {"compiler", e.compiler},
          {"build", e.build}, {"sundials", e.sundials}, {"saltus", e.saltus}};
}

/// Prints each row at once, with a line of names whenever these change; the destructor writes the
/// file.
class Sheet {
 public:
  Sheet(std::string name, const std::string& question) : name_(std::move(name)) {
    json_ = {{"name", name_}, {"question", question}, {"environment", machine()}};
    json_["targets"] = json_["rows"] = Row::array();
    std::printf("%s: %s\n", name_.c_str(), question.c_str());
  }
  Sheet(const Sheet&) = delete;
  Sheet& operator=(const Sheet&) = delete;
  ~Sheet() {
    std::filesystem::create_directories(results_folder());
    std::ofstream(results_folder() / (name_ + ".json")) << json_.dump(1) << "\n";
  }

  void add(const Row& row) {
    std::vector<std::string> names;
    for (const auto& [name, value] : row.items()) names.push_back(name);
    if (names != names_) {
      names_ = names;
      for (std::size_t i = 0; i < names.size(); ++i)
        std::printf("%s", padded(names[i], i, row[names[i]].is_string()).c_str());
      std::puts("");
    }
    for (std::size_t i = 0; i < names.size(); ++i)
      std::printf("%s", padded(shown(row[names[i]]), i, row[names[i]].is_string()).c_str());
    std::puts("");
    std::fflush(stdout);
    json_["rows"].push_back(row);
  }

  /// A target: `found` should be at most `limit`.
  void target(const std::string& what, double found, double limit) {
    std::printf("%s: %.3g, at most %.3g: %s\n", what.c_str(), found, limit,
                found <= limit ? "holds" : "misses");
    json_["targets"].push_back({{"what", what}, {"found", found}, {"limit", limit}});
  }

 private:
  static std::string shown(const Row& value) {
    if (value.is_string()) return value.get<std::string>();
    if (!value.is_number_float()) return value.is_null() ? "-" : value.dump();
    std::array<char, 32> buffer{};
    std::snprintf(buffer.data(), buffer.size(), "%.4g", value.get<double>());
    return buffer.data();
  }
  std::string padded(const std::string& cell, std::size_t column, bool left) const {
    const std::size_t width = std::max<std::size_t>(names_[column].size(), left ? 22 : 9);
    const std::string gap(cell.size() < width ? width - cell.size() : 0, ' ');
    return (left ? cell + gap : gap + cell) + "  ";
  }

  std::string name_;
  std::vector<std::string> names_;
  Row json_;
};

}  // namespace bench
