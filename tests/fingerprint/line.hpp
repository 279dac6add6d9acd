// One line of a fingerprint: what a run gave, as a hash for each part of it.
#pragma once

#include <cstddef>
#include <string>

#include "saltus/simulation/results.hpp"

namespace fingerprint {

/// How much of the results the line before has seen already: a run that goes on in a thousand
/// pieces would otherwise be read a thousand times.
struct Seen {
  std::size_t rows = 0, events = 0;
};

/// Rows, events, statistics, context, continuation and error, each as a hash, and the status. A run
/// that a clock interrupted has no hashes: it ends elsewhere each time.
std::string parts(const saltus::Results& results, const Seen& seen = {});

/// The same for a scene that was refused before it ran.
std::string refused(const std::string& message);

/// Appends a line to the file that SALTUS_FINGERPRINT names, if it names one.
void write(const std::string& scene, const std::string& method, const std::string& parts);

/// As long as it lives, each run is a line of this scene and this method. Without one, a line has
/// the name of the running test and the number of the run in it.
class Named {
 public:
  Named(std::string scene, std::string method);
  ~Named();
  Named(const Named&) = delete;
  Named& operator=(const Named&) = delete;
};

/// How many lines there were, written or not.
std::size_t lines();

}  // namespace fingerprint
