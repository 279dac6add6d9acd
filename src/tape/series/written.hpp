// Numbers of machine code that is being written: the recurrences calculate with them as they do
// with doubles, and each operation is written down.
#pragma once

#include <array>
#include <set>
#include <string>
#include <unordered_map>

#include "../llvm_text.hpp"
#include "number.hpp"
#include "program.hpp"

namespace saltus::tape::series {

class SeriesWriter;

/// A number, or four of them side by side. A number without a writer is 0, in as many lanes as its
/// partner has.
struct Written {
  SeriesWriter* writer = nullptr;
  std::string value = {};
  int lanes = 1;
};

Written operator+(const Written& a, const Written& b);
Written operator-(const Written& a, const Written& b);
Written operator*(const Written& a, const Written& b);
Written operator*(double a, const Written& b);
Written operator*(const Written& a, double b);
Written operator/(double a, const Written& b);
inline Written& operator+=(Written& a, const Written& b) { return a = a + b; }

/// The memory that the code works on.
enum class Memory { values, rows, own, x };

/// A place in it.
struct WrittenPlace {
  SeriesWriter* writer = nullptr;
  Memory memory = Memory::rows;
  Index offset = 0;

  friend WrittenPlace operator+(WrittenPlace place, Index n) {
    place.offset += n;
    return place;
  }
};

/// Writes the body of a function. What was stored since the last `pause` is not loaded again.
class SeriesWriter {
 public:
  explicit SeriesWriter(const Program& program) : program_(program) {}

  Written read(Memory memory, Index offset, int count);
  void store(Memory memory, Index offset, const Written& a);
  /// Four numbers, each with a place of its own.
  Written gathered(Memory memory, const std::array<Index, lanes>& offsets);
  Written joined(const std::array<Written, lanes>& all);
  /// A value of the program, in as many lanes as there are numbers.
  Written value(Index number);
  Written constant(double value, int count = 1);
  Written binary(const char* how, Written a, Written b);
  Written apply(Op op, std::span<const Written> operands);

  /// A new block of instructions: numbers that were stored before are loaded from now on, so that
  /// few of them are alive at once.
  void pause();
  /// Ends the function, which then returns 0, if a number is 0: the interpreter does the rest.
  void leave_if_zero(const Written& a);

  /// How many numbers each instruction works on.
  int width = 1;
  /// Rows begin where a table says, so that alike instructions share the code: the offset
  /// `in_table` n means entry n of the table. The entries from 0 on belong to the instruction
  /// itself.
  bool by_table = false;
  static constexpr Index in_table = 4096;

  detail::LlvmText& text() { return text_; }

 private:
  struct Stored {
    std::string value;
    int lanes = 1, lane = 0;
  };
  static Index key(Memory memory, Index offset) { return 4 * offset + static_cast<Index>(memory); }
  const Stored* whole(Memory memory, Index offset, int count) const;
  std::string address(Memory memory, Index offset);
  std::string begin_in_table(Memory memory, Index entry);
  std::string in_lanes(const Written& a, int count);

  const Program& program_;
  detail::LlvmText text_;
  std::unordered_map<Index, Stored> stored_;
  std::unordered_map<Index, std::string> addresses_;
  std::unordered_map<Index, std::string> begins_;  // by entry of the table
};

inline void put(const WrittenPlace& place, const Written& a) {
  place.writer->store(place.memory, place.offset, a);
}

template <>
struct Row<Written> {
  WrittenPlace p;
  int lanes = 1;

  Written operator[](Index k) const {
    return p.writer->read(p.memory, p.offset + lanes * k, lanes);
  }
  /// The coefficients of order k ... k + 3 of a single expression.
  Written four(Index k) const { return p.writer->read(p.memory, p.offset + k, 4); }
  Written zero() const { return p.writer->constant(0.0, lanes); }
  bool is_wide() const { return lanes > 1; }
  Row from(Index k) const { return {p + lanes * k, lanes}; }
};

inline Written side_by_side(const Written& a, const Written& b, const Written& c,
                            const Written& d) {
  return (a.writer != nullptr ? a : b).writer->joined({a, b, c, d});
}

/// The numbers at any places, as linear recurrences read them.
struct WrittenNumbers {
  SeriesWriter* writer;
  Memory memory;
  Index shift;

  Written operator[](Index n) const {
    if (memory == Memory::values) return writer->value(n);
    return writer->read(memory, n + shift, 1);
  }
};

}  // namespace saltus::tape::series
