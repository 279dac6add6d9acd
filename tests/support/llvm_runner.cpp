#include "support/llvm_runner.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace support {

namespace {

using saltus::tape::MachineCode;

struct Value {
  std::array<double, 4> lanes{};
  double* address = nullptr;
  bool truth = false;
  const long* table = nullptr;  // a place in it
  long integer = 0;
};

/// The parts of a text between separators outside of brackets.
std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> parts(1);
  int depth = 0;
  for (const char c : text) {
    depth += c == '<' || c == '(' ? 1 : c == '>' || c == ')' ? -1 : 0;
    if (c == ',' && depth == 0)
      parts.emplace_back();
    else if (c != ' ' || !parts.back().empty())
      parts.back() += c;
  }
  return parts;
}
/// The text after the type, if there is a type.
std::string last_word(const std::string& text) {
  if (text.ends_with(">")) {
    const std::size_t from = text.rfind('<');
    return text.substr(from);
  }
  return text.substr(text.rfind(' ') + 1);
}

using Lines = std::vector<std::string>;
/// Functions that the functions of a module call, and tables, by name.
struct Shared {
  std::map<std::string, Lines> functions;
  std::map<std::string, std::vector<long>> tables;
};
struct Function {
  Lines lines;
  std::shared_ptr<const Shared> shared;
};

class Run {
 public:
  Run(const Lines& lines, const Shared& shared, const std::map<std::string, Value>& arguments)
      : lines_(lines), shared_(shared), values_(arguments) {
    for (std::size_t i = 0; i < lines.size(); ++i)
      if (lines[i].ends_with(":")) labels_[lines[i].substr(0, lines[i].size() - 1)] = i;
  }

  int result() {
    for (std::size_t i = 0;; ++i) {
      const std::string& line = lines_.at(i);
      if (line == "  ret void") return 1;
      if (line.starts_with("  ret i32 ")) return std::stoi(line.substr(10));
      if (line.starts_with("  br ")) {
        i = target(line);
      } else if (line.starts_with("  store ")) {
        store(split(line.substr(8)));
      } else if (line.starts_with("  call void ")) {
        call(line.substr(12));
      } else if (line.starts_with("  %")) {
        define(line);
      } else if (!line.ends_with(":")) {
        throw std::runtime_error("unknown line: " + line);
      }
    }
  }

 private:
  /// "@name(ptr %rows, ptr %own, ptr @table)"
  void call(const std::string& text) {
    const std::size_t open = text.find('(');
    const auto parts = split(text.substr(open + 1, text.size() - open - 2));
    Run(shared_.functions.at(text.substr(0, open)), shared_,
        {{"%rows", of("%rows")}, {"%own", of("%own")}, {"%table", {.table = table(parts[2])}}})
        .result();
  }
  const long* table(const std::string& text) { return shared_.tables.at(last_word(text)).data(); }

  std::size_t target(const std::string& line) {
    const auto parts = split(line.substr(5));
    const bool first = parts.size() == 1 || of(last_word(parts[0])).truth;
    return labels_.at(last_word(parts[first && parts.size() > 1 ? 1 : parts.size() - 1]).substr(1));
  }

  void store(const std::vector<std::string>& parts) {
    const int count = parts[0].starts_with("<") ? 4 : 1;
    const Value& value = of(last_word(parts[0]));
    double* const to = of(last_word(parts[1])).address;
    for (int l = 0; l < count; ++l) to[l] = value.lanes[static_cast<std::size_t>(l)];
  }

  static double number(const std::string& word) {
    return std::bit_cast<double>(std::stoull(word.substr(2), nullptr, 16));
  }
  const Value& of(const std::string& word) {
    if (word.starts_with("%")) return values_.at(word);
    Value& made = values_[word];
    if (word.starts_with("0x")) made.lanes.fill(number(word));
    if (word.starts_with("<")) {
      const auto parts = split(word.substr(1, word.size() - 2));
      for (std::size_t l = 0; l < 4; ++l) made.lanes[l] = number(last_word(parts[l]));
    }
    return made;
  }

  void define(const std::string& line) {
    const std::size_t equals = line.find(" = ");
    const std::string text = line.substr(equals + 3), operation = text.substr(0, text.find(' '));
    const auto parts = split(text.substr(operation.size() + 1));
    values_[line.substr(2, equals - 2)] = computed(operation, parts);
  }

  Value computed(const std::string& operation, const std::vector<std::string>& parts) {
    const bool reads = operation != "call" && operation != "load";
    const Value a = reads ? of(last_word(parts[0])) : Value{};
    const Value b = parts.size() > 1 && operation != "load" ? of(last_word(parts[1])) : Value{};
    Value out;
    if (operation == "getelementptr" && b.table != nullptr) {
      out.table = b.table + std::stol(last_word(parts[2]));
    } else if (operation == "getelementptr") {
      const std::string offset = last_word(parts[2]);
      out.address = b.address + (offset[0] == '%' ? of(offset).integer : std::stol(offset));
    } else if (operation == "load" && parts[0] == "i64") {
      out.integer = *of(last_word(parts[1])).table;
    } else if (operation == "load") {
      const double* const from = of(last_word(parts[1])).address;
      const int count = parts[0].starts_with("<") ? 4 : 1;
      for (int l = 0; l < count; ++l) out.lanes[static_cast<std::size_t>(l)] = from[l];
    } else if (operation == "insertelement") {
      out = a;
      out.lanes[static_cast<std::size_t>(std::stoi(last_word(parts[2])))] = b.lanes[0];
    } else if (operation == "extractelement") {
      out.lanes.fill(a.lanes[static_cast<std::size_t>(std::stoi(last_word(parts[1])))]);
    } else if (operation == "shufflevector") {
      out.lanes.fill(a.lanes[0]);
    } else if (operation == "fcmp") {
      out.truth = compared(parts[0].substr(0, 3), a.lanes[0], b.lanes[0]);
    } else if (operation == "and" || operation == "or") {
      out.truth = operation == "or" ? a.truth || b.truth : a.truth && b.truth;
    } else if (operation == "select") {
      out = a.truth ? b : of(last_word(parts[2]));
    } else if (operation == "call") {
      out.lanes[0] = called(parts[0]);
    } else {
      for (std::size_t l = 0; l < 4; ++l)
        out.lanes[l] = arithmetic(operation, a.lanes[l], b.lanes[l]);
    }
    return out;
  }

