// Each run of this program is a line of the fingerprint: the linker puts these two functions in
// place of Simulator::initialize and Simulator::advance_to (`--wrap` in tests/CMakeLists.txt), so
// the tests, and the library, are the objects of every day. If a symbol changes its name, nothing
// is found under `__real_`, and the program does not link.
#include <map>
#include <thread>

#include <saltus/simulation/simulator.hpp>

#include "fingerprint/line.hpp"
#include "support/catch.hpp"
#if __has_include(<catch2/interfaces/catch_interfaces_capture.hpp>)
#include <catch2/interfaces/catch_interfaces_capture.hpp>
#endif

namespace fingerprint {

using saltus::Context;
using saltus::Simulator;
using saltus::Status;

// A member function is called as a function whose first argument is `this` (Itanium C++ ABI, 2.3).
void real_initialize(Simulator* self, const Context& context) __asm__(
    "__real__ZN6saltus9Simulator10initializeERKNS_7ContextE");
Status real_advance_to(Simulator* self,
                       double t) __asm__("__real__ZN6saltus9Simulator10advance_toEd");

namespace {

struct Names {
  std::string scene, method;
};
Names named;
std::map<const Simulator*, Seen> seen;
const std::thread::id main_thread = std::this_thread::get_id();

/// The method that ran, as the statistics call it: the words after it are its reasons.
std::string method_of(const saltus::Results& results) {
  const std::string& method = results.statistics.method;
  return method.substr(0, method.find_first_of(" :,("));
}

void write_line(const Simulator& simulator) {
  const saltus::Results& results = simulator.results();
  Seen& before = seen[&simulator];
  const std::string found = parts(results, before);
  before = {results.time.size(), results.events.size()};
  if (!named.scene.empty()) return write(named.scene, named.method, found);
  static std::map<std::string, int> numbers;
  const std::string test = Catch::getResultCapture().getCurrentTestName();
  write(saltus::text("test/", test, " #", ++numbers[test]), method_of(results), found);
}

/// Writes the line also where advance_to throws. What runs in several threads has no order.
struct Line {
  const Simulator& simulator;
  ~Line() {
    if (std::this_thread::get_id() == main_thread) write_line(simulator);
  }
};

}  // namespace

Named::Named(std::string scene, std::string method) {
  named = {std::move(scene), std::move(method)};
}
Named::~Named() { named = {}; }

void wrapped_initialize(Simulator* self, const Context& context) __asm__(
    "__wrap__ZN6saltus9Simulator10initializeERKNS_7ContextE");
void wrapped_initialize(Simulator* self, const Context& context) {
  if (std::this_thread::get_id() == main_thread) seen.erase(self);
  real_initialize(self, context);
}

Status wrapped_advance_to(Simulator* self,
                          double t) __asm__("__wrap__ZN6saltus9Simulator10advance_toEd");
Status wrapped_advance_to(Simulator* self, double t) {
  const Line line{*self};
  return real_advance_to(self, t);
}

}  // namespace fingerprint
