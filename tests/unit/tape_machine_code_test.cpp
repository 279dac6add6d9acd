// Tapes as text for a compiler, and tapes that run what a compiler made of it.
#include "saltus/tape/machine_code.hpp"

#include <algorithm>
#include <cctype>
#include <set>
#include <string>
#include <utility>

#include "saltus/base/error.hpp"
#include "saltus/tape/compile_cost.hpp"
#include "support/catch.hpp"
#include "support/expressions.hpp"
#include "support/tape_world.hpp"

using namespace saltus::tape;
using namespace support;
using Catch::Matchers::Contains;

namespace {

std::vector<Op> all_operations() {
  std::vector<Op> all;
  for (int op = static_cast<int>(Op::neg); op < operation_count; ++op)
    all.push_back(static_cast<Op>(op));
  return all;
}

Node applied(Graph& g, Op op, saltus::Index first) {
  std::vector<Node> operands;
  for (int k = 0; k < operand_count(op); ++k) operands.push_back(g.continuous_state(first + k));
  return g.apply(op, operands);
}

/// n rows of one operation: a run, for n of 4 or more.
Tape rows(Op op, int n) {
  Graph g;
  std::vector<Node> outputs;
  for (int i = 0; i < n; ++i) {
    std::vector<Node> operands;
    for (int k = 0; k < operand_count(op); ++k) operands.push_back(g.continuous_state(k * n + i));
    outputs.push_back(g.apply(op, operands));
  }
  return {g, outputs};
}

std::string text_of(const Tape& tape) { return llvm_module(std::span(&tape, 1)); }

/// The names in a text that begin so: "%v12", "@llvm.sqrt.f64".
std::vector<std::string> names(const std::string& text, const std::string& begin) {
  std::vector<std::string> found;
  const auto is_part = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.';
  };
  for (std::size_t at = text.find(begin); at != std::string::npos; at = text.find(begin, at + 1)) {
    std::size_t end = at + begin.size();
    while (end < text.size() && is_part(text[end])) ++end;
    found.push_back(text.substr(at, end - at));
  }
  return found;
}
/// The values that a line reads: the first letter says what defined them.
std::vector<std::string> values_in(const std::string& text) {
  std::vector<std::string> found;
  for (const char* letter : {"%v", "%i", "%c"})
    for (const std::string& name : names(text, letter))
      if (name.size() > 2 && std::isdigit(static_cast<unsigned char>(name[2])) != 0)
        found.push_back(name);
  return found;
}
std::size_t count(const std::string& text, const std::string& word) {
  std::size_t found = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1))
    ++found;
  return found;
}

/// Each value is defined once and before it is used; what is called is declared, and no function of
/// a library other than those of `called_functions`.
void check_well_formed(const std::string& module) {
  std::set<std::string> defined;
  std::size_t begin = 0;
  while (begin < module.size()) {
    const std::size_t end = module.find('\n', begin);
    std::string line = module.substr(begin, end - begin);
    begin = end + 1;
    if (line.rfind("define", 0) == 0) defined.clear();
    const std::size_t equals = line.find(" = ");
    const std::string uses = equals == std::string::npos ? line : line.substr(equals);
    if (line.find(" phi ") == std::string::npos) {
      for (const std::string& value : values_in(uses)) {
        INFO(line);
        REQUIRE(defined.contains(value));
      }
    }
    if (equals != std::string::npos) {
      INFO(line);
      REQUIRE(defined.insert(line.substr(2, equals - 2)).second);
    }
  }
  std::set<std::string> known;
  for (const auto& function : called_functions()) known.insert(std::string(function.name));
  for (std::size_t at = module.find(" call "); at != std::string::npos;
       at = module.find(" call ", at + 1)) {
    const std::string line = module.substr(at, module.find('\n', at) - at);
    const std::string called = names(line, "@").at(0).substr(1);
    CHECK((called.rfind("llvm.", 0) == 0 || known.contains(called)));
    CHECK_THAT(module, Contains("@" + called + "(double") || Contains("@" + called + "(<"));
  }
}

/// What a compiled tape was called with.
struct Seen {
  const double *x = nullptr, *p = nullptr, *z = nullptr;
  std::vector<double> inputs = {};
  double time = 0.0, mode = 0.0, entry = 0.0;
  int calls = 0;
};
Seen seen;

void compiled(const double* x, const double* p, const double* z, const double* const* u,
              double time, double mode, double entry, double* memory, double* out) {
  seen = {x, p, z, {u[0][0], u[1][0]}, time, mode, entry, seen.calls + 1};
  memory[0] = 1.0;
  out[0] = 42.0;
}

Tape of_inputs() {
  Graph g;
  return tape_of(g, {g.binary(Op::add, g.input(3, 0), g.input(1, 1))});
}

}  // namespace

TEST_CASE("every operation has well-formed text, alone, in lanes and in loops", "[tape]") {
  for (const Op op : all_operations()) {
    INFO(name(op));
    for (const int n : {1, 4, 7, 33, 66}) check_well_formed(text_of(rows(op, n)));
  }
}

TEST_CASE("no operation may be contracted, reordered or approximated", "[tape]") {
  for (const Op op : all_operations()) {
    const std::string module = text_of(rows(op, 7));
    for (const char* flag :
         {" fast ", "contract", "reassoc", " nnan", " ninf", " nsz", " arcp", " afn", "fmuladd"})
      CHECK_THAT(module, !Contains(flag));
  }
}

TEST_CASE("random expressions have well-formed text", "[tape]") {
  for (unsigned seed = 0; seed < 100; ++seed) {
    INFO("seed " << seed);
    Graph g;
    const auto outputs = write(random_expression(seed), g);
    check_well_formed(text_of(Tape(g, outputs)));
  }
}

