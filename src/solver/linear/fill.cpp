// Counting the entries of a factor column by column.
#include "fill.hpp"

#include <limits>

#include <Eigen/OrderingMethods>

#include "saltus/base/list.hpp"
#include "sparse.hpp"

namespace saltus {

Fill predicted_fill(const Sparsity& places, double most) {
  const SparseColumns matrix = sparse_matrix(places);
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> order;
  Eigen::AMDOrdering<int>()(matrix, order);
  const Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> inverse = order.inverse();
  const Eigen::VectorXi position = inverse.indices();

  const Index n = places.columns();
  List<std::vector<int>> before(n);  // the earlier neighbours of each state, in that order
  for (int j = 0; j < places.columns(); ++j) {
    for (const int i : places.column(j)) {
      const auto [first, last] = std::minmax(position[i], position[j]);
      if (first != last) before[last].push_back(first);
    }
  }
  List<int> parent(n, -1), seen(n, -1), count(n, 1);
  double entries = static_cast<double>(n);
  for (int row = 0; row < static_cast<int>(n); ++row) {
    seen[row] = row;
    for (int column : before[row]) {
      for (int k = column; seen[k] != row; k = parent[k]) {
        if (parent[k] < 0) parent[k] = row;
        ++count[k], seen[k] = row, ++entries;
      }
    }
    if (entries > most) return {2.0 * entries, std::numeric_limits<double>::infinity()};
  }
  Fill fill{2.0 * entries, 0.0};
  for (const int c : count) fill.operations += 2.0 * static_cast<double>(c) * c;
  return fill;
}

}  // namespace saltus
