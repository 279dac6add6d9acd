#include "saltus/report/environment.hpp"

#include <array>
#include <fstream>
#include <string_view>
#include <thread>

#include <sundials/sundials_version.h>

namespace saltus {

namespace {

/// Linux keeps the name in a file, after the first "model name" or "Model".
std::string cpu_name() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    if (!line.starts_with("model name") && !line.starts_with("Model")) continue;
    const auto colon = line.find(": ");
    if (colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown";
}

std::string compiler() {
#if defined(__clang__)
  return "Clang " __clang_version__;
#elif defined(__GNUC__)
  return "GCC " __VERSION__;
#else
  return "unknown";
#endif
}

std::string build() {
#if defined(__OPTIMIZE__)
  return "optimised";
#else
  return "not optimised";
#endif
}

std::string sundials() {
  std::array<char, 32> version{};
  const int failed = SUNDIALSGetVersion(version.data(), static_cast<int>(version.size()));
  return failed == 0 ? version.data() : "unknown";
}

}  // namespace

Environment environment() {
  return {.cpu = cpu_name(),
          .cores = static_cast<int>(std::thread::hardware_concurrency()),
          .compiler = compiler(),
          .build = build(),
          .sundials = sundials(),
          .saltus = SALTUS_VERSION};
}

}  // namespace saltus
