// Calls a compiled function: its arguments have the layout that python/saltus/compiled.py
// documents.
#include <algorithm>

#include "python_leaf.hpp"

namespace saltus::python {

namespace {

/// Memory of this thread for the arguments of one call; a nested call gets other memory.
class CallMemory {
 public:
  CallMemory() : values(std::move(spare)) { values.clear(); }
  ~CallMemory() { spare = std::move(values); }
  CallMemory(const CallMemory&) = delete;
  CallMemory& operator=(const CallMemory&) = delete;

  void add(const VectorView& more) { values.insert(values.end(), more.begin(), more.end()); }

 private:
  static inline thread_local std::vector<double> spare;

 public:
  std::vector<double> values;
};

}  // namespace

void PythonLeaf::run_compiled(const Function& function, const At& at, double* out) const {
  CallMemory memory;
  memory.add(at.x), memory.add(at.z);
  memory.values.push_back(at.mode);
  memory.values.push_back(static_cast<double>(at.entry));
  const std::size_t u = memory.values.size();
  const std::size_t listed = function.inputs ? function.inputs->size() : 0;
  const std::size_t count = !function.inputs ? static_cast<std::size_t>(at.u.size())
                                             : listed + (gets_weight(function.role) ? 1 : 0);
  for (std::size_t i = 0; i < count; ++i) memory.add(at.u[input_of(function, i, at)]);
  const int failure = function.compiled(at.time, memory.values.data(), memory.values.data() + u,
                                        at.p.data(), out, function.user_data);
  if (failure == 0) return;
  throw SimulationError(text("t = ", at.time, " s: ", whose(function),
                             ": the compiled function returned ", failure, ", expected 0"),
                        at.time, name());
}

/// `out` begins as the present state, and the function changes some of it. The state that the map
/// is declared for always counts as written, the other states only if they differ.
void PythonLeaf::reset_compiled(const Function& function, const At& at, Next& next) const {
  Eigen::VectorXd after(at.x.size() + at.z.size() + 1);
  after << at.x, at.z, at.mode;
  run_compiled(function, at, after.data());
  const auto x = after.head(at.x.size()), z = after.segment(at.x.size(), at.z.size());
  const bool update = function.role == Role::update;
  if (x.size() > 0 && (!update || x != at.x)) next.set_continuous_state(x);
  if (z.size() > 0 && (update || z != at.z)) next.set_discrete_state(z);
  const double mode = after[after.size() - 1];
  if (mode == at.mode) return;
  if (mode != std::nearbyint(mode) || std::abs(mode) > 1e9)
    throw ModelError(text(whose(function), " set the mode ", mode, ", expected a whole number"));
  next.set_mode(static_cast<int>(mode));
}

}  // namespace saltus::python
