// What do simultaneous impacts cost, against one? One to a hundred balls, e = 0.9, fall from one
// height and land together, as one leaf with a vector guard and as a leaf each, with ten impacts
// each. dopri5 at rtol 1e-6. `impacts leaf 10 3` makes three runs of one of them, for a profiler.
#include <cstring>
#include <saltus/library/library.hpp>

#include "balls.hpp"
#include "interleave.hpp"
#include "runner.hpp"
#include "sheet.hpp"

namespace {

using namespace saltus;

constexpr double height = 10.0, ten_impacts = 18.2;  // [m], [s]

std::shared_ptr<bench::Balls> balls(Index n) {
  return std::make_shared<bench::Balls>(Eigen::VectorXd::Constant(n, height));
}

bench::Runner in_one_leaf(Index n) {
  const auto system = balls(n);
  return {system,
          system->create_context(),
          ten_impacts,
          {.rtol = 1e-6, .atol = 1e-8, .ode_solver_method = Method::dopri5}};
}

bench::Runner in_leaves(Index n) {
  DiagramBuilder builder;
  for (Index i = 0; i < n; ++i)
    builder.add<bench::Balls>(Eigen::VectorXd::Constant(1, height), text("ball_", i));
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
