#include "llvm_text.hpp"

#include <bit>
#include <cstdint>
#include <cstdio>

#include "saltus/base/error.hpp"

namespace saltus::tape::detail {

std::string type_of(int width) { return width == 1 ? "double" : text("<", width, " x double>"); }

std::string constant_of(double value, int width) {
  char bits[24];
  std::snprintf(bits, sizeof bits, "0x%016llX",
                static_cast<unsigned long long>(std::bit_cast<std::uint64_t>(value)));
  if (width == 1) return bits;
  std::string all = "<";
  for (int i = 0; i < width; ++i) all += text(i > 0 ? ", " : "", "double ", bits);
  return all + ">";
}

std::string called_name(Op op) { return text("saltus_", name(op)); }

std::string LlvmText::define(const std::string& instruction) {
  const std::string value = text("%v", number());
  add(text("  ", value, " = ", instruction));
  return value;
}

std::string LlvmText::lane(const std::string& vector, int width, int lane) {
  if (width == 1) return vector;
  return define(text("extractelement ", type_of(width), " ", vector, ", i32 ", lane));
}

std::string LlvmText::gather(std::span<const std::string> lanes) {
  const int width = static_cast<int>(lanes.size());
  if (width == 1) return lanes[0];
  std::string vector = "poison";
  for (int i = 0; i < width; ++i) {
    vector = define(text("insertelement ", type_of(width), " ", vector, ", double ",
                         lanes[static_cast<std::size_t>(i)], ", i32 ", i));
  }
  return vector;
}

std::string LlvmText::splat(const std::string& value, int width) {
  if (width == 1) return value;
  const std::string type = type_of(width);
  const std::string first =
      define(text("insertelement ", type, " poison, double ", value, ", i32 0"));
  return define(text("shufflevector ", type, " ", first, ", ", type, " poison, <", width,
                     " x i32> zeroinitializer"));
}

std::string LlvmText::address(const std::string& array, const std::string& index) {
  return define(text("getelementptr inbounds double, ptr ", array, ", i64 ", index));
}

std::string LlvmText::load(const std::string& address, int width) {
  return define(text("load ", type_of(width), ", ptr ", address, ", align 8"));
}

void LlvmText::store(const std::string& value, int width, const std::string& address) {
  add(text("  store ", type_of(width), " ", value, ", ptr ", address, ", align 8"));
}

}  // namespace saltus::tape::detail
