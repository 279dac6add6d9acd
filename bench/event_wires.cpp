// What does a delivery of an event wire cost, and how does it grow with blocks and wires? A source
// beats a thousand times; 0, 1 or 100 of its wires lead to some of n counters, while each of the
// other counters has 100 wires of its own, which never fire. Then n integrate-and-fire cells with
// 100 targets each and delays: the time for each spike, with one common step and by islands, and how
// far spikes are from those of one common step at rtol 1e-10.
//
//     build/bench/bin/event_wires                        the tables
//     build/bench/bin/event_wires apart|common n [end]   one run, for callgrind and for memory
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <random>
#include <saltus/library/library.hpp>

#include "interleave.hpp"
#include "runner.hpp"
#include "sheet.hpp"

namespace {

using namespace saltus;

/// The event `beat` at each ms.
class Source final : public LeafSystem {
 public:
  Source() : LeafSystem("source") { declare_time_event({.name = "beat", .period = 1e-3}); }
};

/// z counts what arrives; the event `never` is one of a far time.
class Counter final : public LeafSystem {
 public:
  explicit Counter(const std::string& name) : LeafSystem(name) {
    declare_discrete_state(Eigen::VectorXd::Zero(1));
    declare_time_event({.name = "never", .offset = 1e9});
    declare_event_input({.name = "count", .reset_map = &Counter::count});
  }

 private:
  void count(const At& at, Delivery& next) const {
    next.set_discrete_state({at.z[0] + next.weight()});
  }
};

/// v' = current - v, threshold 1, reset to 0.
class Cell final : public LeafSystem {
 public:
  Cell(const std::string& name, double current, double start)
      : LeafSystem(name), current_(current) {
    declare_continuous_state(
        {.initial = Eigen::VectorXd::Constant(1, start), .ode = method<&Cell::ode>});
    declare_zero_crossing({.name = "fire",
                           .guard = method<&Cell::beyond>,
                           .reset_map = &Cell::reset,
                           .direction = Direction::negative_then_non_negative});
    declare_event_input({.name = "synapse", .reset_map = &Cell::receive});
  }

