// y = the number of edges of the trigger so far; with a limit it counts 0, 1, ..., limit - 1, 0, ...
#include "saltus/library/counter.hpp"

#include "saltus/library/detail/arguments.hpp"

namespace saltus {

Counter::Counter(std::string name, const Options& options) : LeafSystem(std::move(name)) {
  detail::insist(options.limit.value_or(1) > 0, this->name(), "limit = ", options.limit.value_or(1),
                 "; expected a whole number > 0");
  const int first = options.initial_state, limit = options.limit.value_or(first + 1);
  detail::insist(first < limit && (first >= 0.0 || !options.limit), this->name(),
                 "initial_state = ", first, "; expected 0 to limit - 1, with limit = ", limit);
  declare_discrete_state(Eigen::VectorXd::Constant(1, first));
  const int trigger = declare_input_port({.name = "trigger", .shape = Shape::scalar()});
  declare_edge_reset({.name = "count",
                      .input = trigger,
                      .edge = options.edge,
                      .reset_map =
                          [limit = options.limit](const At& at, Next& next) {
                            const double n = at.z[0] + 1.0;
                            next.set_discrete_state({limit && n >= *limit ? 0.0 : n});
                          },
                      .zeno_tolerance = 0.0,
                      .inputs = std::vector<int>{}});
  declare_output_port(
      {.name = "out", .reads = Reads::discrete_state, .view = Place{Space::z, 0, 1}});
}

}  // namespace saltus
