// jacobian_pattern: sets of states, spread along the order of the plan.
#include "saltus/plan/sparsity.hpp"

#include <numeric>

#include "saltus/plan/flatten.hpp"

namespace saltus {

namespace {

/// Sets of states by number: 0 is empty, 1 + i is state i alone, the others are listed. A set that
/// many entries share is kept once.
class StateSets {
 public:
  explicit StateSets(Index n) : n_(n), limit_(most_places(n)) {}

  static int single(Index i) { return static_cast<int>(i) + 1; }

  /// Calls f(state) for each member, in order.
  template <class F>
  void each(int set, F f) const {
    if (set == 0) return;
    if (set <= n_) return f(set - 1);
    for (const int i : listed(set)) f(i);
  }

  /// The union; the sets named may repeat.
  int unite(std::vector<int>& sets) {
    std::ranges::sort(sets);
    sets.erase(std::unique(sets.begin(), sets.end()), sets.end());
    if (!sets.empty() && sets.front() == 0) sets.erase(sets.begin());
    if (sets.empty()) return 0;
    if (sets.size() == 1) return sets.front();
    std::vector<int> all;
    for (const int set : sets) each(set, [&](int i) { all.push_back(i); });
    std::ranges::sort(all);
    all.erase(std::unique(all.begin(), all.end()), all.end());
    kept_ += static_cast<Index>(all.size());
    lists_.push_back(std::move(all));
    return static_cast<int>(n_ + static_cast<Index>(lists_.size()));
  }

  bool overflow() const { return kept_ > limit_; }

 private:
  const std::vector<int>& listed(int set) const {
    return lists_[static_cast<std::size_t>(set - 1 - n_)];
  }

  Index n_, limit_, kept_ = 0;
  std::vector<std::vector<int>> lists_;
};

/// The states behind each entry of each signal that a derivative reads.
class Reach {
 public:
  explicit Reach(const Plan& plan) : plan_(plan), sets_(plan.nx), of_node_(plan.nodes.size()) {
    for (const int i : plan.derivatives) {
      if (sets_.overflow()) return;
      visit(i);
    }
  }

  /// The set behind entry i of what a leaf reads, of these of its inputs and relations.
  template <class Of>
  void behind(const PlanLeaf& leaf, const std::vector<int>& inputs, const EntryRule& rule, Index n,
              Of put) {
    std::vector<Index> widths;
    for (const int node : leaf.inputs) widths.push_back(plan_.node(node).shape.size);
    std::vector<int> found;
    const auto gather = [&](Index i) {
      found.clear();
      for (const int k : inputs) {
        const int node = leaf.inputs[static_cast<std::size_t>(k)];
        const EntryRange range =
            rule ? rule(i, k, widths) : EntryRange{0, widths[static_cast<std::size_t>(k)]};
        const Index last = std::min(range.last, widths[static_cast<std::size_t>(k)]);
        for (Index e = range.first; e < last; ++e) found.push_back(set_of(node, e));
      }
      return sets_.unite(found);
    };
    const int common = rule ? 0 : gather(0);
    for (Index i = 0; i < n; ++i) put(i, rule ? gather(i) : common);
  }

  StateSets& sets() { return sets_; }

 private:
  int set_of(int node, Index entry) const {
    const Node& of = plan_.node(node);
    if (of.rate != Rate::continuous) return 0;
    if (of.view) return of.place.space == Space::x ? StateSets::single(of.place.offset + entry) : 0;
    const auto& sets = of_node_[static_cast<std::size_t>(node)];
    return sets.empty() ? 0 : sets[static_cast<std::size_t>(entry)];
  }

  void visit(int number) {
    const Node& node = plan_.node(number);
    if (node.relation) return;  // held, where it reaches a derivative
    const PlanLeaf& leaf = plan_.leaf_of(node);
    const OutputDeclaration& output = plan_.output_of(node);
    std::vector<int> own;
    if (has(output.reads, Reads::continuous_state)) {
      for (Index i = 0; i < leaf.nx; ++i) own.push_back(StateSets::single(leaf.x + i));
    }
    const int state = sets_.unite(own);
    auto& sets = of_node_[static_cast<std::size_t>(number)];
    sets.resize(static_cast<std::size_t>(node.shape.size));
    const auto inputs = inputs_of(leaf, output.reads, output.inputs);
    behind(leaf, inputs, output.entries, node.shape.size, [&](Index i, int set) {
      std::vector<int> both{state, set};
      sets[static_cast<std::size_t>(i)] = state == 0 ? set : sets_.unite(both);
    });
  }

 public:
  /// Positions of the inputs that are read.
  static std::vector<int> inputs_of(const PlanLeaf& leaf, Reads reads,
                                    const std::optional<std::vector<int>>& named) {
    if (!has(reads, Reads::inputs)) return {};
    if (named) return *named;
    std::vector<int> all(leaf.inputs.size());
    std::iota(all.begin(), all.end(), 0);
    return all;
  }

