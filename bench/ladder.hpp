// Ladder: a solver on one scene at tighter and tighter tolerances, timed in turns with others, and
// its cost at an achieved error.
#pragma once

#include <map>

#include "cost_at.hpp"
#include "interleave.hpp"
#include "peer.hpp"

namespace bench {

/// Makes a solver for the scene at this rtol.
using MakePeer = std::function<std::unique_ptr<Peer>(double rtol)>;

struct Rung {
  double rtol = 0.0, error = HUGE_VAL;  ///< infinite: it gave up
  Counts counts = {};
  std::vector<double> times = {};  ///< [s] of one run, one for each round
  std::unique_ptr<Peer> peer = {};

  double time() const { return median(times); }
  /// [s] One run, from `repeats` runs.
  double timed(int repeats) {
    return seconds([&] {
             for (int k = 0; k < repeats; ++k) peer->run();
           }) /
           repeats;
  }
};

/// Costs of a rung.
inline double milliseconds(const Rung& rung) { return rung.time() * 1e3; }
inline double calls(const Rung& rung) { return static_cast<double>(rung.counts.calls); }

inline double geometric_mean(const std::vector<double>& values) {
  double logs = 0.0;
  for (const double value : values) logs += std::log(value);
  return std::exp(logs / static_cast<double>(values.size()));
}

class Ladder {
 public:
  /// Climbs from rtol = `loosest` to 1e-13, ten times as tight at a time: until the error is below
  /// `enough`, or a run takes longer than `longest` [s].
  Ladder(std::string name, const MakePeer& make, double loosest, double enough, double longest)
      : name_(std::move(name)) {
    for (double rtol = loosest; rtol > 0.9e-13; rtol *= 0.1) {
      Rung& rung = rungs_.emplace_back();
      rung.rtol = rtol;
      rung.peer = make(rtol);
      bool fine = false;
      const double once = seconds([&] { fine = rung.peer->run(); });
      rung.times = {once};
      rung.counts = rung.peer->counts();
      if (fine) rung.error = rung.peer->error();
      if (rung.error < enough || once > longest) return;
    }
  }

  const std::string& name() const { return name_; }
  std::vector<Rung>& rungs() { return rungs_; }
  const std::vector<Rung>& rungs() const { return rungs_; }

  /// The cost at this error; `cost` gives that of a rung.
  template <class Cost>
  double at(double error, const Cost& cost) const {
    std::vector<CostPoint> points;
    for (const Rung& rung : rungs_) points.push_back({rung.error, cost(rung)});
    return cost_at(error, points);
  }
  double time_at(double error, std::size_t round) const {
    return at(error, [&](const Rung& rung) { return rung.times[round]; });
  }
  double time_of_best(std::size_t round) const {
    return std::ranges::min_element(rungs_, {}, &Rung::error)->times[round];
  }

 private:
  std::string name_;
  std::vector<Rung> rungs_;
};

/// Times all rungs of all ladders in turns, for about `budget` seconds: three rounds at least. A
/// run of 0.3 s and more keeps the time of its first run.
inline void time_in_turns(std::vector<Ladder>& ladders, double budget, double batch = 2e-3) {
  std::map<Rung*, double> first;
  double round = 0.0;
  for (Ladder& ladder : ladders)
    for (Rung& rung : ladder.rungs()) {
      first[&rung] = rung.times[0];
      rung.times.clear();
      if (first[&rung] < 0.3) round += std::max(batch, first[&rung]);
    }
  const int rounds = std::clamp(static_cast<int>(budget / round), 3, 21);
  for (int i = 0; i < rounds; ++i)
    for (Ladder& ladder : ladders)
      for (Rung& rung : ladder.rungs()) {
        const double once = first[&rung];
        rung.times.push_back(once < 0.3 ? rung.timed(std::max(1, static_cast<int>(batch / once)))
                                        : once);
      }
}

/// The median over the rounds of the least time of `ours` by the least time of `theirs`, at this
/// error; infinite if ours do not reach it. Where theirs do not, the time of their most exact run
/// counts, which is less than they would need.
inline double ratio_at(double error, const std::vector<const Ladder*>& ours,
                       const std::vector<const Ladder*>& theirs) {
  std::vector<double> ratios;
  const std::size_t rounds = ours[0]->rungs()[0].times.size();
  for (std::size_t i = 0; i < rounds; ++i) {
    double mine = HUGE_VAL, other = HUGE_VAL, best = HUGE_VAL;
    for (const Ladder* ladder : ours) mine = std::min(mine, ladder->time_at(error, i));
    for (const Ladder* ladder : theirs) other = std::min(other, ladder->time_at(error, i));
    for (const Ladder* ladder : theirs) best = std::min(best, ladder->time_of_best(i));
    ratios.push_back(mine / (std::isfinite(other) ? other : best));
  }
  return median(ratios);
}

}  // namespace bench
