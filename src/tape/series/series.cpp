#include "saltus/tape/series.hpp"

#include <algorithm>

#include "kernel.hpp"
#include "saltus/base/error.hpp"

namespace saltus::tape {

using namespace series;

namespace {

std::size_t size(int count) { return static_cast<std::size_t>(count); }

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

/// Orders that follow one another, for instructions that do not depend on the states.
struct Run {
  const Program& program;
  double *rows, *sums;
  const double* values;

  void one(int number, Handler handler, int k) const {
    const Instruction& i = program.instructions[size(number)];
    if (handler != nullptr) handler(i, rows, sums + sums_size * number, values, k);
  }
  const Kernel& kernel(int number) const { return *program.instructions[size(number)].kernel; }
  void begin(int number) const { one(number, kernel(number).begin, 0); }
  void earlier(int number, int k) const { one(number, kernel(number).earlier, k); }
  void order(int number, int k) const {
    one(number, kernel(number).orders[k < 4 ? k : 4 + k % 4], k);
  }
  template <class Numbers>
  void order_of_all(const Numbers& numbers, int k) const {
    if (k >= 4 && k % 4 == 0) {
      for (const int number : numbers) earlier(number, k);
    }
    for (const int number : numbers) order(number, k);
  }
};

/// 0, 1, ... as a range.
struct Upto {
  struct Iterator {
    int i;
    int operator*() const { return i; }
    void operator++() { ++i; }
    bool operator!=(const Iterator& other) const { return i != other.i; }
  };
  int count;
  Iterator begin() const { return {0}; }
  Iterator end() const { return {count}; }
};

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
  const Run run{program, rows, sums_.data(), values_.data()};
  for (int i = 0; i < program.first_instructions; ++i) run.begin(i);
  std::copy_n(values_.data(), n, x);
  for (int k = 0; k < order; ++k) {
    if (k > 0) run.order_of_all(Upto{program.first_instructions}, k);
    double* const next = x + (k + 1) * n;
    for (int i = 0; i < n; ++i) {
      const Rate& rate = program.rates[size(i)];
      const double slope = k == 0 ? values_[size(rate.value)] : rows[rate.row + k];
      const bool holds = held != nullptr && held[i] != 0;
      next[i] = rows[row_size * (1 + i) + k + 1] = holds ? 0.0 : slope * inverse_of(k + 1);
    }
  }
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
  const Run run{*program_, rows_.data(), sums_.data(), values_.data()};
  if (order_ > 0) run.order_of_all(late_, order_);
  for (const int i : open_) run.begin(i);
  for (int k = 1; k <= order_; ++k) run.order_of_all(open_, k);
  for (int m = first; m < first + count; ++m, g += order_ + 1) {
    const Output& output = program_->outputs[size(m)];
    std::copy_n(rows_.data() + output.row, order_ + 1, g);
    g[0] = values_[size(output.value)];
  }
}

}  // namespace saltus::tape
