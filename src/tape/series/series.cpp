#include "saltus/tape/series.hpp"

#include <algorithm>

#include "kernel.hpp"
#include "saltus/base/error.hpp"
#include "wide.hpp"

namespace saltus::tape {

using namespace series;

namespace {

std::size_t size(Index count) { return static_cast<std::size_t>(count); }

double loaded(const Load& load, const At& at) {
  switch (load.op) {
    case Op::time:
      return at.time;
    case Op::discrete_state:
      return at.z[load.index];
    case Op::mode:
      return static_cast<double>(at.mode);
    case Op::entry:
      return static_cast<double>(at.entry);
    case Op::parameter:
      return at.p[load.index];
    default:
      return at.u[load.port][load.index];
  }
}

}  // namespace

Series::Series(const Graph& graph, std::span<const Node> rates, std::span<const Node> outputs)
    : program_(build(graph, rates, outputs)) {
  values_ = program_->constants;
  const auto rows = size(program_->rows * row_size);
  const auto sums = program_->instructions.size() * sums_size;
  const Wide* const wide = program_->wide.get();  // its memory follows the program of the other
  rows_.assign(rows + (wide == nullptr ? 0 : size(wide->rows * wide_row_size)), 0.0);
  sums_.assign(sums + (wide == nullptr ? 0 : size(wide->sums)), 0.0);
  computed_.assign(program_->values.size(), 0);
  done_.assign(program_->instructions.size(), 0);
  late_.reserve(done_.size());
  open_.reserve(done_.size());
}

bool SeriesOrder::is_machine_code() const noexcept {
  const Code* const code = program->compiled->code.load(std::memory_order_acquire);
  return code != nullptr && code->order == order && code->states != nullptr;
}
double SeriesOrder::instruction_count() const noexcept {
  const std::size_t count = program->wide == nullptr ? size(program->first_instructions)
                                                     : program->wide->instructions.size();
  return static_cast<double>(count) * order;
}

int Series::states() const noexcept { return program_->states; }
int Series::outputs() const noexcept { return static_cast<int>(program_->outputs.size()); }
int Series::instruction_count() const noexcept {
  if (program_->wide == nullptr) return program_->first_instructions;
  return static_cast<int>(program_->wide->instructions.size());
}

void Series::load(const At& at) {
  std::copy_n(at.x.data(), program_->states, values_.data());
  for (const Load& one : program_->loads) values_[size(one.to)] = loaded(one, at);
}

void Series::compute_values(int first, int last) {
  double* const values = values_.data();
  for (int i = first; i < last; ++i) {
    const Value& v = program_->values[size(i)];
    values[v.to] = v.run(values[v.from[0]], values[v.from[1]], values[v.from[2]]);
  }
}

void Series::expand(const At& at, int order, const char* held, double* x) {
  if (order < 0 || order > highest_order) {
    throw ModelError(
        text("a series expects an order from 0 to ", highest_order, ", found ", order));
  }
  const Program& program = *program_;
  const int n = program.states;
  ++expansion_;
  order_ = order;
  load(at);
  if (program.time_row != zero_row) rows_[size(program.time_row + 1)] = 1.0;
  if (program.wide != nullptr && program.wide->time >= 0)
    rows_[size(row_size * program.rows + program.wide->time + lanes)] = 1.0;
  std::copy_n(values_.data(), n, x);
  if (run_code(held, x)) return;
  compute_values(0, program.first_values);
  program.wide == nullptr ? expand_narrow(held, x + n) : expand_wide(held, x + n);
}

/// Whether machine code has expanded the states. It cannot hold a state.
bool Series::run_code(const char* held, double* x) {
  const Program& program = *program_;
  const Code* const code = program.compiled->code.load(std::memory_order_acquire);
  if (code == nullptr || code->order != order_ || code->states == nullptr || held != nullptr)
    return false;
  if (program.wide == nullptr)
    return code->states(values_.data(), rows_.data(), sums_.data(), x) != 0;
  double* const rows = rows_.data() + row_size * program.rows;
  double* const own = sums_.data() + size(sums_size) * program.instructions.size();
  if (code->states(values_.data(), rows, own, x) == 0) return false;
  if (!program.outputs.empty()) copy_states(x);
  return true;
}

/// Outputs read the states in their narrow rows.
void Series::copy_states(const double* x) {
  for (int k = 1; k <= order_; ++k) {
    x += states();
    for (int i = 0; i < states(); ++i) rows_[size(row_size * (1 + i) + k)] = x[i];
  }
}

/// Whether machine code has computed the outputs of this expansion.
bool Series::run_outputs_code() {
  if (all_outputs_ == expansion_) return true;
  const Code* const code = program_->compiled->code.load(std::memory_order_acquire);
  if (code == nullptr || code->order != order_ || code->outputs == nullptr) return false;
  if (code->outputs(values_.data(), rows_.data(), sums_.data(), nullptr) == 0) return false;
  all_outputs_ = expansion_;
  return true;
}

void Series::expand_narrow(const char* held, double* x) {
  double* const rows = rows_.data();
  const Program& program = *program_;
  const auto run = [&](const Calls& calls, int k) {
    calls.run(rows, sums_.data(), values_.data(), k);
  };
  run(program.calls.begin, 0);
  for (int k = 0; k < order_; ++k) {
    if (begins_block(k)) run(program.calls.earlier, k);
    if (k > 0) run(program.calls.orders[slot_of(k)], k);
    const double *const values = values_.data(), *const now = rows + k;
    double* to = rows + row_size + k + 1;
    const double* const end = x + program.states;
    for (const Rate* rate = program.rates.data(); x != end; ++rate, to += row_size) {
      *x++ = *to = slope_of(*rate, values, now, k);
    }
    if (held != nullptr) hold(held, k + 1, x - program.states);
  }
}

void Series::expand_wide(const char* held, double* x) {
  const Wide& wide = *program_->wide;
  const int n = program_->states;
  double* const rows = rows_.data() + row_size * program_->rows;
  double* const sums = sums_.data() + size(sums_size) * program_->instructions.size();
  const auto run = [&](const Calls& calls, int k) { calls.run(rows, sums, values_.data(), k); };
  run(wide.calls.begin, 0);
  for (int k = 0; k < order_; ++k, x += n) {
    if (begins_block(k)) run(wide.calls.earlier, k);
    if (k > 0) run(wide.calls.orders[slot_of(k)], k);
    double* const to = rows + lanes * (k + 1);
    for (int i = 0; i < n; ++i) {
      double& next = to[wide.place_of_state(i)];
      if (k == 0) next = values_[size(program_->rates[size(i)].value)];
      if (held != nullptr && held[i] != 0) next = 0.0;
      x[i] = next;
    }
    if (program_->outputs.empty()) continue;
    double* narrow = rows_.data() + row_size + k + 1;
    for (int i = 0; i < n; ++i, narrow += row_size) *narrow = x[i];
  }
}

/// The states that are held have no coefficients of order k.
void Series::hold(const char* held, int k, double* x) {
  for (int i = 0; i < states(); ++i) {
    if (held[i] != 0) x[i] = rows_[size(row_size * (1 + i) + k)] = 0.0;
  }
}

/// Runs some instructions for one order; order 0 begins them.
void Series::run(const std::vector<int>& numbers, int k) {
  const auto call = [&](int i, Handler handler) {
    if (handler == nullptr) return;
    const Call alone[] = {{handler, &program_->instructions[size(i)], sums_size * i}, {&stop}};
    handler(alone, rows_.data(), sums_.data(), values_.data(), k);
  };
  const auto kernel = [&](int i) { return &program_->instructions[size(i)].kernel->narrow; };
  if (k == 0) {
    for (const int i : numbers) call(i, kernel(i)->begin);
    return;
  }
  if (begins_block(k)) {
    for (const int i : numbers) call(i, kernel(i)->earlier);
  }
  for (const int i : numbers) call(i, kernel(i)->orders[slot_of(k)]);
}

void Series::require(int output) {
  for (const int i : program_->outputs[size(output)].values) {
    if (std::exchange(computed_[size(i)], expansion_) != expansion_) compute_values(i, i + 1);
  }
  for (const int i : program_->outputs[size(output)].instructions) {
    if (std::exchange(done_[size(i)], expansion_) == expansion_) continue;
    (i < program_->first_narrow() ? late_ : open_).push_back(i);
  }
}

void Series::interpret_outputs(int first, int count) {
  late_.clear();
  open_.clear();
  for (int m = first; m < first + count; ++m) require(m);
  std::ranges::sort(late_);
  std::ranges::sort(open_);
  if (order_ > 0) run(late_, order_);
  for (int k = 0; k <= order_; ++k) run(open_, k);
}

void Series::expand_outputs(int first, int count, double* g) {
  if (first < 0 || count < 0 || count > outputs() - first) {
    throw ModelError(text("a series of ", outputs(), " outputs was asked for ", count,
                          " of them from number ", first, " on"));
  }
  if (!run_outputs_code()) interpret_outputs(first, count);
  for (int m = first; m < first + count; ++m, g += order_ + 1) {
    const Output& output = program_->outputs[size(m)];
    std::copy_n(rows_.data() + output.row, order_ + 1, g);
    g[0] = values_[size(output.value)];
  }
}

}  // namespace saltus::tape
