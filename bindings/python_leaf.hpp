// PythonLeaf: a block whose callbacks are Python functions, called as (time, state, *inputs,
// **parameters), or compiled ones.
#pragma once

#include <algorithm>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "python_function.hpp"
#include "saltus/base/list.hpp"
#include "saltus/model/leaf_system.hpp"

namespace saltus::python {

/// While such an object lives, no function of the user is called to find a shape: `build` uses the
/// declarations.
class ShapesAsDeclared {
 public:
  ShapesAsDeclared() : before_(active_) { active_ = true; }
  ~ShapesAsDeclared() { active_ = before_; }
  ShapesAsDeclared(const ShapesAsDeclared&) = delete;
  ShapesAsDeclared& operator=(const ShapesAsDeclared&) = delete;
  static bool active() noexcept { return active_; }

 private:
  static inline thread_local bool active_ = false;
  bool before_;
};

class PythonLeaf final : public LeafSystem {
 public:
  explicit PythonLeaf(std::string name) : LeafSystem(std::move(name)) {}

  // The declarations of the Python class; functions are given by number, see `add`.
  using LeafSystem::declare_continuous_state;
  using LeafSystem::declare_default_mode;
  using LeafSystem::declare_discrete_state;
  using LeafSystem::declare_edge_reset;
  using LeafSystem::declare_event_input;
  using LeafSystem::declare_mode_output;
  using LeafSystem::declare_one_shot;
  using LeafSystem::declare_output_port;
  using LeafSystem::declare_periodic_update;
  using LeafSystem::declare_relation;
  using LeafSystem::declare_time_event;
  using LeafSystem::declare_zero_crossing;

  void set_state_dimensions(Dimensions x) { x_dimensions_ = std::move(x), forget_frames(); }
  void set_discrete_dimensions(Dimensions z) { z_dimensions_ = std::move(z), forget_frames(); }
  const Dimensions& state_dimensions() const { return x_dimensions_; }
  const Dimensions& discrete_dimensions() const { return z_dimensions_; }
  const std::vector<Dimensions>& parameter_dimensions() const { return parameter_dimensions_; }
  /// Whether input i comes as a float, if the wire has this shape. The weight of an event wire comes
  /// after all inputs.
  bool number_input(int i, Index size, Index columns) const {
    if (i >= count_of(declarations().inputs)) return true;
    const std::optional<Shape>& declared = declarations().inputs[i].shape;
    return declared ? !declared->vector : size == 1 && columns == 0;
  }
  void add_parameter(const std::string& name, const py::array& value);
  int add_input(std::string name, std::optional<Shape> shape);

  /// An output whose shape, or boolean type, was not given. It is found by one call with the
  /// initial values of the block and inputs at zero.
  int add_output(std::string name, int function, std::optional<Shape> shape,
                 std::optional<bool> boolean, Reads reads,
                 std::shared_ptr<const LeafSystem> sampler, DerivativesFunction derivatives = {});

  /// Adds a function of `self`, the Python object of this block, or a compiled one. Returns its
  /// number.
  int add(py::handle self, py::object callable, Function function);
  VectorFunction vector_function(int k) const;
  MatrixFunction matrix_function(int k) const;
  ResetMap reset_map(int k) const;
  /// Of a function that saltus.derivatives made: it returns columns for its own inputs only.
  DerivativesFunction derivatives_function(int k) const;
  DeliveryMap delivery_map(int k) const;
  const std::vector<Function>& functions() const { return functions_; }
  const Function& function(int k) const { return functions_[k]; }
  /// A parameter called `out` is a parameter, not an array to fill.
  bool in_place(const Function& function) const {
    return function.in_place && !has_parameter("out");
  }

  void collect(Structure& out, const std::string& path) const override;
  std::string kind() const override;  // of the Python class

  /// Whether a run calls Python functions of this block.
  bool needs_interpreter() const {
    return std::ranges::any_of(functions_, [](const Function& f) { return f.compiled == nullptr; });
  }

  /// The garbage collector calls these two.
  int traverse(visitproc visit, void* argument) const;
  void clear() { functions_.clear(); }

 private:
  struct Unfinished {
    int output, function;
    bool shape, boolean;
  };

  py::object call(int k, const At& at, Index out_size) const;
  py::object vectorcall(const Function& function, const Frame& frame) const;
  py::list positional(const Function& function) const;
  [[noreturn]] void throw_raised(const Function& function, const Frame& frame) const;
  void fill(int k, const At& at, VectorRef out) const;
  void read_result(int k, const At& at, py::handle result, VectorRef out) const;
  void refuse_integer_truth(const Function& function, py::handle result, VectorRef out) const;
  void take_out(const Function& function, const Frame& frame, py::handle result,
                VectorRef out) const;
  Frame& prepare(std::unique_ptr<Frame>& frame, const Function& function, const At& at,
                 Index out_size) const;
  std::unique_ptr<Frame> new_frame(const Function& function) const;
  std::size_t set_inputs(Frame& frame, const Function& function, const At& at,
                         std::size_t place) const;
  void set_state(Frame& frame, const At& at) const;
  py::tuple truths(const At& at) const;
  void set_parameters(Frame& frame, const At& at, std::size_t place) const;
  void set_out(Frame& frame, const Function& function, Index size) const;
  void set_input(py::object& to, const At& at, int i) const;
  bool has_parameter(std::string_view parameter) const;
  /// The input of the block that a function gets as its i-th one; the weight is the last.
  static int input_of(const Function& function, std::size_t i, const At& at) {
    if (!function.inputs) return static_cast<int>(i);
    return i < function.inputs->size() ? (*function.inputs)[i] : at.u.size() - 1;
  }
  void forget_frames() {
    for (Function& function : functions_) function.spare.reset();
  }

  void run_compiled(const Function& function, const At& at, double* out) const;
  void reset_compiled(const Function& function, const At& at, Next& next) const;

  py::object call_with(int k, const std::vector<Shape>& shapes, const Eigen::VectorXd& u) const;
  std::optional<py::array> sample(int k, std::vector<Shape> shapes,
                                  std::span<const Index> widths) const;
  [[noreturn]] void throw_guess(const Function& function, const std::exception_ptr& raised) const;
  void explain_result(int k, const At& at, ModelError& error) const;
  Shape shape_of(int k, std::span<const Shape> inputs) const;
  bool means_discrete(const Function& function, bool has_x, bool has_z) const;
  void write(int k, py::handle result, Next& next) const;
  void require_shape(int k, const std::optional<Shape>& shape) const;
  Shape shape_of_result(int k, const std::optional<py::array>& found) const;
  bool gives_matrix(const Function& function) const;
  Dimensions expected_of(const Function& function, Index size) const;
  void finish_outputs();
  void finish(OutputDeclaration& output, const Unfinished& entry, const Declarations& declared);
  std::string whose(const Function& function) const {
    return text("block '", name(), "': ", function.what);
  }

  PyObject* self_ = nullptr;  // the Python object that owns this block
  mutable List<Function> functions_;
  std::vector<Unfinished> unfinished_;
  Dimensions x_dimensions_{0}, z_dimensions_{0};
  std::vector<Dimensions> parameter_dimensions_;
  py::tuple keywords_;  // names of the parameters
};

}  // namespace saltus::python
