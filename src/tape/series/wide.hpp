// Wide instructions: each computes four alike instructions that do not need each other, each in a
// lane of its own.
//
// A wide row holds the coefficients of four expressions: number 4 k + l is the coefficient of order
// k in lane l.
#pragma once

#include "number.hpp"
#include "program.hpp"

namespace saltus::tape::series {

inline constexpr Index wide_row_size = lanes * row_size;
inline constexpr Index wide_sums_size = lanes * sums_size;

/// Rows are offsets in the memory of wide rows. The rows of terms are places of a single lane.
struct WideInstruction : Instruction {
  std::array<const Instruction*, lanes> narrow = {};  ///< name the values that are read
  std::array<Index, lanes> a_of_lane = {};  ///< the place of a in each lane, if it is one number
};

/// The program for the rates with wide instructions.
struct Wide {
  std::vector<WideInstruction> instructions;
  std::vector<Index> own;   ///< where the numbers of each instruction are
  std::vector<Term> terms;  ///< the row of each is a place of a single lane
  Orders calls;
  Index rows = 0, sums = 0, time = -1;
  Index states = 0;  ///< the first of the rows of the states, four in each

  Index place_of_state(Index i) const { return states + wide_row_size * (i / lanes) + i % lanes; }
};

/// Null if narrow instructions are as quick, or if one of them has no wide form.
std::shared_ptr<const Wide> widen(const Program& program);

}  // namespace saltus::tape::series