 private:
  const Plan& plan_;
  StateSets sets_;
  std::vector<std::vector<int>> of_node_;
};

/// The declared entries of a leaf by rows; a ModelError for one that cannot be.
std::vector<std::vector<int>> declared_rows(const PlanLeaf& leaf) {
  std::vector<std::vector<int>> rows(static_cast<std::size_t>(leaf.nx));
  for (const auto& [row, column] : *leaf.declared().continuous.sparsity) {
    if (row < 0 || row >= leaf.nx || column < 0 || column >= leaf.nx) {
      throw ModelError(text("block '", leaf.path, "': the Jacobian's sparsity names entry (", row,
                            ", ", column, "); the block has ", leaf.nx,
                            " continuous states, so rows and columns run from 0 to ", leaf.nx - 1));
    }
    rows[static_cast<std::size_t>(row)].push_back(static_cast<int>(column));
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    std::ranges::sort(rows[i]);
    if (const auto twice = std::ranges::adjacent_find(rows[i]); twice != rows[i].end())
      throw ModelError(text("block '", leaf.path, "': the Jacobian's sparsity names entry (", i,
                            ", ", *twice, ") twice; name each entry once"));
  }
  return rows;
}

/// A place and whether only differences tell its value, row by row.
struct Rows {
  std::vector<Index> start = {0};
  std::vector<int> columns;
  std::vector<char> differences;
};

/// Adds the rows of one leaf.
class RowsOfLeaf {
 public:
  RowsOfLeaf(const PlanLeaf& leaf, Reach& reach) : leaf_(leaf), state_(leaf.declared().continuous) {
    through_.resize(static_cast<std::size_t>(leaf.nx));
    if (!state_.ode) return;
    const auto inputs = Reach::inputs_of(leaf, state_.reads, state_.inputs);
    reach.behind(leaf, inputs, state_.entries, leaf.nx,
                 [&](Index i, int set) { through_[static_cast<std::size_t>(i)] = set; });
    reads_state_ = has(state_.reads, Reads::continuous_state);
    if (reads_state_ && state_.sparsity) declared_ = declared_rows(leaf);
    exact_ = reads_state_ && (state_.jacobian || state_.sparse_jacobian) && !feeds_back(reach);
  }

  /// Whether the leaf's own Jacobian is d(xdot)/d(x) in its block.
  bool exact() const { return exact_; }

  void add(Rows& rows, Reach& reach) const {
    std::vector<int> own, others;
    for (Index i = 0; i < leaf_.nx; ++i) {
      own.clear(), others.clear();
      add_own(i, own);
      reach.sets().each(through_[static_cast<std::size_t>(i)], [&](int j) { others.push_back(j); });
      append(rows, static_cast<int>(leaf_.x + i), own, others);
    }
  }

 private:
  /// Whether some input depends on the leaf's own state: then its Jacobian is one part of two.
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

  void add_own(Index i, std::vector<int>& own) const {
    if (!reads_state_) return;
    if (state_.sparsity) {
      for (const int j : declared_[static_cast<std::size_t>(i)])
        own.push_back(static_cast<int>(leaf_.x) + j);
    } else {
      own.resize(static_cast<std::size_t>(leaf_.nx));
      std::iota(own.begin(), own.end(), static_cast<int>(leaf_.x));
    }
  }

  /// Both lists and the diagonal, merged in order.
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
  std::vector<int> through_;  // the set behind the inputs of each row
  std::vector<std::vector<int>> declared_;
  bool reads_state_ = false, exact_ = false;
};

/// Rows to columns, in two sweeps.
void transpose(const Rows& rows, Index n, JacobianPattern& to) {
  std::vector<Index>& start = to.places.start;
  start.assign(static_cast<std::size_t>(n) + 1, 0);
  for (const int j : rows.columns) ++start[static_cast<std::size_t>(j) + 1];
  std::partial_sum(start.begin(), start.end(), start.begin());
  std::vector<Index> next(start.begin(), start.end() - 1);
  to.places.rows.resize(rows.columns.size()), to.differences.resize(rows.columns.size());
  for (Index i = 0; i < n; ++i) {
    for (auto k = static_cast<std::size_t>(rows.start[static_cast<std::size_t>(i)]);
         k < static_cast<std::size_t>(rows.start[static_cast<std::size_t>(i) + 1]); ++k) {
      const auto at = static_cast<std::size_t>(next[static_cast<std::size_t>(rows.columns[k])]++);
      to.places.rows[at] = static_cast<int>(i), to.differences[at] = rows.differences[k];
    }
  }
}

/// How many places a leaf's own block has at least.
Index block_size(const PlanLeaf& leaf) {
  const ContinuousState& state = leaf.declared().continuous;
  if (!state.ode || !has(state.reads, Reads::continuous_state)) return 0;
  return state.sparsity ? static_cast<Index>(state.sparsity->size()) : leaf.nx * leaf.nx;
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

JacobianPattern jacobian_pattern(const Plan& plan) {
  JacobianPattern pattern;
  const Index most = most_places(plan.nx);
  Index blocks = 0;
  for (const int leaf : plan.odes)
    blocks += block_size(plan.leaves[static_cast<std::size_t>(leaf)]);
  if (pattern.overflow = blocks > most; pattern.overflow) return pattern;
  Reach reach(plan);
  Rows rows;
  for (const int number : plan.odes) {
    const RowsOfLeaf leaf(plan.leaves[static_cast<std::size_t>(number)], reach);
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
