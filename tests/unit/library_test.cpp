// library.hpp and docs/blocks.md hold every block of include/saltus/library.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "library_support.hpp"

namespace {

namespace fs = std::filesystem;

const fs::path root = SALTUS_ROOT;  // not from __FILE__, which ccache makes relative

std::string read(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

/// The class name in a header that holds a block; empty in one that holds something else.
std::string block_in(const std::string& header) {
  const std::string before = "class ", after = " final : public LeafSystem";
  const auto end = header.find(after);
  if (end == std::string::npos) return {};
  const auto start = header.rfind(before, end) + before.size();
  return header.substr(start, end - start);
}

}  // namespace

TEST_CASE("every block has one header in library.hpp and one row in docs/blocks.md", "[library]") {
  const std::string library = read(root / "include/saltus/library/library.hpp");
  const std::string rows = read(root / "docs/blocks.md");
  int blocks = 0;
  for (const auto& entry : fs::directory_iterator(root / "include/saltus/library")) {
    const std::string header = read(entry.path()), block = block_in(header);
    if (block.empty()) continue;
    ++blocks;
    INFO(entry.path().filename().string());
    CHECK(library_test::contains(library,
                                 saltus::text("library/", entry.path().filename().string(), "\"")));
    CHECK(library_test::contains(rows, saltus::text("| `", block, "`")));
    CHECK(header.starts_with("// "));  // opens with what it means
  }
  CHECK(blocks >= 22);
}
