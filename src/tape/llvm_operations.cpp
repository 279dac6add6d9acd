// Each operation in the intermediate representation of LLVM, to the last bit as in arithmetic.hpp.
#include "llvm_text.hpp"
#include "saltus/base/error.hpp"

namespace saltus::tape::detail {

namespace {

using Operands = std::span<const std::string>;

std::string bits_type(int width) { return width == 1 ? "i1" : text("<", width, " x i1>"); }

/// The instruction for an operation that the processor computes exactly rounded; otherwise empty.
std::string_view arithmetic(Op op) {
  switch (op) {
    case Op::add:
      return "fadd";
    case Op::sub:
      return "fsub";
    case Op::mul:
      return "fmul";
    case Op::div:
      return "fdiv";
    default:
      return "";
  }
}

/// The intrinsic function of an operation with an exact result.
std::string_view exact(Op op) {
  switch (op) {
    case Op::abs:
      return "fabs";
    case Op::sqrt:
      return "sqrt";
    case Op::floor:
      return "floor";
    case Op::ceil:
      return "ceil";
    case Op::trunc:
      return "trunc";
    case Op::rint:
      return "nearbyint";
    case Op::copysign:
      return "copysign";
    default:
      return "";
  }
}

/// The condition of a comparison. "o" is false for NaN, "u" is true.
std::string_view comparison(Op op) {
  switch (op) {
    case Op::lt:
      return "olt";
    case Op::le:
      return "ole";
    case Op::gt:
      return "ogt";
    case Op::ge:
      return "oge";
    case Op::eq:
      return "oeq";
    case Op::ne:
      return "une";
    default:
      return "";
  }
}

}  // namespace

std::string LlvmText::intrinsic(std::string_view name, Operands operands, int width) {
  const std::string type = type_of(width);
  const std::string function = text("@llvm.", name, width == 1 ? ".f64" : text(".v", width, "f64"));
  std::string types, values;
  for (const std::string& operand : operands) {
    types += (types.empty() ? "" : ", ") + type;
    values += text(values.empty() ? "" : ", ", type, " ", operand);
  }
  declarations_.insert(text("declare ", type, " ", function, "(", types, ")"));
  return define(text("call ", type, " ", function, "(", values, ")"));
}

/// A call for each lane. The name of the function is not that of <cmath>: LLVM would compute some
/// functions of <cmath> itself.
std::string LlvmText::call(Op op, Operands operands, int width) {
  const std::string function = "@" + called_name(op);
  declarations_.insert(text("declare double ", function, "(double",
                            operands.size() > 1 ? ", double" : "", ") nounwind readnone"));
  std::vector<std::string> lanes;
  for (int i = 0; i < width; ++i) {
    std::string values;
    for (const std::string& operand : operands)
      values += text(values.empty() ? "" : ", ", "double ", lane(operand, width, i));
    lanes.push_back(define(text("call double ", function, "(", values, ")")));
  }
  return gather(lanes);
}

std::string LlvmText::compare(std::string_view how, const std::string& a, const std::string& b,
                              int width) {
  return define(text("fcmp ", how, " ", type_of(width), " ", a, ", ", b));
}

std::string LlvmText::choose(const std::string& condition, const std::string& a,
                             const std::string& b, int width) {
  const std::string type = type_of(width);
  return define(
      text("select ", bits_type(width), " ", condition, ", ", type, " ", a, ", ", type, " ", b));
}

std::string LlvmText::truth(const std::string& condition, int width) {
  return choose(condition, constant_of(1.0, width), constant_of(0.0, width), width);
}

/// "and" or "or" of two truths.
std::string LlvmText::both(std::string_view how, Operands operands, int width) {
  const std::string zero = constant_of(0.0, width);
  const std::string a = compare("une", operands[0], zero, width);
  const std::string b = compare("une", operands[1], zero, width);
  return truth(define(text(how, " ", bits_type(width), " ", a, ", ", b)), width);
}

/// minimum with "ole", maximum with "oge": the first operand if it is NaN.
std::string LlvmText::extreme(std::string_view how, Operands operands, int width) {
  const std::string& a = operands[0];
  const std::string first = compare(how, a, operands[1], width);
  const std::string nan = compare("uno", a, a, width);
  const std::string takes = define(text("or ", bits_type(width), " ", first, ", ", nan));
  return choose(takes, a, operands[1], width);
}

std::string LlvmText::sign(const std::string& a, int width) {
  const std::string zero = constant_of(0.0, width);
  const std::string flat = choose(compare("oeq", a, zero, width), zero, a, width);
  const std::string below =
      choose(compare("olt", a, zero, width), constant_of(-1.0, width), flat, width);
  return choose(compare("ogt", a, zero, width), constant_of(1.0, width), below, width);
}

std::string LlvmText::binary(std::string_view how, const std::string& a, const std::string& b,
                             int width) {
  return define(text(how, " ", type_of(width), " ", a, ", ", b));
}

/// The same powers as `power` in arithmetic.hpp, which the called function runs. If the exponent is
/// constant, its tests are not needed.
std::string LlvmText::power(Operands operands, int width) {
  const std::string& a = operands[0];
  const auto exponent = [&](double b) { return operands[1] == constant_of(b, width); };
  const auto times = [&](const std::string& l, const std::string& r) {
    return binary("fmul", l, r, width);
  };
  const auto inverse = [&](const std::string& of) {
    return binary("fdiv", constant_of(1.0, width), of, width);
  };
  const auto root = [&](bool of_zero) {
    const std::string of = of_zero ? binary("fadd", a, constant_of(0.0, width), width) : a;
    return intrinsic("sqrt", {&of, 1}, width);
  };
  if (exponent(1.5)) return times(a, root(false));
  if (exponent(2.5)) return times(times(a, a), root(true));
  if (exponent(-0.5)) return inverse(root(true));
  if (exponent(-1.5)) return inverse(times(a, root(false)));
  if (exponent(-2.0)) return inverse(times(a, a));
  if (exponent(-3.0)) return inverse(times(times(a, a), a));
  return call(Op::pow, operands, width);
}

std::string LlvmText::apply(Op op, Operands operands, int width) {
  const std::string& a = operands[0];
  if (const auto how = arithmetic(op); !how.empty()) return binary(how, a, operands[1], width);
  if (const auto function = exact(op); !function.empty())
    return intrinsic(function, operands, width);
  if (const auto how = comparison(op); !how.empty())
    return truth(compare(how, a, operands[1], width), width);
  return compose(op, operands, width);
}

/// An operation that is neither arithmetic, nor a function of LLVM, nor a comparison.
std::string LlvmText::compose(Op op, Operands operands, int width) {
  const std::string& a = operands[0];
  const std::string zero = constant_of(0.0, width);
  switch (op) {
    case Op::neg:
      return define(text("fneg ", type_of(width), " ", a));
    case Op::sign:
      return sign(a, width);
    case Op::logical_not:
      return truth(compare("oeq", a, zero, width), width);
    case Op::pow:
      return power(operands, width);
    case Op::minimum:
      return extreme("ole", operands, width);
    case Op::maximum:
      return extreme("oge", operands, width);
    case Op::logical_and:
      return both("and", operands, width);
    case Op::logical_or:
      return both("or", operands, width);
    case Op::select:
      return choose(compare("une", a, zero, width), operands[1], operands[2], width);
    default:
      return call(op, operands, width);
  }
}

}  // namespace saltus::tape::detail
