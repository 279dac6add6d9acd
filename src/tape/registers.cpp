// Registers: given and taken back.
#include "saltus/base/list.hpp"

#include "value.hpp"

namespace saltus::tape::detail {

Place Registers::take(std::span<const Node> nodes, std::vector<Value>& values) {
  const auto size = static_cast<std::uint32_t>(nodes.size());
  auto& free = free_[size];
  Block block{static_cast<std::uint32_t>(*count_), size};
  if (free.empty()) {
    *count_ += size;
  } else {
    block.offset = free.back();
    free.pop_back();
  }
  for (std::uint32_t i = 0; i < size; ++i) {
    Value& value = nth(values, nodes[i].id);
    value.place = {Kind::reg, block.offset + i};
    value.block = static_cast<int>(blocks_.size());
    block.uses += value.uses;
  }
  blocks_.push_back(block);
  return {Kind::reg, block.offset, size > 1 ? 1 : 0};
}

void Registers::give_back(int number) {
  const Block& block = blocks_[number];
  free_[block.size].push_back(block.offset);
}

}  // namespace saltus::tape::detail