  static double arithmetic(const std::string& operation, double a, double b) {
    if (operation == "fadd") return a + b;
    if (operation == "fsub") return a - b;
    if (operation == "fmul") return a * b;
    if (operation == "fdiv") return a / b;
    if (operation == "fneg") return -a;
    throw std::runtime_error("unknown operation: " + operation);
  }
  static bool compared(const std::string& how, double a, double b) {
    const std::map<std::string, bool> results{
        {"oeq", a == b}, {"olt", a < b},  {"ole", a <= b},          {"ogt", a > b},
        {"oge", a >= b}, {"une", a != b}, {"uno", a != a || b != b}};
    return results.at(how);
  }
  /// "double @name(double %v0, double %v1)"
  double called(const std::string& text) {
    const std::size_t at = text.find('@'), open = text.find('(');
    const std::string name = text.substr(at + 1, open - at - 1);
    const auto parts = split(text.substr(open + 1, text.size() - open - 2));
    const double a = of(last_word(parts[0])).lanes[0];
    const double b = parts.size() > 1 ? of(last_word(parts[1])).lanes[0] : 0.0;
    for (const auto& function : saltus::tape::called_functions()) {
      if (function.name != name) continue;
      if (parts.size() == 1) return reinterpret_cast<double (*)(double)>(function.address)(a);
      return reinterpret_cast<double (*)(double, double)>(function.address)(a, b);
    }
    return intrinsic(name, a, b);
  }
  static double intrinsic(const std::string& name, double a, double b) {
    if (name == "llvm.sqrt.f64") return std::sqrt(a);
    if (name == "llvm.fabs.f64") return std::fabs(a);
    if (name == "llvm.floor.f64") return std::floor(a);
    if (name == "llvm.ceil.f64") return std::ceil(a);
    if (name == "llvm.trunc.f64") return std::trunc(a);
    if (name == "llvm.nearbyint.f64") return std::nearbyint(a);
    if (name == "llvm.copysign.f64") return std::copysign(a, b);
    throw std::runtime_error("unknown function: " + name);
  }

  const Lines& lines_;
  const Shared& shared_;
  std::map<std::string, Value> values_;
  std::map<std::string, std::size_t> labels_;
};

constexpr std::size_t most_functions = 64;
std::array<Function, most_functions> all_functions;
std::size_t next_function = 0;

/// A function of the processor for each text.
template <std::size_t number>
int of_text(double* values, double* rows, double* own, double* x) {
  const Function& function = all_functions[number];
  return Run(function.lines, *function.shared,
             {{"%values", {.address = values}},
              {"%rows", {.address = rows}},
              {"%own", {.address = own}},
              {"%x", {.address = x}}})
      .result();
}
using Address = int (*)(double*, double*, double*, double*);
constexpr auto addresses = []<std::size_t... i>(std::index_sequence<i...>) {
  return std::array<Address, most_functions>{&of_text<i>...};
}(std::make_index_sequence<most_functions>{});

/// "@name = private unnamed_addr constant [2 x i64] [i64 0, i64 4]"
void read_table(const std::string& line, Shared& shared) {
  const std::size_t open = line.rfind('[');
  auto& table = shared.tables[line.substr(0, line.find(' '))];
  for (const std::string& entry : split(line.substr(open + 1, line.size() - open - 2)))
    table.push_back(std::stol(last_word(entry)));
}

}  // namespace

std::vector<MachineCode> run_as_text(const std::string& module, int count) {
  std::vector<MachineCode> codes;
  std::istringstream lines(module);
  const auto shared = std::make_shared<Shared>();
  Lines* text = nullptr;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("define private ")) {
      const std::size_t at = line.find('@');
      text = &shared->functions[line.substr(at, line.find('(') - at)];
    } else if (line.starts_with("define ")) {
      all_functions[next_function] = {{}, shared};
      text = &all_functions[next_function].lines;
      const auto run = reinterpret_cast<void (*)()>(addresses[next_function]);
      codes.push_back({reinterpret_cast<saltus::tape::MachineFunction>(run), nullptr});
      next_function = (next_function + 1) % most_functions;  // the oldest ones are gone by then
    } else if (line.starts_with("@")) {
      read_table(line, *shared);
    } else if (line == "}") {
      text = nullptr;
    } else if (text != nullptr) {
      text->push_back(line);
    }
  }
  if (codes.size() != static_cast<std::size_t>(count)) throw std::runtime_error("functions");
  return codes;
}

}  // namespace support
