#include "write.hpp"

#include <algorithm>

#include "kernel.hpp"
#include "saltus/base/error.hpp"
#include "shared.hpp"

namespace saltus::tape::series {

namespace {

/// An instruction, and the place of its numbers.
struct Step {
  const Instruction* instruction;
  Index own;

  void write(SeriesWriter& writer, WriteHandler handler, Index k) const {
    if (handler != nullptr) handler(writer, *instruction, own, k);
  }
  const WriteHandlers& handlers() const { return instruction->kernel->written; }
};
using Steps = std::vector<Step>;

bool has_machine_code(const Instruction& i) {
  const bool decided = i.kernel != &choice || (i.c == zero_row && i.d == zero_row);
  return i.kernel->written.orders[1] != nullptr && decided;
}

class Expanding {
 public:
  Expanding(const Program& program, int order, const std::string& name)
      : program_(program), order_(order), name_(name), writer_(program), shared_(program, name) {}

  std::string states(std::set<std::string>& declarations) {
    const Wide* const wide = program_.wide.get();
    if (wide != nullptr) writer_.width = static_cast<int>(lanes);
    const Steps steps = wide != nullptr ? steps_of(*wide) : narrow(0, program_.first_instructions);
    if (!can_be_written(steps)) return {};
    for (int i = 0; i < program_.first_values; ++i) write_value(i);
    begin(steps);
    for (int k = 0; k < order_; ++k) {
      if (k > 0) write_order(steps, k);
      wide != nullptr ? write_wide_states(*wide, k) : write_states(k);
      writer_.pause();
    }
    return finished(declarations);
  }

  std::string outputs(std::set<std::string>& declarations) {
    Steps late, open;
    for (const int i : all_of(&Output::instructions)) {
      const Steps one = narrow(i, i + 1);
      Steps& steps = i < program_.first_narrow() ? late : open;
      steps.insert(steps.end(), one.begin(), one.end());
    }
    Steps all = open;
    all.insert(all.end(), late.begin(), late.end());
    if (program_.outputs.empty() || !can_be_written(all)) return {};
    for (const int i : all_of(&Output::values)) write_value(i);
    begin(open);
    if (order_ > 0) write_order(late, order_);
    for (int k = 1; k <= order_; ++k) {
      write_order(open, k);
      writer_.pause();
    }
    return finished(declarations);
  }

 private:
  /// A longer function is compiled without some passes, which takes a third of the time; it is then
  /// 15 to 25 % slower.
  static constexpr std::size_t longest_optimised = 1200;  // lines
  /// If the function would be longer, alike instructions of four lanes share the code of their
  /// recurrences. Instructions of one lane do not share it: they would then take longer than the
  /// interpreter.
  static constexpr std::size_t longest_unshared = 9000;
  /// Longer functions are not written: they would compile in 0.15 to 0.2 s.
  static constexpr std::size_t longest = 40000;

  /// Decides also whether code is shared.
  bool can_be_written(const Steps& steps) {
    const auto orders = static_cast<std::size_t>(order_);
    // a recurrence of order k has k products: 2 to 3 lines for each product
    const std::size_t unshared = 3 * steps.size() * orders * orders;
    shares_ = writer_.width > 1 && unshared > longest_unshared;
    const std::size_t lines = shares_ ? 20 * steps.size() * orders : unshared;
    return lines < longest && std::ranges::all_of(steps, [](const Step& s) {
             return has_machine_code(*s.instruction);
           });
  }

  Steps narrow(int first, int last) const {
    Steps steps;
    for (int i = first; i < last; ++i)
      steps.push_back({&program_.instructions[static_cast<std::size_t>(i)], sums_size * i});
    return steps;
  }
  static Steps steps_of(const Wide& wide) {
    Steps steps;
    for (std::size_t i = 0; i < wide.instructions.size(); ++i)
      steps.push_back({&wide.instructions[i], wide.own[i]});
    return steps;
  }
  std::vector<int> all_of(std::vector<int> Output::*numbers) const {
    std::set<int> all;
    for (const Output& output : program_.outputs)
      all.insert((output.*numbers).begin(), (output.*numbers).end());
    return {all.begin(), all.end()};
  }

