// LlvmText: the text of a function in the intermediate representation of LLVM, instruction by
// instruction.
#pragma once

#include <set>
#include <span>
#include <string>
#include <vector>

#include "saltus/tape/operation.hpp"

namespace saltus::tape::detail {

/// The numbers that one instruction computes side by side: the width of a register of AVX.
/// Compilers for other processors divide them.
inline constexpr int widest_vector = 4;

/// "double", or "<4 x double>".
std::string type_of(int width);
/// A number with all its bits, as often as there are lanes.
std::string constant_of(double value, int width);

/// Text under construction. A value is a name such as "%v3", or a constant.
class LlvmText {
 public:
  /// The value of an instruction, such as "fadd double %v1, %v2".
  std::string define(const std::string& instruction);
  /// An instruction without a value, or a label.
  void add(const std::string& line) { body_ += line + "\n"; }
  /// A number that no other value or label of this text has.
  int number() { return count_++; }

  /// op(operands) in each of `width` lanes.
  std::string apply(Op op, std::span<const std::string> operands, int width);
  /// One lane of a vector; the value itself if it has one lane only.
  std::string lane(const std::string& vector, int width, int lane);
  /// A vector of single values.
  std::string gather(std::span<const std::string> lanes);
  /// A vector of one value in all lanes.
  std::string splat(const std::string& value, int width);

  std::string address(const std::string& array, const std::string& index);
  std::string load(const std::string& address, int width);
  void store(const std::string& value, int width, const std::string& address);

  const std::string& body() const { return body_; }
  /// The declarations of the functions that the body calls.
  const std::set<std::string>& declarations() const { return declarations_; }

 private:
  std::string compose(Op op, std::span<const std::string> operands, int width);
  std::string intrinsic(std::string_view name, std::span<const std::string> operands, int width);
  std::string call(Op op, std::span<const std::string> operands, int width);
  std::string compare(std::string_view how, const std::string& a, const std::string& b, int width);
  std::string choose(const std::string& condition, const std::string& a, const std::string& b,
                     int width);
  std::string truth(const std::string& condition, int width);
  std::string both(std::string_view how, std::span<const std::string> operands, int width);
  std::string extreme(std::string_view how, std::span<const std::string> operands, int width);
  std::string sign(const std::string& a, int width);
  std::string power(std::span<const std::string> operands, int width);
  std::string binary(std::string_view how, const std::string& a, const std::string& b, int width);

  std::string body_;
  std::set<std::string> declarations_;
  int count_ = 0;
};

/// The name by which machine code calls the function of an operation: "saltus_sin".
std::string called_name(Op op);

}  // namespace saltus::tape::detail
