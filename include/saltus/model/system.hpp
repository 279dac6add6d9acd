// System: the common part of a leaf and a diagram. Structure only: it never changes after
// construction.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "saltus/model/context.hpp"
#include "saltus/model/event_port.hpp"
#include "saltus/model/execution.hpp"
#include "saltus/model/port.hpp"

namespace saltus {

namespace tape {
class Tape;
}

/// A port of a leaf, after all nesting is resolved.
struct LeafPort {
  const LeafSystem* leaf = nullptr;
  int index = 0;
};

/// A system with its nesting resolved: leaves with their paths, and wires from leaf to leaf.
struct Structure {
  struct Leaf {
    const LeafSystem* system;
    std::string path;
  };
  struct Wire {
    LeafPort from, to;
  };
  /// The value of an input that no wire leads to.
  struct FixedInput {
    LeafPort to;
    Eigen::VectorXd value;
    Shape shape;
  };
  /// Leaves first to last - 1 are executed as their control signal says.
  struct Controlled {
    std::size_t first, last;
    LeafPort control;
    Execution execution;
  };
  /// A parameter of a leaf as a function of those of a diagram, which are the parameters of `from`.
  struct Computed {
    const LeafSystem* leaf;
    std::string parameter;
    const LeafSystem* from;
    std::shared_ptr<const tape::Tape> values;
  };
  /// A wire from an event of a leaf to an input for events.
  struct EventWire {
    LeafEvent from, to;
    int from_entry, to_entry;
    double weight, delay;
  };
  std::vector<Leaf> leaves;
  std::vector<Wire> wires;
  std::vector<EventWire> event_wires;
  std::vector<Controlled> controlled;  ///< a part comes before the part that contains it
  std::vector<FixedInput> fixed;       ///< if one input has two of them, the last one counts
  std::vector<Computed> computed;      ///< those of a diagram come before those of a diagram in it
  std::vector<Layout::Range> systems;
};

class System {
 public:
  explicit System(std::string name) : name_(std::move(name)), id_{next_id()} {}
  virtual ~System() = default;
  System(const System&) = delete;
  System& operator=(const System&) = delete;
  System(System&&) = default;
  System& operator=(System&&) = default;

  const std::string& name() const noexcept { return name_; }
  SystemId system_id() const noexcept { return id_; }

  /// The kind of block, for people: the name of its class.
  virtual std::string kind() const;
  /// The system that this object represents: itself, unless it is a handle to another system.
  virtual const System& itself() const { return *this; }

  virtual std::vector<std::string> input_names() const = 0;
  virtual std::vector<std::string> output_names() const = 0;

  /// Ports by position or by name; the ModelError for an unknown name lists the known names.
  InputPort input(int index = 0) const;
  InputPort input(std::string_view port) const;
  OutputPort output(int index = 0) const;
  OutputPort output(std::string_view port) const;

  /// An event that wires may start from, by name: a zero crossing or a time event of a leaf. Of a
  /// vector of guards each entry is a source of its own. Throws ModelError for an unknown name, with
  /// the nearest one, and for an entry that it does not have.
  EventOutputPort event_output(std::string_view event, std::optional<Index> entry = {}) const;
  EventOutputPort event_output(int index, std::optional<Index> entry = {}) const;
  /// An input for events, by name; likewise.
  EventInputPort event_input(std::string_view port, std::optional<Index> entry = {}) const;
  EventInputPort event_input(int index, std::optional<Index> entry = {}) const;
  /// One entry of an event, or of an input for events, of this system: the one that the port names, or
  /// its only one. Throws ModelError if it has several and the port names none.
  Index entry_of(const EventOutputPort& port) const;
  Index entry_of(const EventInputPort& port) const;

  /// Gives an input a constant value, so that nothing has to be connected to it: a number, a
  /// vector, or a matrix. The value is in force in plans that are compiled afterwards. Throws ModelError for an
  /// unknown input, and for a value that is empty or not finite. An input takes one source:
  /// `connect`, `build` and `compile` refuse an input with both a fixed value and a wire.
  void fix_input(int index, double value);
  template <class Derived>
  void fix_input(int index, const Eigen::MatrixBase<Derived>& value) {
    if constexpr (Derived::IsVectorAtCompileTime) {
      fix_input(index, Eigen::VectorXd(value), Shape::of(value.size()));
    } else {
      const MatrixByRows rows = value;
      fix_input(index, rows.template reshaped<Eigen::RowMajor>(),
                Shape::matrix(rows.rows(), rows.cols()));
    }
  }
  /// The same of a value in its flat form: the entries of a matrix row by row.
  void fix_input(int index, Eigen::VectorXd entries, const Shape& shape);
  /// Takes the value away again.
  void free_input(int index);
  /// Whether this system, or a block in it, gives the input a value.
  virtual bool fixes_input(int index) const { return fixed_.contains(index); }
  /// How often inputs have been fixed or freed, over all systems of the process. A plan that was
  /// made when this number was another one may have other values.
  static int fixes() noexcept;

  /// The default values of every block, at time t [s].
  Context create_context(double t = 0.0) const;

  /// Appends the leaves and wires of this system; `path` is the name by which it is known.
  virtual void collect(Structure& out, const std::string& path) const = 0;
  /// The output of a leaf that an output port of this system shows.
  virtual LeafPort output_source(int index) const = 0;
  /// The input of a leaf that an input port of this system feeds.
  virtual LeafPort input_target(int index) const = 0;

  /// The events that wires may start from, and the inputs that they may lead to.
  virtual std::vector<std::string> event_output_names() const { return {}; }
  virtual std::vector<std::string> event_input_names() const { return {}; }
  /// The event of a leaf behind event output `index`, and the input of a leaf behind event input
  /// `index`.
  virtual LeafEvent event_source(int index) const;
  virtual LeafEvent event_target(int index) const;

 protected:
  /// Appends the values of the inputs that were fixed.
  void collect_fixed(Structure& out) const;

 private:
  struct Fixed {
    Eigen::VectorXd value;
    Shape shape;
  };
  void fix(int index, Fixed value);
  Index checked_entry(const LeafEvent& of, std::optional<Index> entry, std::string_view kind,
                      const std::string& port) const;
  static int next_id();
  int checked(int index, const std::vector<std::string>& names, std::string_view kind) const;
  int find(std::string_view port, const std::vector<std::string>& names,
           std::string_view kind) const;

  std::string name_;
  SystemId id_;
  std::map<int, Fixed> fixed_;
};

/// All leaves and wires of a system, with its nesting resolved. The root's own name is not part of
/// the paths of its blocks.
Structure structure_of(const System& root);

}  // namespace saltus
