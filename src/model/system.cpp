// The kind of a system, from the name of its class.
#include "saltus/model/system.hpp"

#include <cstdlib>
#include <typeinfo>

#if __has_include(<cxxabi.h>)
#include <cxxabi.h>
#endif

namespace saltus {

namespace {

std::string readable(const char* mangled) {
#if __has_include(<cxxabi.h>)
  int status = 0;
  const std::unique_ptr<char, void (*)(void*)> name(
      abi::__cxa_demangle(mangled, nullptr, nullptr, &status), std::free);
  if (status == 0) return name.get();
#endif
  return mangled;
}

}  // namespace

/// The name of the class, without namespaces, enclosing functions and template arguments.
std::string System::kind() const {
  std::string name = readable(typeid(*this).name());
  int depth = 0;
  std::size_t begin = 0, end = name.size();
  for (std::size_t i = 0; i < name.size(); ++i) {
    const char c = name[i];
    if (c == '<' && depth == 0) end = i;
    if (c == '<' || c == '(' || c == '{') ++depth;
    if (c == '>' || c == ')' || c == '}') --depth;
    if (c == ':' && depth == 0) begin = i + 1, end = name.size();
  }
  return name.substr(begin, end - begin);
}

}  // namespace saltus
