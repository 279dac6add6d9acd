// jacobian_pattern: sets of states, spread along the order of the plan.
#include "saltus/plan/detail/sparsity.hpp"
#include "saltus/base/list.hpp"

#include <numeric>

#include "reach.hpp"

namespace saltus {

namespace {

using namespace detail;

/// The entries of a leaf's own block: declared, or otherwise found; null if all of them count.
const std::vector<MatrixEntry>* named_entries(const PlanLeaf& leaf, int number,
                                              const FoundBlocks& found) {
  if (const auto& declared = leaf.declared().continuous.sparsity) return &*declared;
  const auto at = found.find(number);
  return at != found.end() ? &at->second : nullptr;
}

/// The given entries of a leaf by rows. Throws ModelError for an impossible entry.
std::vector<std::vector<int>> by_rows(const PlanLeaf& leaf,
                                      const std::vector<MatrixEntry>& entries) {
  List<std::vector<int>> rows(leaf.nx);
  for (const auto& [row, column] : entries) {
    if (row < 0 || row >= leaf.nx || column < 0 || column >= leaf.nx) {
      throw ModelError(text("block '", leaf.path, "': the Jacobian's sparsity names entry (", row,
                            ", ", column, "); the block has ", leaf.nx,
                            " continuous states, so rows and columns run from 0 to ", leaf.nx - 1));
    }
    rows[row].push_back(static_cast<int>(column));
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    std::ranges::sort(rows[i]);
    if (const auto twice = std::ranges::adjacent_find(rows[i]); twice != rows[i].end())
      throw ModelError(text("block '", leaf.path, "': the Jacobian's sparsity names entry (", i,
                            ", ", *twice, ") twice; name each entry once"));
  }
  return rows;
}

/// Entries, and whether only differences give their values, row by row.
struct Rows {
  List<Index> start = {0};
  List<int> columns;
  List<char> differences;
};

/// Adds the rows of one leaf.
class RowsOfLeaf {
 public:
  RowsOfLeaf(const PlanLeaf& leaf, const std::vector<MatrixEntry>* entries, Reach& reach)
      : leaf_(leaf), state_(leaf.declared().continuous), named_(entries != nullptr) {
    through_.resize(leaf.nx);
    if (!state_.ode) return;
    const auto inputs = Reach::inputs_of(leaf, state_.reads, state_.inputs);
    reach.behind(leaf, inputs, state_.entries, leaf.nx,
                 [&](Index i, int set) { through_[i] = set; });
    reads_state_ = has(state_.reads, Reads::continuous_state);
    if (reads_state_ && named_) named_rows_ = by_rows(leaf, *entries);
    exact_ = reads_state_ && (state_.jacobian || state_.sparse_jacobian) && !feeds_back(reach);
  }

  /// Whether the leaf's own Jacobian is d(xdot)/d(x) in its block.
  bool exact() const { return exact_; }

  void add(Rows& rows, Reach& reach) const {
    List<int> own;
    std::vector<int> others;
    for (Index i = 0; i < leaf_.nx; ++i) {
      own.clear(), others.clear();
      add_own(i, own);
      reach.sets().each(through_[i], [&](int j) { others.push_back(j); });
      append(rows, static_cast<int>(leaf_.x + i), own, others);
    }
  }

 private:
  /// Whether an input depends on the leaf's own state. If it does, the leaf's Jacobian is only one
  /// of two parts.
  bool feeds_back(Reach& reach) const {
    bool found = false;
    std::vector<int> seen = through_;
    std::ranges::sort(seen);
    seen.erase(std::unique(seen.begin(), seen.end()), seen.end());
    for (const int set : seen)
      reach.sets().each(set,
                        [&](int j) { found = found || (j >= leaf_.x && j < leaf_.x + leaf_.nx); });
    return found;
  }

  void add_own(Index i, List<int>& own) const {
    if (!reads_state_) return;
    if (named_) {
      for (const int j : named_rows_[i]) own.push_back(static_cast<int>(leaf_.x) + j);
    } else {
      own.resize(leaf_.nx);
      std::iota(own.begin(), own.end(), static_cast<int>(leaf_.x));
    }
  }

