// Value: the builder's record of one number of a tape; Registers: the owners of scratch memory.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <vector>

#include "program.hpp"
#include "saltus/base/list.hpp"

namespace saltus::tape::detail {

/// The reasons why a number is kept, and its place.
struct Value {
  int uses = 0;                        ///< readers that are still to come
  std::vector<std::uint32_t> outputs;  ///< the outputs that return it
  Place place = {};
  std::optional<Place> loaded = {};  ///< a copy in a register, for operations that need registers
  int block = -1;                    ///< the block of its register, if any
  int array = -1;                    ///< the array that it belongs to, if any
};

/// The distance between two places of one array.
inline std::int32_t distance(std::uint32_t from, std::uint32_t to) {
  return static_cast<std::int32_t>(to) - static_cast<std::int32_t>(from);
}

/// Gives adjacent registers to the numbers of a run, and takes them back when no number in them is
/// needed any more.
class Registers {
 public:
  explicit Registers(std::size_t& count) : count_(&count) {}

  /// A register that is never given back.
  Place keep() { return {Kind::reg, static_cast<std::uint32_t>((*count_)++)}; }
  /// Registers for all numbers of a run, written to their values.
  Place take(std::span<const Node> nodes, std::vector<Value>& values);
  /// One number of the block has been used once.
  void release(int block) {
    if (block >= 0 && --blocks_[block].uses == 0) give_back(block);
  }
  void give_back(int block);

 private:
  struct Block {
    std::uint32_t offset = 0, size = 0;
    int uses = 0;
  };
  std::size_t* count_;  // in the program
  List<Block> blocks_;
  std::map<std::uint32_t, std::vector<std::uint32_t>> free_;  // by size
};

}  // namespace saltus::tape::detail
