// Is any answer silently wrong? Extreme scenes by every method: docs/stability.md.
//   extremes [--quick] [--out FILE] [WORDS]    only the scenes whose name contains WORDS
#include <fstream>
#include <iostream>
#include <sstream>
#include <string_view>

#include "extremes/all.hpp"
#include "extremes/page.hpp"

namespace {

struct Asked {
  bool quick = false;
  std::string file = {}, words = {};
};

Asked asked(int argc, char** argv) {
  Asked all;
  for (int i = 1; i < argc; ++i) {
    const std::string_view word = argv[i];
    if (word == "--quick") {
      all.quick = true;
    } else if (word == "--out" && i + 1 < argc) {
      all.file = argv[++i];
    } else {
      all.words = word;
    }
  }
  return all;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace extremes;
  const Asked what = asked(argc, argv);
  std::ostringstream page;
  Tally tally;
  write_introduction(page);
  for (const Group& group : all_groups()) {
    write_head(page, group);
    for (const Case& c : group.cases) {
      if ((what.quick && !c.quick) || c.name.find(what.words) == std::string::npos) continue;
      for (const std::string& method : c.methods) {
        const Row row = run(c, method);
        write(page, c, method, row);
        ++tally[row.verdict];
        std::cout << to_string(row.verdict) << '\t' << method << '\t' << c.name << '\t'
                  << row.finding.error << '\t' << row.finding.events << '\t' << row.seconds
                  << " s\t" << row.happened << std::endl;
      }
    }
  }
  write_sum(page, tally);
  if (!what.file.empty()) std::ofstream(what.file) << page.str();
  for (const auto& [verdict, rows] : tally) std::cout << to_string(verdict) << ": " << rows << '\n';
}
