// Is Pack worth its code, against Eigen's arrays? A formula of eight springs, as a fused loop of a
// plan computes it. `packs pack 100000` for callgrind.
#include <array>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <vector>

#include <Eigen/Core>

#include "interleave.hpp"
#include "saltus/base/pack.hpp"

namespace {

using Array = Eigen::Array<double, saltus::Pack::size, 1>;
using Numbers = std::array<double, saltus::Pack::size>;

/// A spring with a damper and a stop: sums, products, a quotient and a root.
template <class Number>
Number force(const Number& x, const Number& v, const Number& k) {
  const Number way = x - 0.25 * v, stiff = k * way;
  return stiff / (1.0 + sqrt(way * way + 0.01)) - 0.1 * v * abs(v);
}

struct Springs {
  alignas(64) Numbers x{}, v{}, k{}, f{};
};

Springs springs() {
  Springs s;
  for (std::size_t i = 0; i < s.x.size(); ++i)
    s.x[i] = 0.1 * static_cast<double>(i), s.v[i] = 1.0 - s.x[i], s.k[i] = 2.0 + s.x[i];
  return s;
}

[[gnu::noinline]] void by_pack(Springs& s) {
  using saltus::Pack;
  force(Pack(s.x.data()), Pack(s.v.data()), Pack(s.k.data())).store(s.f.data());
}

[[gnu::noinline]] void by_eigen(Springs& s) {
  const auto read = [](const Numbers& numbers) -> Array {
    return Eigen::Map<const Array>(numbers.data());
  };
  Eigen::Map<Array>(s.f.data()) = force<Array>(read(s.x), read(s.v), read(s.k));
}

[[gnu::noinline]] void one_by_one(Springs& s) {
  using std::abs, std::sqrt;
  for (std::size_t i = 0; i < s.x.size(); ++i) {
    const double way = s.x[i] - 0.25 * s.v[i], stiff = s.k[i] * way;
    s.f[i] = stiff / (1.0 + sqrt(way * way + 0.01)) - 0.1 * s.v[i] * abs(s.v[i]);
  }
}

}  // namespace

int main(int argc, char** argv) {
  Springs s = springs();
  if (argc > 2) {
    const auto run = std::strcmp(argv[1], "pack") == 0    ? by_pack
                     : std::strcmp(argv[1], "eigen") == 0 ? by_eigen
                                                          : one_by_one;
    for (int k = std::atoi(argv[2]); k > 0; --k) run(s);
    return s.f[0] < 1e300 ? 0 : 1;
  }
  Springs plain = springs(), arrays = springs();
  by_pack(s), one_by_one(plain), by_eigen(arrays);
  const auto times = bench::interleave(
      {[&] { by_pack(s); }, [&] { by_eigen(arrays); }, [&] { one_by_one(plain); }});
  std::printf("eight springs: pack %.1f ns; ratios: eigen %.2f, one by one %.2f; bits %s\n",
              times[0].time * 1e9, times[1].ratio, times[2].ratio,
              s.f == plain.f && s.f == arrays.f ? "equal" : "differ");
}
