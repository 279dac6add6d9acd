// Turn: a run has one caller at a time.
#include "saltus/simulation/detail/turn.hpp"

#include "support/catch.hpp"

using namespace saltus;

namespace {

std::string refusal(Caller& caller, double t) {
  try {
    const Turn turn(caller, t, "advance_to");
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("a second caller is refused while the first one is there, and not afterwards", "[turn]") {
  Caller caller;
  const double t = 0.5;
  {
    const Turn turn(caller, t, "advance_to");
    std::string other;
    std::thread([&] { other = refusal(caller, t); }).join();
    CHECK(other.find("another thread") != std::string::npos);
    CHECK(other.find("t = ") == std::string::npos);  // the time is written by the first thread
    const std::string nested = refusal(caller, t);
    CHECK(nested.find("t = 0.5 s") != std::string::npos);
    CHECK(nested.find("callback") != std::string::npos);
  }
  CHECK(refusal(caller, t).empty());
  std::string other = "not asked";
  std::thread([&] { other = refusal(caller, t); }).join();
  CHECK(other.empty());
}
