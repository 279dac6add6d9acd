// LlvmLoops: long runs as loops. Runs that follow one another and read each other's numbers at the
// same place share a loop, so these numbers stay in the processor.
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "llvm_places.hpp"

namespace saltus::tape::detail {

class LlvmLoops {
 public:
  LlvmLoops(LlvmText& text, LlvmPlaces& places, const Program& program)
      : text_(text), places_(places), program_(program) {}

  /// Writes a loop over line `first`, which is long, and the lines that can share it. Returns the
  /// first line that is not in it, and the first number of each line that is left to do.
  std::pair<std::size_t, std::size_t> write(std::size_t first);

 private:
  std::size_t end_of_loop(std::size_t first) const;
  bool shares(std::size_t first, const Line& line, std::size_t end) const;
  std::string read(std::size_t k, std::size_t first, const Place& place, const std::string& i);
  bool read_later(const Line& line, std::size_t end) const;
  void write_line(std::size_t k, std::size_t first, std::size_t end, const std::string& i);

  LlvmText& text_;
  LlvmPlaces& places_;
  const Program& program_;
  std::string block_ = "begin";                    // the block of instructions before the next loop
  std::vector<std::string> values_;                // of the lines of the present loop
  std::vector<std::array<std::string, 3>> still_;  // operands that are the same for all numbers
};

}  // namespace saltus::tape::detail
