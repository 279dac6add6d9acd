// Environment: the machine and versions of a measurement, without which run times mean nothing.
#pragma once

#include <string>

namespace saltus {

struct Environment {
  std::string cpu;       ///< as the system calls it; "unknown" if it does not say
  int cores = 0;         ///< logical cores of the machine
  std::string compiler;  ///< of the library, with its version
  std::string build;     ///< "optimised" or "not optimised"
  std::string sundials;  ///< version of the linked library
  std::string saltus;    ///< version
};

/// The environment of this machine and this build.
Environment environment();

}  // namespace saltus
