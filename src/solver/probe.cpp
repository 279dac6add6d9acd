// Probe: moves the states of one block and looks at its derivatives.
#include "saltus/solver/detail/probe.hpp"

#include <algorithm>
#include <optional>
#include <random>

#include "saltus/base/detail/forced_unwind.hpp"
#include "saltus/solver/detail/find_places.hpp"
#include "saltus/solver/detail/linear_thresholds.hpp"

namespace saltus {

namespace {

bool says_nothing(const PlanLeaf& leaf) {
  const ContinuousState& state = leaf.declared().continuous;
  return leaf.nx > thresholds::small_block && state.ode &&
         has(state.reads, Reads::continuous_state) && !state.sparsity && !state.jacobian &&
         !state.sparse_jacobian;
}

/// Runs a call. If it throws, returns false and copies the first line of the error to `message`.
template <class Call>
bool tried(Call call, std::string& message) {
  std::string what;
  try {
    call();
    return true;
  } catch (const Interruption&) {
    throw;
  } catch (const std::exception& error) {
    what = error.what();
  } catch (...) {
    detail::pass_end_of_thread();
    what = "something that is no std::exception";
  }
  message = what.substr(0, what.find('\n'));
  return false;
}

/// The derivatives of one block near (t, x), with the inputs at (t, x).
class Neighbourhood {
 public:
  Neighbourhood(Machine& machine, int leaf, double t, const double* x)
      : machine_(&machine),
        leaf_(machine.plan().leaves[leaf]),
        number_(leaf),
        t_(t),
        x_(VectorView(machine.carried(t, x), machine.plan().nx)),
        here_(own()),
        f_(leaf_.nx) {
    const double typical = std::sqrt(here_.squaredNorm() / static_cast<double>(leaf_.nx));
    sizes_ = here_.cwiseAbs().cwiseMax(typical > 0.0 ? typical : 1.0);
    machine.evaluate_derivative_needs(t, x_.data());
  }
  Neighbourhood(const Neighbourhood&) = delete;
  Neighbourhood& operator=(const Neighbourhood&) = delete;

  struct Point {
    double distance;       // in sizes of the states
    Eigen::VectorXd x, f;  // states and derivatives of the block
  };

  /// A point at that distance. Throws an Error if the derivative is not finite there.
  Point point(double distance) {
    own() = here_;
    for (Index j = 0; j < leaf_.nx; ++j) move(j, distance);
    call();
    if (!f_.allFinite()) throw Error("the derivative beside the state is not finite");
    return {distance, own(), f_};
  }

  /// Marks the derivatives that change with these states, and leaves the other marks unchanged.
  void compare(const Point& from, std::span<const int> moved, std::vector<char>& changed) {
    own() = from.x;
    for (const int j : moved) move(j, from.distance);
    call();
    for (Index i = 0; i < leaf_.nx; ++i)
      if (f_[i] != from.f[i]) changed[i] = 1;
  }

 private:
  Eigen::VectorBlock<Eigen::VectorXd> own() { return x_.segment(leaf_.x, leaf_.nx); }

  /// Moves a state by a random part of the distance, from half of it to all of it, so that no two
  /// moves cancel.
  void move(Index j, double distance) {
    const double part = 0.5 + 0.5 * std::ldexp(static_cast<double>(random_() >> 11), -53);
    x_[leaf_.x + j] += distance * part * sizes_[j];
  }

  void call() {
    machine_->leaf_derivative(number_, t_, x_.data(), VectorRef(f_.data(), f_.size()));
  }

  Machine* machine_;
  const PlanLeaf& leaf_;
  std::size_t number_;
  double t_;
  Eigen::VectorXd x_;         // states of all blocks
  Eigen::VectorXd here_, f_;  // of this block
  Eigen::VectorXd sizes_;     // sizes of its states
  std::mt19937_64 random_{1};
};

/// Finds the places from two points. The farther point is dropped if the block throws there or is
/// not finite.
Places look_around(Neighbourhood& around, Index n, std::string& message) {
  const Neighbourhood::Point near = around.point(thresholds::near_point);
  std::optional<Neighbourhood::Point> far;
  if (std::string left; !tried([&] { far = around.point(thresholds::far_point); }, left))
    message = left;
  return find_places(n, [&](std::span<const int> moved, std::vector<char>& changed) {
    std::ranges::fill(changed, char{0});
    if (far && !tried([&] { around.compare(*far, moved, changed); }, message)) far.reset();
    around.compare(near, moved, changed);
  });
}

std::string_view reason(Search search) {
  return search == Search::full ? "reads nearly everything" : "has a row that reads too much";
}

}  // namespace

Probe::Probe(Machine& machine) : machine_(&machine) {
  const Plan& plan = machine.plan();
  for (const int leaf : plan.odes)
    if (says_nothing(plan.leaves[leaf])) blocks_.push_back({.leaf = leaf});
}

bool Probe::look(double t, const double* x) {
  bool news = false;
  for (Block& block : blocks_)
    if (block.open && look_at(block, t, x)) news = true;
  return news;
}

bool Probe::look_at(Block& block, double t, const double* x) {
  const auto before = machine_->rhs_calls;
  Places seen;
  std::string threw;
  const Index n = machine_->plan().leaves[block.leaf].nx;
  const bool well = tried(
      [&] {
        Neighbourhood around(*machine_, block.leaf, t, x);
        seen = look_around(around, n, threw);
      },
      threw);
  block.calls += static_cast<int>(machine_->rhs_calls - before);
  if (!threw.empty()) block.note = text("it threw: ", threw);
  if (well && seen.search == Search::found) return add(block.leaf, seen.places);
  block.open = false;
  if (well) block.note = reason(seen.search);
  return found_.erase(block.leaf) > 0;
}

bool Probe::add(int leaf, const Sparsity& places) {
  std::vector<MatrixEntry> all = found_[leaf];
  const std::size_t before = all.size();
  for (Index j = 0; j < places.columns(); ++j)
    for (const int i : places.column(j)) all.push_back({i, j});
  const auto key = [](const MatrixEntry& e) { return std::pair(e.column, e.row); };
  std::ranges::sort(all, {}, key);
  const auto doubles = std::ranges::unique(all, {}, key);
  all.erase(doubles.begin(), doubles.end());
  const bool news = all.size() != before;
  found_[leaf] = std::move(all);
  return news;
}

void Probe::give_up(const std::string& why) {
  found_.clear();
  for (Block& block : blocks_)
    if (std::exchange(block.open, false)) block.note = why;
}

std::string Probe::words() const {
  std::string out;
  if (blocks_.empty() || blocks_.front().calls == 0) return out;  // no such block, or not searched
  constexpr std::size_t shown = 3;
  for (std::size_t k = 0; k < std::min(blocks_.size(), shown); ++k) {
    const Block& block = blocks_[k];
    const std::string& path = machine_->plan().leaves[block.leaf].path;
    out += text("; block '", path, "' declares no sparsity, ", block.calls, " calls ",
                block.open ? text("found ", found_.at(block.leaf).size(), " places")
                           : std::string("did not find it"));
    if (!block.note.empty()) out += text(" (", block.note, ")");
  }
  return blocks_.size() > shown ? text(out, "; ", blocks_.size() - shown, " more blocks") : out;
}

}  // namespace saltus
