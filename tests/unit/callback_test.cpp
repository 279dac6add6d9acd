// Callbacks over methods and lambdas that return a number or fill a vector.
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

namespace {

/// Methods of all kinds.
class Block final : public LeafSystem {
 public:
  explicit Block(double scale) : LeafSystem("block"), scale_(scale) {}
  double number(const At& at) const { return scale_ * at.time; }
  void fill(const At& at, VectorRef out) const { out.setConstant(scale_ + at.time); }
  bool truth(const At& at) const { return at.time > 1.0; }

 private:
  double scale_;
};

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

std::vector<double> call(const VectorFunction& function, const LeafSystem& leaf, Index size = 2) {
  World world;
  Eigen::VectorXd out = Eigen::VectorXd::Zero(size);
  function(leaf, world.at, VectorRef(out.data(), size));
  return {out.begin(), out.end()};
}

}  // namespace

TEST_CASE("a callback is a method or a lambda, returns a number or fills", "[callback]") {
  const Block block(10.0);
  CHECK(call(&Block::number, block, 1) == std::vector{15.0});
  CHECK(call(&Block::fill, block) == std::vector{11.5, 11.5});
  CHECK(call(&Block::truth, block, 1) == std::vector{1.0});
  CHECK(call([](const At& at) { return at.x[1]; }, block, 1) == std::vector{2.0});
  CHECK(call([](const At&, VectorRef out) { out << 1.0, 2.0; }, block) == std::vector{1.0, 2.0});
  CHECK(call([](const At&) { return 3; }, block, 1) == std::vector{3.0});
  CHECK(call([](const At& at) { return at.mode == 9; }, block, 1) == std::vector{1.0});
}

TEST_CASE("an empty callback says so; a copy calls the same", "[callback]") {
  const VectorFunction empty;
  CHECK(!empty);
  const VectorFunction first = [values = std::vector{1.0, 2.0}](const At&, VectorRef out) {
    out << values[0], values[1];
  };
  const VectorFunction copy = first;
  CHECK(copy);
  CHECK(call(copy, Block(0.0)) == std::vector{1.0, 2.0});
}

TEST_CASE("a callback shows the callable that it was made from, to who knows its type",
          "[callback]") {
  struct Fill {
    double value;
    void operator()(const At&, VectorRef out) const { out.setConstant(value); }
  };
  struct Other {
    double value;
    void operator()(const At&, VectorRef out) const { out.setConstant(-value); }
  };
  const VectorFunction function = Fill{3.0};
  const VectorFunction copy = function;
  REQUIRE(copy.target<Fill>() != nullptr);
  CHECK(copy.target<Fill>()->value == 3.0);
  CHECK(copy.target<Other>() == nullptr);
  CHECK(VectorFunction(&Block::fill).target<Fill>() == nullptr);
  CHECK(VectorFunction().target<Fill>() == nullptr);
}
