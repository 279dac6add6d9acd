// Is any answer silently wrong? Extreme scenes by every method: docs/stability.md.
//   extremes [--quick] [--out FILE] [WORDS]    only the scenes whose name contains WORDS
#include <fstream>
#include <iostream>
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

extremes::Table run_group(const extremes::Group& group, const Asked& what) {
  using namespace extremes;
  Table table{group.title, group.text, {}};
  for (const Case& c : group.cases) {
    if ((what.quick && !c.quick) || c.name.find(what.words) == std::string::npos) continue;
    for (saltus::Method method : c.methods) {
      const Row row = run(c, method);
      std::cout << to_string(row.verdict) << '\t' << to_string(method) << '\t' << c.name << '\t'
                << row.finding.error << '\t' << row.finding.events << '\t' << row.seconds << " s\t"
                << row.happened << std::endl;
      table.lines.push_back({c.name, std::string(to_string(method)), row});
    }
  }
  return table;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace extremes;
  const Asked what = asked(argc, argv);
  std::vector<Table> tables;
  for (const Group& group : all_groups()) {
    tables.push_back(run_group(group, what));
    if (tables.back().lines.empty()) tables.pop_back();
  }
  write_sum(std::cout, tables);
  if (what.file.empty()) return 0;
  std::ofstream page(what.file);
  write_introduction(page);
  write_sum(page, tables);
  for (const Table& table : tables) write(page, table);
}
