// Environment: where figures were measured, without which run times mean nothing.
#pragma once

#include <string>

namespace saltus {

struct Environment {
  std::string cpu;       ///< as the system calls it; "unknown" where it does not say
  int cores = 0;         ///< logical ones, of the machine
  std::string compiler;  ///< of the library, with its version
  std::string build;     ///< "optimised" or "not optimised"
  std::string sundials;  ///< version of the library that is linked
  std::string saltus;    ///< version
};

/// Of this machine and this build.
Environment environment();

}  // namespace saltus
