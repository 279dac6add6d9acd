// PythonLeaf: a block whose callbacks are Python functions, called as (time, state, *inputs,
// **parameters).
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "saltus/model/leaf_system.hpp"
#include "state.hpp"

namespace saltus::python {

/// Which inputs a function reads, and so gets; all if not said.
using InputList = std::optional<std::vector<int>>;

/// How a function is called.
enum class Convention {
  state,   ///< f(time, state, *inputs, **parameters)
  inputs,  ///< f((u_0, u_1, ...))
  input    ///< f(u_0)
};

class PythonLeaf final : public LeafSystem {
 public:
  explicit PythonLeaf(std::string name) : LeafSystem(std::move(name)) {}

  // What the Python class declares with; the functions come in by number, see `add`.
  using LeafSystem::declare_continuous_state;
  using LeafSystem::declare_default_mode;
  using LeafSystem::declare_discrete_state;
  using LeafSystem::declare_mode_output;
  using LeafSystem::declare_one_shot;
  using LeafSystem::declare_output_port;
  using LeafSystem::declare_periodic_update;
  using LeafSystem::declare_zero_crossing;

  void set_state_dimensions(Dimensions x) { x_dimensions_ = std::move(x); }
  void set_discrete_dimensions(Dimensions z) { z_dimensions_ = std::move(z); }
  const Dimensions& state_dimensions() const { return x_dimensions_; }
  const Dimensions& discrete_dimensions() const { return z_dimensions_; }
  void add_parameter(const std::string& name, const py::array& value);
  int add_input(std::string name, std::optional<Shape> shape);

  /// An output whose shape, or whether it is boolean, is found by calling it once with the values
  /// the block starts with and inputs at zero, where that was not said.
  int add_output(std::string name, int function, std::optional<Shape> shape,
                 std::optional<bool> boolean, Reads reads);

  /// Takes a function of `self`, the Python object of this block; `what` names it in messages.
  /// Returns its number.
  int add(py::handle self, py::object function, InputList inputs, std::string what,
          Convention convention);
  VectorFunction vector_function(int k) const;
  MatrixFunction matrix_function(int k) const;
  ResetMap reset_map(int k) const;
  ResetMap update(int k) const;
  const InputList& inputs_of(int k) const { return functions_[static_cast<std::size_t>(k)].inputs; }

  void collect(Structure& out, const std::string& path) const override;

  /// Whether a run calls Python functions of this block.
  bool needs_interpreter() const { return !functions_.empty(); }

  /// For the garbage collector.
  int traverse(visitproc visit, void* argument) const;
  void clear() { functions_.clear(); }

 private:
  struct Function {
    py::object callable;  // of a method of the block itself the plain function, so that it refers
                          // to no block
    bool method;          // the block goes before the other arguments
    Convention convention;
    InputList inputs;
    std::string what;
  };
  /// The Python objects of one call, kept for the next one; a callback that keeps some of them gets
  /// them for itself.
  struct Frame {
    py::object state;  // a State
    std::vector<py::object> owned;
    std::vector<py::object> parameters;
    Eigen::VectorXd parameter_values;
    std::vector<PyObject*> arguments;
  };
  struct Unfinished {
    int output, function;
    bool shape, boolean;
  };

  py::object call(int k, const At& at) const;
  std::size_t arrange(Frame& frame, const Function& function, const At& at) const;
  void fetch_inputs(Frame& frame, const Function& function, const At& at) const;
  void fill_state(Frame& frame, const At& at) const;
  void fill_parameters(Frame& frame, const At& at) const;
  py::object input(const At& at, int i) const;

  py::object call_with(int k, const std::vector<Shape>& shapes, double value) const;
  std::optional<py::array> sample(int k, std::vector<Shape> shapes,
                                  std::span<const Index> widths) const;
  Shape shape_of(int k, std::span<const Shape> inputs) const;
  void finish_outputs();
  std::string whose(const Function& function) const {
    return text("block '", name(), "': ", function.what);
  }

  PyObject* self_ = nullptr;  // the Python object that owns this one
  std::vector<Function> functions_;
  std::vector<Unfinished> unfinished_;
  Dimensions x_dimensions_{0}, z_dimensions_{0};
  std::vector<Dimensions> parameter_dimensions_;
  std::vector<bool> vector_inputs_;
  py::tuple keywords_;  // names of the parameters
  mutable std::unique_ptr<Frame> spare_;
};

}  // namespace saltus::python
