// LlvmPlaces: where a function of LLVM finds the numbers of a program.
#pragma once

#include <map>
#include <optional>
#include <tuple>

#include "llvm_text.hpp"
#include "program.hpp"

namespace saltus::tape::detail {

/// Reads and writes the places of a program. A register is a value of the text; a register that a
/// loop writes or reads is in memory.
class LlvmPlaces {
 public:
  LlvmPlaces(LlvmText& text, const Program& program);

  /// Numbers first ... first + width - 1 of a place, side by side.
  std::string read(const Place& place, std::size_t first, int width);
  void write(const Place& place, std::size_t first, int width, const std::string& value);

  /// The same numbers in a loop, with the counter `i` in place of `first`.
  std::string read_in_loop(const Place& place, const std::string& i, int width);
  void write_in_loop(const Place& place, const std::string& i, int width, const std::string& value);

 private:
  /// One lane of a value.
  struct Lane {
    std::string value;
    int width = 1, lane = 0;
  };

  void keep_in_memory(const Place& place, std::size_t count);
  bool in_memory(const Place& place, std::size_t i) const;
  int count_in_memory(const Place& place, std::size_t first, int width) const;
  std::string array_of(const Place& place);
  std::string address(const Place& place, std::size_t i);
  std::string address_in_loop(const Place& place, const std::string& i, int lane);
  std::string one(const Place& place, std::size_t i);
  std::string load_one(const Place& place, std::size_t i);
  std::string of_registers(const Place& place, std::size_t first, int width);
  std::optional<std::string> whole_vector(const std::vector<Lane>& lanes) const;
  std::optional<std::string> shuffled(const std::vector<Lane>& lanes);
  Lane& lane_of(const Place& place, std::size_t i) { return registers_[index(place, i)]; }
  static std::size_t index(const Place& place, std::size_t i) {
    return static_cast<std::size_t>(static_cast<Index>(place.offset) +
                                    place.stride * static_cast<Index>(i));
  }

  LlvmText& text_;
  const Program& program_;
  std::vector<char> memory_;     // for each register: it is in memory
  std::vector<Lane> registers_;  // the others
  std::string before_;
  std::map<std::tuple<Kind, int, std::size_t>, std::string> loaded_;  // entries of the arguments
};

}  // namespace saltus::tape::detail