 private:
  double ode(const At& at) const { return current_ - at.x[0]; }
  double beyond(const At& at) const { return at.x[0] - 1.0; }
  void reset(const At&, Next& next) const { next.set_continuous_state({0.0}); }
  void receive(const At& at, Delivery& next) const {
    next.set_continuous_state({at.x[0] + next.weight()});
  }
  double current_;
};

constexpr int fan = 100;

bench::Runner counters(int n, int targets) {
  DiagramBuilder builder;
  const Source& source = builder.add<Source>();
  std::vector<const Counter*> all;
  for (int k = 0; k < n; ++k) all.push_back(&builder.add<Counter>(text("c", k)));
  std::mt19937 random(1);
  const auto any = [&] { return all[random() % all.size()]->event_input("count"); };
  for (const Counter* one : all)
    for (int i = 0; i < fan; ++i) builder.connect_event(one->event_output("never"), any());
  for (int i = 0; i < targets; ++i)
    builder.connect_event(source.event_output("beat"), any(), 1.0, 1e-4);
  const auto system = std::make_shared<const Diagram>(builder.build());
  return {system, system->create_context(), 1.0, {.record_events = false}};
}

struct Spiking {
  bool islands = false;
  double rtol = 1e-6, atol = 1e-8;
};

bench::Runner network(int n, double end, const Spiking& how) {
  DiagramBuilder builder;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> current(1.5, 3.0), start(0.0, 1.0);
  std::vector<const Cell*> all;
  for (int k = 0; k < n; ++k)
    all.push_back(&builder.add<Cell>(text("c", k), current(random), start(random)));
  for (const Cell* one : all)
    for (int i = 0; i < fan; ++i)
      builder.connect_event(one->event_output("fire"),
                            all[random() % all.size()]->event_input("synapse"), 1e-4, 0.05);
  const auto system = std::make_shared<const Diagram>(builder.build());
  return {system,
          system->create_context(),
          end,
          {.rtol = how.rtol,
           .atol = how.atol,
           .ode_solver_method = Method::dopri5,
           .islands = how.islands}};
}

void deliveries(bench::Sheet& sheet, int n) {
  bench::Runner none = counters(n, 0), one = counters(n, 1), hundred = counters(n, fan);
  const auto times =
      bench::interleave({[&] { none(); }, [&] { one(); }, [&] { hundred(); }}, 5, 1e-2);
  sheet.add({{"scene", "counters"},
             {"n", n},
             {"wires", n * fan},
             {"a beat [us]", times[0].time * 1e3},
             {"a delivery [ns]", (times[2].time - times[1].time) * 1e6 / (fan - 1)}});
}

double megabytes() {
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  return static_cast<double>(used.ru_maxrss) / 1024.0;
}

/// The longest distance in time between the k-th spikes of a cell in two runs; infinite if they do
/// not have the same number.
double distance(const Results& a, const Results& b, int n) {
  double most = a.events.size() == b.events.size() ? 0.0 : INFINITY;
  for (int k = 0; k < n && std::isfinite(most); ++k) {
    const auto one = a.events.times(text("c", k, ".fire")),
               two = b.events.times(text("c", k, ".fire"));
    if (one.size() != two.size()) return INFINITY;
    for (std::size_t i = 0; i < one.size(); ++i) most = std::max(most, std::abs(one[i] - two[i]));
  }
  return most;
}

/// The processor time for each spike [us] of a second run, which allocates nothing.
double spikes(bench::Sheet& sheet, int n, double end, bool islands) {
  const double start = bench::processor_time();
  bench::Runner run = network(n, end, {.islands = islands});
  const double made = bench::processor_time();
  run();
  const double again = bench::processor_time();
  run();
  const double ended = bench::processor_time();
  const auto events = static_cast<double>(run.results().events.size());
  const double each = (ended - again) * 1e6 / events;
  sheet.add({{"scene", islands ? "cells, islands" : "cells, common step"},
             {"n", n},
             {"wires", n * fan},
             {"making [s]", made - start},
             {"most memory [MB]", megabytes()},
             {"spikes", events},
             {"a spike [us]", each}});
  return each;
}

/// In turns, three times; the median of the ratios.
void compare(bench::Sheet& sheet, int n) {
  const double whole = n < 10'000 ? 1.0 : 0.1, part = n < 10'000 ? 1.0 : 0.02;
  std::array<double, 3> ratios{};
  for (double& ratio : ratios) {
    const double apart = spikes(sheet, n, whole, true);
    ratio = spikes(sheet, n, part, false) / apart;
  }
  std::ranges::sort(ratios);
  sheet.add({{"common step over islands", text(n, " cells")}, {"ratio", ratios[1]}});
}

void distances(bench::Sheet& sheet, int n) {
  const double end = n > 100 ? 0.5 : 1.0;
  bench::Runner apart = network(n, end, {.islands = true});
  bench::Runner exact = network(n, end, {.rtol = 1e-10, .atol = 1e-12});
  apart(), exact();
  sheet.add({{"scene", "islands at rtol 1e-6, common step at rtol 1e-10"},
             {"n", n},
             {"spikes", exact.results().events.size()},
             {"furthest [s]", distance(apart.results(), exact.results(), n)}});
}

}  // namespace

int main(int argc, char** argv) {
  bench::Sheet sheet("event_wires", "What does a delivery of an event wire cost?");
  if (argc >= 3) {
    const int n = std::atoi(argv[2]);
    spikes(sheet, n, argc > 3 ? std::atof(argv[3]) : 100.0 / n, std::strcmp(argv[1], "apart") == 0);
    return 0;
  }
  for (const int n : {100, 1000, 10'000}) deliveries(sheet, n);
  for (const int n : {100, 1000, 10'000}) compare(sheet, n);
  for (const int n : {100, 1000}) distances(sheet, n);
}
