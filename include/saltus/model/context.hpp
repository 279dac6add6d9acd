// Context: all values of a system at one time, as one regular value.
#pragma once

#include <initializer_list>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "saltus/base/error.hpp"
#include "saltus/base/ids.hpp"
#include "saltus/base/list.hpp"
#include "saltus/model/continuation.hpp"
#include "saltus/model/pending.hpp"

namespace saltus {

struct ContextEntry;        // context_entry.hpp
struct ComputedParameters;  // computed_parameter.hpp

/// "block.name"; the parameters of the system itself, whose path is empty, have no block.
inline std::string joined_name(std::string_view path, std::string_view name) {
  return path.empty() ? std::string(name) : text(path, ".", name);
}

/// The places of each leaf's values in a context. All contexts of one system share it.
struct Layout {
  /// A block's own; of a diagram, from which others are computed; computed, so it cannot be set.
  enum class Role { own, of_diagram, computed };
  struct Parameter {
    std::string name;
    Index offset = 0;  // within the leaf
    Index size = 1;
    Role role = Role::own;
  };
  struct Leaf {
    std::string path;
    Index x = 0, nx = 0, z = 0, nz = 0, p = 0, np = 0;
    std::vector<Parameter> parameters;
    std::vector<std::string> states = {};  ///< names of the continuous states, or none
    bool of_diagram = false;               ///< the parameters of a diagram, which is no block
  };
  struct Range {  // the leaves of one system: [first, last)
    SystemId id;
    std::string path;
    std::size_t first = 0, last = 0;
  };
  std::vector<Leaf> leaves;
  std::vector<Range> systems;
  std::shared_ptr<const ComputedParameters> computed = {};  ///< null: none, or not known here

  /// Whether this is the only block. The samplers of its outputs do not count.
  bool is_alone(const Leaf& leaf) const {
    const bool one = leaves.size() == 1 || (!systems.empty() && systems.front().last == 1);
    return one && &leaf == leaves.data();
  }
  /// The name of a value of a leaf; without its path if the leaf is alone.
  std::string name_of(const Leaf& leaf, std::string_view value) const {
    return is_alone(leaf) ? std::string(value) : joined_name(leaf.path, value);
  }
};

/// All values of a context without their layout, to be written to a file and read again.
struct ContextValues {
  double time = 0.0;  ///< [s]
  Eigen::VectorXd continuous_state, discrete_state, parameters;
  std::vector<int> modes;
  bool settled = false;
  std::shared_ptr<const Continuation> continuation = {};
  std::shared_ptr<const PendingExecutions> pending = {};
};

/// Time t [s], continuous state x, discrete state z, a mode per leaf, parameters p. A context is a
/// value: every `with_*` returns a new context and leaves the old one, and the system, unchanged.
/// It throws ModelError for a wrong size, a value that is not finite, an unknown parameter or an
/// unknown system.
class Context {
 public:
  Context() = default;
  explicit Context(std::shared_ptr<const Layout> layout) : layout_(std::move(layout)) {}
  /// A context with all values zero, to be filled with saved values.
  static Context zero(std::shared_ptr<const Layout> layout);

  double time() const noexcept { return time_; }
  const Eigen::VectorXd& continuous_state() const noexcept { return x_; }
  const Eigen::VectorXd& discrete_state() const noexcept { return z_; }
  const Eigen::VectorXd& parameters() const noexcept { return p_; }
  const std::vector<int>& modes() const noexcept { return modes_; }
  int mode() const;              ///< of a context of one leaf
  const Layout& layout() const;  ///< empty for a context that no system made

  /// True if the events at exactly `time()` have happened already, because a run ended here.
  bool settled() const noexcept { return settled_; }
  /// The further state of the run that ended here; null after a value was changed by hand.
  const Continuation* continuation() const noexcept { return continuation_.get(); }
  /// The executions of queued zero crossings that wait, and the deliveries of event wires; null if
  /// no run has scheduled any. Every `with_*` keeps them with the times at which they are due. One
  /// that is due before `time()` happens at the start of the run.
  const PendingExecutions* pending() const noexcept { return pending_.get(); }

  /// All values that change, for saving them.
  ContextValues values() const {
    return {time_, x_, z_, p_, modes_, settled_, continuation_, pending_};
  }
  /// A context of this layout with saved values. Throws ModelError also for impossible values in a
  /// continuation or in pending executions.
  Context with_values(const ContextValues& values) const;

  Context with_time(double t) const;
  Context with_continuous_state(const Eigen::VectorXd& x) const;
  Context with_continuous_state(std::initializer_list<double> x) const {
    return with_continuous_state(vector_of(x));
  }
  Context with_discrete_state(const Eigen::VectorXd& z) const;
  Context with_discrete_state(std::initializer_list<double> z) const {
    return with_discrete_state(vector_of(z));
  }
  Context with_mode(int mode) const;
  /// Sets a parameter by name, in a diagram by path: "ball.g". A scalar fills a vector parameter.
  Context with_parameter(std::string_view name, const Eigen::VectorXd& value) const;
  Context with_parameter(std::string_view name, double value) const;
  Eigen::VectorXd parameter(std::string_view name) const;

  /// This context for functions that compute parameters, where it does not know any: a context that
  /// was pickled has values alone.
  Context with_computed(std::shared_ptr<const ComputedParameters> computed) const;

  /// The context of one system inside this one, leaf or diagram.
  Context operator[](SystemId id) const;
  /// This context with the values of one system replaced.
  Context with_subcontext(SystemId id, const Context& part) const;

 private:
  friend class LeafSystem;
  friend class System;
  friend class Memory;
  friend void write_entry(Context& context, const ContextEntry& entry,
                          std::span<const double> values, std::string_view name);

  static Eigen::VectorXd vector_of(std::initializer_list<double> values) {
    return Eigen::Map<const Eigen::VectorXd>(values.begin(), static_cast<Index>(values.size()));
  }
  bool has_one_mode() const;
  const Layout::Range& range(SystemId id) const;
  std::pair<const Layout::Leaf*, const Layout::Parameter*> find_parameter(
      std::string_view name) const;
  /// A copy to be changed. It drops the continuation, which belongs to the old values.
  Context changed() const {
    Context next = *this;
    next.continuation_.reset();
    return next;
  }
  void compute_parameters();
  static void replace(Eigen::VectorXd& values, const Eigen::VectorXd& with, std::string_view what);

  std::shared_ptr<const Layout> layout_;
  double time_ = 0.0;
  Eigen::VectorXd x_, z_, p_;
  List<int> modes_;
  bool settled_ = false;
  std::shared_ptr<const Continuation> continuation_;
  std::shared_ptr<const PendingExecutions> pending_;
};

namespace detail {

void require_finite(const Eigen::VectorXd& values, std::string_view what);
/// Throws ModelError for a parameter that is computed.
void require_settable(Layout::Role role, std::string_view name);

}  // namespace detail

}  // namespace saltus
