#include "saltus/tape/series.hpp"

#include <algorithm>

#include "kernel.hpp"
#include "saltus/base/error.hpp"

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

/// The place of order k among the handlers of a kernel.
constexpr std::size_t slot_of(int k) { return static_cast<std::size_t>(k < 4 ? k : 4 + k % 4); }
constexpr bool begins_block(int k) { return k >= 4 && k % 4 == 0; }

}  // namespace

Series::Series(const Graph& graph, std::span<const Node> rates, std::span<const Node> outputs)
    : program_(build(graph, rates, outputs)) {
  values_ = program_->constants;
  rows_.assign(size(program_->rows * row_size), 0.0);
  sums_.assign(program_->instructions.size() * sums_size, 0.0);
  computed_.assign(program_->values.size(), 0);
  done_.assign(program_->instructions.size(), 0);
  late_.reserve(done_.size());
  open_.reserve(done_.size());
}

int Series::states() const noexcept { return program_->states; }
int Series::outputs() const noexcept { return static_cast<int>(program_->outputs.size()); }

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
  compute_values(0, program.first_values);
  double* const rows = rows_.data();
  if (program.time_row != zero_row) rows[program.time_row + 1] = 1.0;
  const auto run = [&](const Calls& calls, int k) {
    calls.run(rows, sums_.data(), values_.data(), k);
  };
  run(program.calls.begin, 0);
  std::copy_n(values_.data(), n, x);
  for (int k = 0; k < order; ++k) {
    if (begins_block(k)) run(program.calls.earlier, k);
    if (k > 0) run(program.calls.orders[slot_of(k)], k);
    extend(k, held, x + (k + 1) * n);
  }
}

/// The coefficients of order k + 1 of the states.
void Series::extend(int k, const char* held, double* next) {
  double* const rows = rows_.data();
  const double* const values = values_.data();
  const double inverse = inverse_of(k + 1);
  double *to = rows + row_size + k + 1, *out = next;
  if (k == 0) {
    for (const Rate& rate : program_->rates) {
      *to = *out++ = values[rate.value];
      to += row_size;
    }
  } else {
    for (const Rate& rate : program_->rates) {
      *to = *out++ = values[rate.term.factor] * inverse * rows[rate.term.row + k];
      to += row_size;
    }
  }
  if (held == nullptr) return;
  for (int i = 0; i < states(); ++i) {
    if (held[i] != 0) next[i] = rows[row_size * (1 + i) + k + 1] = 0.0;
  }
}

/// Runs some instructions for one order; order 0 begins them.
void Series::run(const std::vector<int>& numbers, int k) {
  const auto call = [&](int i, Handler handler) {
    if (handler == nullptr) return;
    const Call alone[] = {{handler, &program_->instructions[size(i)], sums_size * i}, {&stop}};
    handler(alone, rows_.data(), sums_.data(), values_.data(), k);
  };
  const auto kernel = [&](int i) { return program_->instructions[size(i)].kernel; };
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
    (i < program_->first_instructions ? late_ : open_).push_back(i);
  }
}

void Series::expand_outputs(int first, int count, double* g) {
  late_.clear();
  open_.clear();
  for (int m = first; m < first + count; ++m) require(m);
  std::ranges::sort(late_);
  std::ranges::sort(open_);
  if (order_ > 0) run(late_, order_);
  for (int k = 0; k <= order_; ++k) run(open_, k);
  for (int m = first; m < first + count; ++m, g += order_ + 1) {
    const Output& output = program_->outputs[size(m)];
    std::copy_n(rows_.data() + output.row, order_ + 1, g);
    g[0] = values_[size(output.value)];
  }
}

}  // namespace saltus::tape
