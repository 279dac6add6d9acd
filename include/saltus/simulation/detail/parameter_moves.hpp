// ParameterMoves: how the parameters of all blocks change with the parameter of each column.
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "saltus/base/ids.hpp"
#include "saltus/base/list.hpp"
#include "saltus/base/view.hpp"

namespace saltus {

/// An entry of p, and its derivative by the parameter of a column.
struct ParameterMove {
  Index entry = 0;
  double by = 0.0;
};

/// The entries of p that change with one parameter, in ascending order. A parameter of a block moves
/// its own entry by 1. One of a diagram moves those, too, that the diagram computes from it.
struct ParameterDirection {
  std::vector<ParameterMove> moves = {};
  std::string obstacle = {};  ///< why there is no derivative; empty if there is one
};

/// Those of all columns, by column and by entry. A start value moves none.
class ParameterMoves {
 public:
  struct Column {
    Index number = 0;
    double by = 0.0;
  };

  ParameterMoves() = default;
  /// No column moves any of `np` entries yet.
  explicit ParameterMoves(Index np) : columns_(np) {}

  void add(Index column, std::vector<ParameterMove> moves) {
    for (const ParameterMove& move : moves) columns_[move.entry].push_back({column, move.by});
    if (std::ssize(moves_) <= column) moves_.resize(column + 1);
    moves_[column] = std::move(moves);
  }

  /// The entries that a column moves.
  std::span<const ParameterMove> of_column(Index k) const {
    if (k >= std::ssize(moves_)) return {};
    return moves_[k];
  }
  /// The columns that move an entry.
  std::span<const Column> of_entry(Index i) const { return columns_[i]; }
  /// The derivative of an entry by the parameter of a column.
  double at(Index i, Index k) const {
    for (const Column& column : columns_[i])
      if (column.number == k) return column.by;
    return 0.0;
  }

 private:
  List<std::vector<Column>> columns_;
  List<std::vector<ParameterMove>> moves_;
};

}  // namespace saltus
