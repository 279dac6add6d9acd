// Ratios that survive a busy machine: the runners take turns, batch by batch, and medians are
// compared.
#pragma once

#include <algorithm>
#include <ctime>
#include <functional>
#include <vector>

namespace bench {

/// [s] Processor time of this program; the time of other programs does not count.
inline double processor_time() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

inline double seconds(const std::function<void()>& batch) {
  const double start = processor_time();
  batch();
  return processor_time() - start;
}

inline double median(std::vector<double> values) {
  std::ranges::sort(values);
  return values[values.size() / 2];
}

struct Timing {
  double time = 0.0;   ///< [s] median of one run
  double ratio = 0.0;  ///< median over the rounds of its time by that of the first runner
};

/// Each runner runs for `batch` seconds, in turns, `rounds` times.
inline std::vector<Timing> interleave(const std::vector<std::function<void()>>& runners,
                                      int rounds = 21, double batch = 2e-3) {
  std::vector<int> repeats;
  for (const auto& run : runners) {
    run();
    const double once = std::min(seconds(run), seconds(run));
    repeats.push_back(std::max(1, static_cast<int>(batch / once)));
  }
  std::vector<std::vector<double>> times(runners.size()), ratios(runners.size());
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t i = 0; i < runners.size(); ++i) {
      const double total = seconds([&] {
        for (int k = 0; k < repeats[i]; ++k) runners[i]();
      });
      times[i].push_back(total / repeats[i]);
      ratios[i].push_back(times[i].back() / times[0].back());
    }
  }
  std::vector<Timing> result;
  for (std::size_t i = 0; i < runners.size(); ++i)
    result.push_back({median(times[i]), median(ratios[i])});
  return result;
}

}  // namespace bench