  void write_value(int number) {
    const Value& value = program_.values[static_cast<std::size_t>(number)];
    std::vector<Written> operands;
    for (int k = 0; k < operand_count(value.op); ++k)
      operands.push_back(writer_.value(value.from[k]));
    writer_.store(Memory::values, value.to, writer_.apply(value.op, operands));
  }
  void begin(const Steps& steps) {
    for (const Step& step : steps) step.write(writer_, step.handlers().begin, 0);
  }
  void write_order(const Steps& steps, int k) {
    if (begins_block(k))
      for (const Step& step : steps) write(step, step.handlers().earlier, k);
    for (const Step& step : steps) write(step, step.handlers().orders[slot_of(k)], k);
  }
  void write(const Step& step, WriteHandler handler, int k) {
    const Instruction& i = *step.instruction;
    if (shares_ && SharedRecurrences::takes(i))
      shared_.call(writer_, i, step.own, handler, k);
    else
      step.write(writer_, handler, k);
  }

  void write_states(int k) {
    const WrittenNumbers values{&writer_, Memory::values, 0}, rows{&writer_, Memory::rows, k};
    for (int i = 0; i < program_.states; ++i) {
      const Written next = slope_of(program_.rates[static_cast<std::size_t>(i)], values, rows, k);
      writer_.store(Memory::rows, row_size * (1 + i) + k + 1, next);
      writer_.store(Memory::x, Index{k + 1} * program_.states + i, next);
    }
  }
  /// The last instructions have computed the states, except for order 1.
  void write_wide_states(const Wide& wide, int k) {
    const auto place = [&](Index i) { return wide.place_of_state(i) + lanes * (k + 1); };
    for (int i = 0; k == 0 && i < program_.states; ++i) {
      const Index rate = program_.rates[static_cast<std::size_t>(i)].value;
      writer_.store(Memory::rows, place(i), writer_.value(rate));
    }
    for (Index i = 0; i < program_.states; i += lanes) {
      const Index to = Index{k + 1} * program_.states + i;
      if (i + lanes <= program_.states) {
        const std::array<Index, lanes> all{place(i), place(i + 1), place(i + 2), place(i + 3)};
        writer_.store(Memory::x, to, writer_.gathered(Memory::rows, all));
        continue;
      }
      for (Index l = 0; i + l < program_.states; ++l)
        writer_.store(Memory::x, to + l, writer_.read(Memory::rows, place(i + l), 1));
    }
  }

  std::string finished(std::set<std::string>& declarations) {
    detail::LlvmText& body = writer_.text();
    declarations.insert(body.declarations().begin(), body.declarations().end());
    const auto lines = std::ranges::count(body.body(), '\n');
    const bool quick = static_cast<std::size_t>(lines) > longest_optimised;
    return text(
        shared_.functions(), "define i32 @", name_,
        "(ptr noalias %values, ptr noalias %rows, ptr noalias %own, ptr noalias %x) nounwind",
        quick ? " noinline optnone" : "", " {\nbegin:\n", body.body(),
        "  ret i32 1\nleave:\n  ret i32 0\n}\n");
  }

  const Program& program_;
  int order_;
  std::string name_;
  SeriesWriter writer_;
  SharedRecurrences shared_;
  bool shares_ = false;
};

}  // namespace

std::string llvm_states(const Program& program, int order, const std::string& name,
                        std::set<std::string>& declarations) {
  return Expanding(program, order, name).states(declarations);
}
std::string llvm_outputs(const Program& program, int order, const std::string& name,
                         std::set<std::string>& declarations) {
  return Expanding(program, order, name).outputs(declarations);
}

}  // namespace saltus::tape::series