TEST_CASE("a function of <cmath> is called by a name that LLVM does not know", "[tape]") {
  Graph g;
  const Tape tape = tape_of(g, {applied(g, Op::pow, 0), applied(g, Op::sin, 4)});
  CHECK_THAT(text_of(tape), Contains("call double @saltus_pow(double %v") &&
                                Contains("call double @saltus_sin(double %v") &&
                                Contains("declare double @saltus_pow(double, double)"));
}

TEST_CASE("the functions that machine code calls compute the operations", "[tape]") {
  for (const auto& [name, address] : called_functions()) {
    INFO(name);
    const Op op = known_operation(name.substr(std::string_view("saltus_").size()));
    Graph g;
    const double expected = values_of(tape_of(g, {applied(g, op, 0)}), {.x = {0.7, 0.3}})[0];
    if (operand_count(op) == 1)
      CHECK(same_bits(reinterpret_cast<double (*)(double)>(address)(0.7), expected));
    else
      CHECK(same_bits(reinterpret_cast<double (*)(double, double)>(address)(0.7, 0.3), expected));
  }
}

TEST_CASE("a run is text in lanes, a long one a loop, whatever its length", "[tape]") {
  CHECK_THAT(text_of(rows(Op::mul, 8)), Contains("fmul <4 x double>") && !Contains("phi"));
  const std::string loop = text_of(rows(Op::mul, 102));
  CHECK_THAT(loop, Contains("phi i64") && Contains("fmul <4 x double>"));
  CHECK(loop.size() < 3 * text_of(rows(Op::mul, 8)).size());
}

TEST_CASE("long runs that feed one another share a loop and store no more than is read", "[tape]") {
  Graph g;
  std::vector<Node> outputs;
  for (int i = 0; i < 100; ++i) {
    const Node x = g.continuous_state(i);
    outputs.push_back(g.binary(Op::sub, g.binary(Op::mul, x, x), g.parameter(0)));
  }
  const std::string module = text_of(Tape(g, outputs));
  check_well_formed(module);
  CHECK(count(module, "phi i64") == 1);
  CHECK(count(module, "store <4 x double>") == 1);
}

TEST_CASE("constants have all their bits", "[tape]") {
  Graph g;
  const Tape tape = tape_of(g, {g.binary(Op::mul, g.constant(0.1), g.continuous_state(0))});
  CHECK_THAT(text_of(tape), Contains("0x3FB999999999999A"));
}

TEST_CASE("a compiled tape gets the arrays it reads", "[tape]") {
  const Tape tape = of_inputs();
  const Tape copy = tape;
  compile({&tape, 1}, [](const std::string& module, int count) {
    CHECK(count == 1);
    CHECK_THAT(module, Contains("@saltus_tape_0("));
    return std::vector<MachineCode>{{&compiled, nullptr}};
  });
  CHECK(copy.is_machine_code());
  World world{.time = 3.0, .x = {1.0}, .z = {2.0}, .p = {3.0}};
  world.u = {{}, {4.0, 5.0}, {}, {6.0}};
  world.mode = 7, world.entry = 8;
  CHECK(values_of(copy, world) == std::vector<double>{42.0});
  CHECK((seen.x == world.x.data() && seen.z == world.z.data() && seen.p == world.p.data()));
  const auto read = tape.inputs_read();
  REQUIRE(read.size() == 2);
  for (const std::size_t k : {0U, 1U})
    CHECK(seen.inputs[k] == world.u[static_cast<std::size_t>(read[k])][0]);
  CHECK(seen.time == 3.0);
  CHECK(seen.mode == 7.0);
  CHECK(seen.entry == 8.0);
}

TEST_CASE("compiling asks once, for what is interpreted, and keeps the code as long as it runs",
          "[tape]") {
  const auto owner = std::make_shared<int>(1);
  int asked = 0;
  const Compiler compiler = [&](const std::string&, int count) {
    ++asked;
    return std::vector<MachineCode>(static_cast<std::size_t>(count), {&compiled, owner});
  };
  {
    const std::vector<Tape> tapes{of_inputs(), of_inputs()};
    compile(tapes, compiler);
    compile(tapes, compiler);
    CHECK(asked == 1);
    CHECK(owner.use_count() == 3);
  }
  CHECK(owner.use_count() == 1);
}

TEST_CASE("a compiler that returns another number of functions is refused", "[tape]") {
  const Tape tape = of_inputs();
  const auto compiling = [&] {
    compile({&tape, 1}, [](const std::string&, int) { return std::vector<MachineCode>{}; });
  };
  CHECK_THROWS_WITH(compiling(), "a compiler of tapes: expected 1 functions, found 0");
  CHECK_FALSE(tape.is_machine_code());
}

TEST_CASE("compiling pays once interpreting has cost as much", "[tape]") {
  const CompileCost cost{.instruction = 1e-9, .module = 5e-3, .line = 1e-5, .loading = 5e-2};
  struct Row {
    double interpreted, instructions;
    bool loaded, pays;
  };
  for (const Row& row :
       {Row{0.0, 10, true, false}, Row{5.0e6, 10, true, false}, Row{5.2e6, 10, true, true},
        Row{5.2e6, 10, false, false}, Row{5.6e7, 10, false, true}, Row{5.2e6, 1000, true, false}}) {
    CAPTURE(row.interpreted, row.instructions, row.loaded);
    CHECK(compiling_pays(row.interpreted, row.instructions, row.loaded, cost) == row.pays);
  }
}
