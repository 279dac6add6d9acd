// Places of random matrices, and matrices as drawings.
#pragma once

#include <random>
#include <string_view>
#include <utility>
#include <vector>

#include "saltus/base/matrix_entry.hpp"
#include "saltus/plan/detail/sparsity.hpp"

namespace support {

/// About `per_column` places in each column of an n by n matrix, and the diagonal.
inline std::vector<saltus::MatrixEntry> random_entries(saltus::Index n, int per_column,
                                                       std::mt19937& random) {
  std::vector<std::vector<char>> taken(static_cast<std::size_t>(n),
                                       std::vector<char>(static_cast<std::size_t>(n)));
  std::vector<saltus::MatrixEntry> entries;
  std::uniform_int_distribution<saltus::Index> any(0, n - 1);
  for (saltus::Index j = 0; j < n; ++j) {
    for (int k = 0; k <= per_column; ++k) {
      const saltus::Index i = k == 0 ? j : any(random);
      if (std::exchange(taken[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)], 1))
        continue;
      entries.push_back({i, j});
    }
  }
  std::ranges::shuffle(entries, random);
  return entries;
}

/// The places of a matrix drawn row by row: x where there is one.
inline saltus::Sparsity places(std::initializer_list<std::string_view> rows) {
  saltus::Sparsity result;
  for (std::size_t j = 0; j < rows.begin()->size(); ++j) {
    for (std::size_t i = 0; i < rows.size(); ++i)
      if (rows.begin()[i][j] == 'x') result.rows.push_back(static_cast<int>(i));
    result.start.push_back(static_cast<saltus::Index>(result.rows.size()));
  }
  return result;
}

/// The places of these entries.
inline saltus::Sparsity places(saltus::Index n, const std::vector<saltus::MatrixEntry>& entries) {
  saltus::Sparsity result;
  for (saltus::Index j = 0; j < n; ++j) {
    std::vector<int> column;
    for (const auto& [row, of] : entries)
      if (of == j) column.push_back(static_cast<int>(row));
    std::ranges::sort(column);
    result.rows.insert(result.rows.end(), column.begin(), column.end());
    result.start.push_back(static_cast<saltus::Index>(result.rows.size()));
  }
  return result;
}

}  // namespace support
