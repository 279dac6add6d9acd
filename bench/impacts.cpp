// What do simultaneous impacts cost, against one? One to a hundred balls, e = 0.9, that fall from one
// height and land together, as one leaf with a vector guard and as a leaf each; ten impacts each.
// dopri5 at rtol 1e-6. `impacts leaf 10 3` makes three runs of one of them, for a profiler.
#include <cstring>
#include <saltus/library/library.hpp>

#include "interleave.hpp"
#include "runner.hpp"
#include "sheet.hpp"

namespace {

using namespace saltus;

constexpr double g = 9.81, e = 0.9, height = 10.0, ten_impacts = 18.2;  // [m/s^2], 1, [m], [s]

/// Heights first, then speeds; one call computes all guards.
class Balls final : public LeafSystem {
 public:
  explicit Balls(Index n, std::string name = "balls") : LeafSystem(std::move(name)), n_(n) {
    Eigen::VectorXd start = Eigen::VectorXd::Zero(2 * n);
    start.head(n).setConstant(height);
    declare_continuous_state({.initial = start, .ode = [n](const At& at, VectorRef xdot) {
                                xdot.head(n) = at.x.tail(n);
                                xdot.tail(n).setConstant(-g);
                              }});
    declare_zero_crossing({.name = "bounce",
                           .guard = [n](const At& at, VectorRef out) { out = at.x.head(n); },
                           .reset_map = &Balls::bounce,
                           .direction = Direction::positive_then_non_positive,
                           .size = n});
  }

 private:
  void bounce(const At& at, Next& next) const {
    Eigen::VectorXd x = at.x;
    x[at.entry] = std::abs(x[at.entry]);
    x[n_ + at.entry] *= -e;
    next.set_continuous_state(x);
  }
  Index n_;
};

bench::Runner in_one_leaf(Index n) {
  const auto system = std::make_shared<Balls>(n);
  return {system,
          system->create_context(),
          ten_impacts,
          {.rtol = 1e-6, .atol = 1e-8, .ode_solver_method = Method::dopri5}};
}

bench::Runner in_leaves(Index n) {
  DiagramBuilder builder;
  for (Index i = 0; i < n; ++i) builder.add<Balls>(1, text("ball_", i));
  const auto system = std::make_shared<const Diagram>(builder.build("balls"));
  return {system,
          system->create_context(),
          ten_impacts,
          {.rtol = 1e-6, .atol = 1e-8, .ode_solver_method = Method::dopri5}};
}

void compare(bench::Sheet& sheet, const char* form, bench::Runner (*make)(Index)) {
  std::vector<bench::Runner> runs;
  const std::vector<Index> sizes{1, 10, 100};
  for (const Index n : sizes) runs.push_back(make(n));
  const auto times =
      bench::interleave({[&] { runs[0](); }, [&] { runs[1](); }, [&] { runs[2](); }}, 21);
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    sheet.add({{"balls", form},
               {"n", sizes[i]},
               {"time [us]", times[i].time * 1e6},
               {"ratio", times[i].ratio},
               {"steps", runs[i].statistics().steps},
               {"events", runs[i].statistics().events},
               {"rhs", runs[i].statistics().right_hand_side_calls},
               {"guards", runs[i].statistics().guard_calls}});
  }
  sheet.target(text("ten balls, ", form, ", against one"), times[1].ratio, 3.0);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 4) {
    bench::Runner run =
        (std::strcmp(argv[1], "leaf") == 0 ? in_one_leaf : in_leaves)(std::atol(argv[2]));
    for (int i = std::atoi(argv[3]); i > 0; --i) run();
    return 0;
  }
  bench::Sheet sheet("impacts", "What do simultaneous impacts cost, against one?");
  compare(sheet, "in one leaf", in_one_leaf);
  compare(sheet, "a leaf each", in_leaves);
}
