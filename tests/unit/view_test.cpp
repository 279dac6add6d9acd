// What a callback sees and what a reset map writes: maps over memory of someone else.
#include "saltus/base/view.hpp"

#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

namespace {

/// An At of two states, one discrete value, three parameters and one input.
struct World {
  Eigen::VectorXd x = vec({1.0, 2.0}), z = vec({3.0}), p = vec({4.0, 5.0, 6.0}),
                  y = vec({7.0, 8.0});
  Bases bases{x.data(), z.data(), p.data(), y.data()};
  Place input{Space::y, 0, 2};
  double relation[2] = {1.0, 0.0};
  const double* relations[1] = {relation};
  At at{1.5, {x.data(), 2}, {z.data(), 1}, {p.data(), 3}, 9, Inputs(&input, 1, &bases), relations};
};

}  // namespace

TEST_CASE("At shows states, parameters, inputs, mode and relations", "[view]") {
  World world;
  const At& at = world.at;
  CHECK(at.time == 1.5);
  CHECK((at.x[0] == 1.0 && at.x[1] == 2.0 && at.z[0] == 3.0 && at.mode == 9));
  CHECK(at.p[ParameterIndex{1, 1}] == 5.0);
  CHECK(Eigen::VectorXd(at.parameter({1, 2})) == vec({5.0, 6.0}));
  CHECK(Eigen::VectorXd(at.u[0]) == vec({7.0, 8.0}));
  CHECK(at.u(0) == 7.0);
  CHECK(at.u.size() == 1);
  CHECK(at.relation({0}, 0));
  CHECK(!at.relation({0}, 1));
}

TEST_CASE("each input is read where its place says, in any of the four arrays", "[view]") {
  const double x[] = {1.0, 2.0}, z[] = {3.0}, p[] = {4.0}, y[] = {5.0, 6.0, 7.0};
  const Bases bases{x, z, p, y};
  const Place places[] = {{Space::x, 1, 1}, {Space::z, 0, 1}, {Space::p, 0, 1}, {Space::y, 1, 2}};
  const Inputs inputs(places, 4, &bases);
  CHECK((inputs(0) == 2.0 && inputs(1) == 3.0 && inputs(2) == 4.0 && inputs(3) == 6.0));
  CHECK(Eigen::VectorXd(inputs[3]) == vec({6.0, 7.0}));
  CHECK(inputs.size() == 4);
}

TEST_CASE("Next says what was written, even the value that was there", "[view]") {
  Eigen::VectorXd x = vec({1.0, 2.0}), z = vec({3.0});
  int mode = 0;
  const std::string path = "plant.tank";
  Next next({x.data(), 2}, {z.data(), 1}, mode, path);
  CHECK(!next.wrote_continuous_state());
  next.set_continuous_state({1.0, 2.0});
  CHECK(next.wrote_continuous_state());
  CHECK(!next.wrote_discrete_state());
  next.set_discrete_state(vec({5.0}));
  next.set_mode(4);
  CHECK((next.wrote_discrete_state() && next.wrote_mode() && z[0] == 5.0 && mode == 4));
  CHECK(message<ModelError>([&] { next.set_discrete_state({1.0, 2.0}); }) ==
        "block 'plant.tank': expected 1 values for the discrete state, found 2; set all of it at "
        "once");
  CHECK(z[0] == 5.0);
}

TEST_CASE("a state that was refused is left as it was, and not called written", "[view]") {
  Eigen::VectorXd x = vec({1.0, 2.0}), z;
  int mode = 0;
  const std::string path = "leaf";
  Next next({x.data(), 2}, {z.data(), 0}, mode, path);
  for (const auto& wrong : {vec({}), vec({1.0}), vec({7.0, 8.0, 9.0})})
    CHECK(contains(message<ModelError>([&] { next.set_continuous_state(wrong); }),
                   text("expected 2 values for the continuous state, found ", wrong.size())));
  CHECK(x == vec({1.0, 2.0}));
  CHECK(!next.wrote_continuous_state());
  next.set_continuous_state(vec({3.0, 4.0}));
  CHECK(x == vec({3.0, 4.0}));
}
