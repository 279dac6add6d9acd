// check_derivatives: each function with declared derivatives, once with them and once without.
#include "saltus/simulation/check_derivatives.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "saltus/simulation/detail/called_derivatives.hpp"
#include "saltus/simulation/detail/declared_derivatives.hpp"
#include "saltus/simulation/detail/standstill.hpp"

namespace saltus {

namespace {

class DerivativeCheck {
 public:
  DerivativeCheck(const System& system, const Context& context, double tolerance)
      : at_(compile(system)),
        machine_(at_.machine()),
        probe_(machine_),
        of_called_(machine_, probe_),
        tolerance_(tolerance) {
    at_.begin(context);
    for (const int i : machine_.plan().order) evaluate(i);
    probe_.note(machine_.x.data(), 0.0);
  }

  std::vector<WrongDerivative> run() {
    const Plan& plan = machine_.plan();
    for (const int leaf : plan.odes) check(function_of_rates(plan, leaf));
    for (const int i : plan.order)
      if (!plan.node(i).view && !plan.node(i).relation) check(function_of_node(plan, i));
    for (const GuardGroup& group : plan.guards) {
      if (!group.is_crossing()) continue;
      check(function_of_guard(plan, group));
      check_reset(group);
    }
    return std::move(wrong_);
  }

 private:
  /// The values that functions read, at this state; what is held keeps its value.
  void evaluate(int number) {
    const Node& node = machine_.plan().node(number);
    if (node.view || node.relation || node.located) return;
    const OutputDeclaration& output = machine_.plan().output_of(node);
    if (!samples(output.reads))
      call(output.calc, node.leaf, machine_.signal(number), node.place.size);
  }
  void call(const VectorFunction& function, int leaf, double* out, Index size) {
    const At at = machine_.at(leaf, at_.time(), machine_.x.data());
    function(*machine_.plan().leaf(leaf).system, at, VectorRef(out, size));
  }

  void check_reset(const GuardGroup& group) {
    const ZeroCrossing& crossing = machine_.plan().crossing_of(group);
    if (!crossing.reset_derivatives) return;
    const PlanLeaf& leaf = machine_.plan().leaf(group.leaf);
    const VectorFunction next = [&crossing, &leaf](const At& at, VectorRef out) {
      out << at.x, at.z;
      int mode = at.mode;
      Next to(VectorRef(out.data(), leaf.nx), VectorRef(out.data() + leaf.nx, leaf.nz), mode,
              leaf.path);
      crossing.reset_map(*leaf.system, at, to);
    };
    LeafFunction function{.name = text("the reset map of '", group.name, "'"),
                          .leaf = group.leaf,
                          .size = leaf.nx + leaf.nz,
                          .call = &next,
                          .derivatives = &crossing.reset_derivatives};
    each_column(leaf, [&](Index, const Place& place) {
      function.reads.push_back({place.space, place.offset});
    });
    std::ranges::sort(function.reads);
    function.reads.erase(std::ranges::unique(function.reads).begin(), function.reads.end());
    check(function);
  }

  void check(LeafFunction function) {
    if (!function.declares_derivatives() && !function.jacobian) return;
    function.partials.reset();
    const auto all = [](const ReadValue&) { return true; };
    const Eigen::MatrixXd declared = of_called_.of(function, at_.time(), all);
    const LeafFunction opaque{.name = function.name,
                              .leaf = function.leaf,
                              .size = function.size,
                              .call = function.call,
                              .reads = function.reads};
    const Eigen::MatrixXd found = of_called_.of(opaque, at_.time(), all);
    Eigen::VectorXd values(function.size);
    call(*function.call, function.leaf, values.data(), function.size);
    const Eigen::VectorXd sizes = sizes_of(declared, found, values);
    for (Index k = 0; k < declared.cols(); ++k)
      compare(function, name_of(function, nth(function.reads, k)), sizes, declared.col(k),
              found.col(k));
    if (function.declares_derivatives()) check_time(function, sizes);
  }

  void check_time(const LeafFunction& function, const Eigen::VectorXd& sizes) {
    const PlanLeaf& leaf = machine_.plan().leaf(function.leaf);
    const At at = machine_.at(function.leaf, at_.time(), machine_.x.data());
    const Eigen::MatrixXd declared =
        declared_derivatives(leaf, *function.derivatives, at, function.size, function.name);
    Eigen::VectorXd found(function.size);
    const auto read = [&](Machine& probe, double shift, double* out) {
      (*function.call)(*leaf.system, probe.at(function.leaf, at_.time() + shift, probe.x.data()),
                       VectorRef(out, function.size));
    };
    probe_.derivative(machine_.x.data(), {.t = 1.0}, function.size, read, found.data());
    compare(function, "time", sizes, declared.rightCols(1), found);
  }

  /// Of each row: its largest entry, or its number.
  static Eigen::VectorXd sizes_of(const Eigen::MatrixXd& declared, const Eigen::MatrixXd& found,
                                  const Eigen::VectorXd& values) {
    Eigen::VectorXd sizes = values.cwiseAbs();
    for (Index i = 0; i < sizes.size(); ++i) {
      for (Index k = 0; k < declared.cols(); ++k) {
        sizes[i] = std::max(sizes[i], std::abs(declared(i, k)));
        if (std::isfinite(found(i, k))) sizes[i] = std::max(sizes[i], std::abs(found(i, k)));
      }
    }
    return sizes;
  }

  void compare(const LeafFunction& function, const std::string& by, const Eigen::VectorXd& sizes,
               const Eigen::VectorXd& declared, const Eigen::VectorXd& found) {
    for (Index i = 0; i < function.size; ++i) {
      if (std::abs(declared[i] - found[i]) <= tolerance_ * sizes[i]) continue;
      wrong_.push_back({function.name, by, i, declared[i], found[i]});
    }
  }

  std::string name_of(const LeafFunction& function, const ReadValue& read) const {
    const PlanLeaf& leaf = machine_.plan().leaf(function.leaf);
    std::string name;
    each_column(leaf, [&](Index column, const Place& place) {
      if (name.empty() && place.space == read.space && place.offset == read.index)
        name = name_of_column(leaf, column);
    });
    return name;
  }

  Standstill at_;
  Machine& machine_;
  TangentProbe probe_;
  CalledDerivatives of_called_;
  double tolerance_;
  std::vector<WrongDerivative> wrong_;
};

}  // namespace

std::vector<WrongDerivative> check_derivatives(const System& system, const Context& context,
                                               double tolerance) {
  return DerivativeCheck(system, context, tolerance).run();
}

}  // namespace saltus
