// The references of the stiff and smooth scenes of the shelf, as their headers hold them. By hand:
//   g++ -std=gnu++20 -O2 -I/usr/include/eigen3 main.cpp newton.cpp radau.cpp -lquadmath -o references
//   ./references orego            seven stages, order 13
//   ./references orego 5          five stages, order 9
//   ./references orego 7 growth   and the growth at the rows (of E5 for errors of every direction)
//   ./references beam 7 1e-14     each step held to 1e-14 in place of 1e-12
// Seconds each, but minutes for EMEP and the beam and half an hour for the ring modulator.
#include <cstdio>
#include <cstdlib>

#include "equations.hpp"
#include "radau.hpp"

int main(int count, char** words) {
  const auto all = problems();
  const auto found = all.find(count > 1 ? words[1] : "");
  if (found == all.end()) {
    for (const auto& [name, problem] : all) std::printf("%s\n", name.c_str());
    return 1;
  }
  const Problem& problem = found->second;
  const int stages = count > 2 ? std::atoi(words[2]) : 7;
  const double given = count > 3 ? std::atof(words[3]) : 0.0;
  const bool growth = count > 3 && given == 0.0;
  Radau radau(problem, stages, given > 0.0 ? given : 1e-12, growth);
  std::vector<std::size_t> marks;
  for (const Quad t : problem.times) {
    radau.advance_to(t);
    marks.push_back(radau.steps());
    std::printf("%s:", text(t, 9).c_str());
    for (const Quad y : radau.state()) std::printf(" %s", text(y).c_str());
    std::printf("\n");
  }
  for (const auto& roots : radau.roots()) {
    std::printf("roots:");
    for (const Quad t : roots) std::printf(" %s", text(t).c_str());
    std::printf("\n");
  }
  if (growth) std::printf("growth: %g\n", radau.growth(problem.ratio, marks));
}