  /// Appends both lists and the diagonal, merged in order.
  void append(Rows& rows, int diagonal, const std::vector<int>& own,
              const std::vector<int>& others) const {
    auto a = own.begin(), b = others.begin();
    bool met = false;
    const auto put = [&](int column, bool differs) {
      rows.columns.push_back(column), rows.differences.push_back(differs);
      met = met || column == diagonal;
    };
    while (a != own.end() || b != others.end()) {
      const int next_own = a != own.end() ? *a : std::numeric_limits<int>::max();
      const int next_other = b != others.end() ? *b : std::numeric_limits<int>::max();
      const int next = std::min(next_own, next_other);
      if (!met && diagonal < next) put(diagonal, false);
      put(next, next_other == next || !exact_);
      a += next_own == next, b += next_other == next;
    }
    if (!met) put(diagonal, false);
    rows.start.push_back(static_cast<Index>(rows.columns.size()));
  }

  const PlanLeaf& leaf_;
  const ContinuousState& state_;
  List<int> through_;  // the set of the inputs of each row
  bool named_;
  List<std::vector<int>> named_rows_;
  bool reads_state_ = false, exact_ = false;
};

/// Turns rows into columns, in two sweeps.
void transpose(const Rows& rows, Index n, JacobianPattern& to) {
  List<Index>& start = to.places.start;
  start.assign(n + 1, 0);
  for (const int j : rows.columns) ++start[j + 1];
  std::partial_sum(start.begin(), start.end(), start.begin());
  List<Index> next(start.begin(), start.end() - 1);
  to.places.rows.resize(rows.columns.size()), to.differences.resize(rows.columns.size());
  for (Index i = 0; i < n; ++i) {
    for (Index k = rows.start[i]; k < rows.start[i + 1]; ++k) {
      const Index at = next[rows.columns[k]]++;
      to.places.rows[at] = static_cast<int>(i), to.differences[at] = rows.differences[k];
    }
  }
}

/// The least number of entries in a leaf's own block.
Index block_size(const PlanLeaf& leaf, const std::vector<MatrixEntry>* entries) {
  const ContinuousState& state = leaf.declared().continuous;
  if (!state.ode || !has(state.reads, Reads::continuous_state)) return 0;
  return entries != nullptr ? static_cast<Index>(entries->size()) : leaf.nx * leaf.nx;
}

}  // namespace

Sparsity full_sparsity(Index n) {
  Sparsity full;
  for (Index j = 0; j < n; ++j) {
    for (Index i = 0; i < n; ++i) full.rows.push_back(static_cast<int>(i));
    full.start.push_back(full.size());
  }
  return full;
}

JacobianPattern jacobian_pattern(const Plan& plan, const FoundBlocks& found) {
  JacobianPattern pattern;
  const Index most = most_places(plan.nx);
  const auto leaf_of = [&](int number) -> const PlanLeaf& { return plan.leaves[number]; };
  const auto entries_of = [&](int number) { return named_entries(leaf_of(number), number, found); };
  Index blocks = 0;
  for (const int leaf : plan.odes) blocks += block_size(leaf_of(leaf), entries_of(leaf));
  if (pattern.overflow = blocks > most; pattern.overflow) return pattern;
  Reach reach(plan);
  Rows rows;
  for (const int number : plan.odes) {
    const RowsOfLeaf leaf(leaf_of(number), entries_of(number), reach);
    pattern.overflow = reach.sets().overflow();
    if (!pattern.overflow) leaf.add(rows, reach);
    pattern.overflow = pattern.overflow || static_cast<Index>(rows.columns.size()) > most;
    if (pattern.overflow) return pattern;
    if (leaf.exact()) pattern.own.push_back(number);
  }
  transpose(rows, plan.nx, pattern);
  return pattern;
}

}  // namespace saltus
