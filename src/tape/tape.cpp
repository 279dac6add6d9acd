#include "saltus/tape/tape.hpp"
#include "saltus/base/list.hpp"

#include <algorithm>
#include <mutex>
#include <utility>

#include "program.hpp"
#include "saltus/base/error.hpp"

namespace saltus::tape {

Tape::Tape(const Graph& graph, std::span<const Node> outputs, std::span<const Index> places) {
  if (!places.empty() && places.size() != outputs.size()) {
    throw ModelError(text("a tape of ", outputs.size(), " values expects as many places, found ",
                          places.size()));
  }
  const auto program = std::make_shared<detail::Program>();
  detail::build(*program, graph, outputs, places);
  program_ = program;
}

Index Tape::size() const noexcept { return static_cast<Index>(program_->outputs.size()); }
int Tape::instruction_count() const noexcept { return static_cast<int>(program_->lines.size()); }
Reads Tape::reads() const noexcept { return program_->reads; }
bool Tape::reads_input(int k) const noexcept {
  return std::ranges::find(program_->inputs, k) != program_->inputs.end();
}
bool Tape::reads_parameter() const noexcept { return program_->p > 0; }
bool Tape::reads_entry() const noexcept { return program_->reads_entry; }
const Graph& Tape::graph() const noexcept { return program_->graph; }
const std::vector<Node>& Tape::outputs() const noexcept { return program_->outputs; }

const std::vector<int>& Tape::inputs_read() const noexcept { return program_->inputs; }
std::size_t Tape::memory_size() const noexcept { return program_->registers; }

bool Tape::is_machine_code() const noexcept {
  return program_->compiled.run.load(std::memory_order_relaxed) != nullptr;
}

void Tape::run_as(MachineCode code) const {
  static std::mutex one_at_a_time;
  const std::scoped_lock lock(one_at_a_time);
  if (is_machine_code()) return;
  program_->compiled.owner = std::move(code.owner);
  program_->compiled.run.store(code.run, std::memory_order_release);
}

void Tape::check(const At& at) const {
  const auto expect = [](const std::string& what, Index needed, Index found) {
    if (found >= needed) return;
    throw ModelError(text("a tape that reads entry ", needed - 1, " of the ", what,
                          " expects at least ", needed, " of them, found ", found));
  };
  expect("continuous state", program_->x, at.x.size());
  expect("discrete state", program_->z, at.z.size());
  expect("parameters", program_->p, at.p.size());
  for (std::size_t i = 0; i < program_->inputs.size(); ++i) {
    const int port = program_->inputs[i];
    if (port >= at.u.size()) {
      throw ModelError(text("a tape that reads input ", port, " expects at least ", port + 1,
                            " inputs, found ", at.u.size()));
    }
    expect(text("input ", port), program_->widths[i], at.u[port].size());
  }
}

std::vector<std::vector<int>> Tape::states_read() const {
  std::vector<std::vector<int>> states;
  List<int> seen(graph().size(), -1), open;
  for (const Node output : outputs()) {
    const int number = static_cast<int>(states.size());
    std::vector<int>& found = states.emplace_back();
    const auto visit = [&](Node node) {
      if (std::exchange(seen[node.id], number) != number) open.push_back(node.id);
    };
    for (visit(output); !open.empty();) {
      const Expression& expression = graph()[Node{open.back()}];
      open.pop_back();
      if (expression.op == Op::continuous_state)
        found.push_back(static_cast<int>(expression.index));
      for (int k = 0; k < operand_count(expression.op); ++k) visit(nth(expression.operands, k));
    }
    std::ranges::sort(found);
  }
  return states;
}

}  // namespace saltus::tape
