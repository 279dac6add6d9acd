// From the instructions of a program to wide ones.
#include <algorithm>
#include <map>
#include <tuple>

#include "kernels.hpp"
#include "wide.hpp"

namespace saltus::tape::series {

namespace {

/// The narrow rows in the lanes of a wide one.
using Lanes = std::array<Index, lanes>;

class Widening {
 public:
  explicit Widening(const Program& program)
      : program_(program), place_(static_cast<std::size_t>(program.rows), -1) {
    place(zero_row) = new_row();
  }

  /// Makes the wide instructions; returns whether they pay.
  bool run() {
    if (!sort()) return false;
    wide_.states = wide_row_size * wide_.rows;
    wide_.rows += (program_.states + lanes - 1) / lanes;
    for (Index i = 0; i < program_.states; ++i) {
      place(row_size * (1 + i)) = wide_.place_of_state(i);
    }
    if (program_.time_row != zero_row) wide_.time = place(program_.time_row) = new_row();
    for (auto& [key, numbers] : buckets_) {
      align(numbers);
      for (std::size_t i = 0; i < numbers.size(); i += lanes) {
        const auto count = std::min<std::size_t>(lanes, numbers.size() - i);
        add_group(std::span(numbers).subspan(i, count));
      }
    }
    for (const auto& [to, from] : late_) add_pack(to, from);
    add_next();
    // a wide instruction takes 2.7 times as long as a narrow one (bench/series)
    return 8 * wide_.instructions.size() <= 3 * (narrow().size() + program_.rates.size());
  }

  Wide take() { return std::move(wide_); }

 private:
  std::span<const Instruction> narrow() const {
    return {program_.instructions.data(), static_cast<std::size_t>(program_.first_instructions)};
  }
  Index& place(Index row) { return place_[static_cast<std::size_t>(row / row_size)]; }
  Index new_row() { return wide_row_size * wide_.rows++; }

  /// Alike instructions that do not need each other have one key: the level is 1 + the highest
  /// level of the rows that are read. False if an instruction has no wide kernel.
  bool sort() {
    std::vector<int> levels(static_cast<std::size_t>(program_.rows), 0);
    const auto level_of = [&](Index row) -> int& {
      return levels[static_cast<std::size_t>(row / row_size)];
    };
    for (std::size_t number = 0; number < narrow().size(); ++number) {
      const Instruction& i = narrow()[number];
      if (i.kernel->wide.orders[1] == nullptr) return false;
      int level = std::max(level_of(i.a), level_of(i.b));  // 0 where b is computed later
      for (const Term& term : terms(i)) level = std::max(level, level_of(term.row));
      level_of(i.to) = level + 1;
      if (i.kernel->reads.second) level_of(i.to_second) = level + 1;
      buckets_[{level, number_of(i.kernel), i.terms, i.factor}].push_back(static_cast<int>(number));
    }
    return true;
  }
  static std::span<const Term> terms(const Instruction& i) {
    return {i.term, static_cast<std::size_t>(i.terms)};
  }
  /// A number for each kernel, in the order in which they appear.
  int number_of(const Kernel* kernel) {
    const auto found = std::ranges::find(kernels_, kernel);
    if (found == kernels_.end()) kernels_.push_back(kernel);
    return static_cast<int>(std::ranges::find(kernels_, kernel) - kernels_.begin());
  }

  /// Sorts instructions so that the operands b of four of them are often a wide row: first the
  /// first reader of each b, then the second reader of each, and so on.
  void align(std::vector<int>& numbers) {
    const auto instruction = [&](int n) { return narrow()[static_cast<std::size_t>(n)]; };
    if (!instruction(numbers[0]).kernel->reads.b) return;
    std::map<Index, int> readers;
    std::vector<std::tuple<int, Index, int>> sorted;
    for (const int n : numbers) {
      const Index b = instruction(n).b;
      sorted.push_back({readers[b]++, place(b), n});
    }
    std::ranges::sort(sorted);
    std::ranges::transform(sorted, numbers.begin(), [](const auto& s) { return std::get<2>(s); });
  }

  void add_group(std::span<const int> numbers) {
    const auto of_lane =
        [&](Index l) -> const Instruction& {  // lanes left over repeat the last one
      const auto n = std::min(static_cast<std::size_t>(l), numbers.size() - 1);
      return narrow()[static_cast<std::size_t>(numbers[n])];
    };
    WideInstruction wide;
    wide.kernel = of_lane(0).kernel;
    const Reads reads = wide.kernel->reads;
    wide.factor = of_lane(0).factor;
    wide.to = new_row();
    if (reads.second) wide.to_second = new_row();
    const auto lanes_of = [&](Index Instruction::*row) {
      Lanes all{};
      for (Index l = 0; l < lanes; ++l) all[static_cast<std::size_t>(l)] = of_lane(l).*row;
      return all;
    };
    for (Index l = lanes - 1; l >= 0; --l) {
      wide.narrow[static_cast<std::size_t>(l)] = &of_lane(l);
      place(of_lane(l).to) = wide.to + l;
      if (reads.second) place(of_lane(l).to_second) = wide.to_second + l;
    }
    if (reads.linear) {
      std::vector<std::vector<Term>> terms;
      for (Index l = 0; l < lanes; ++l) terms.push_back(terms_of(of_lane(l)));
      append_terms(wide, terms);
    } else {
      const Lanes a = lanes_of(&Instruction::a);
      std::ranges::transform(a, wide.a_of_lane.begin(), [&](Index row) { return place(row); });
      if (reads.a) wide.a = operand(a, numbers.size());
      if (reads.b) wide.b = operand(lanes_of(&Instruction::b), numbers.size());
      if (reads.da) wide.da = new_row();
      if (reads.db) wide.db = new_row();
    }
    wide_.instructions.push_back(wide);
  }

  static std::vector<Term> terms_of(const Instruction& i) {
    if (i.kernel == &multiple) return {{i.a, i.of_b}};
    if (i.kernel == &plus || i.kernel == &minus) return {{i.a, 0}, {i.b, 0}};
    return {terms(i).begin(), terms(i).end()};
  }

  /// Term n of all lanes, then the next one.
  void append_terms(WideInstruction& wide, const std::vector<std::vector<Term>>& of_lanes) {
    wide.first_term = static_cast<Index>(wide_.terms.size());
    wide.terms = static_cast<Index>(of_lanes[0].size());
    for (std::size_t n = 0; n < of_lanes[0].size(); ++n) {
      for (const auto& all : of_lanes) {
        wide_.terms.push_back({place(all[n].row), all[n].factor});
      }
    }
  }

  /// The states come last. Lanes that are left over get zeros.
  void add_next() {
    for (Index i = 0; i < program_.states; i += lanes) {
      WideInstruction wide;
      wide.kernel = &next;
      wide.to = wide_.place_of_state(i);
      std::vector<std::vector<Term>> of_lanes(lanes, {Term{}});
      for (Index l = 0; l < std::min(lanes, program_.states - i); ++l) {
        of_lanes[static_cast<std::size_t>(l)] = {
            program_.rates[static_cast<std::size_t>(i + l)].term};
      }
      append_terms(wide, of_lanes);
      wide_.instructions.push_back(wide);
    }
  }

  /// A wide row whose first `count` lanes are these: an existing row, or a copy.
  Index operand(const Lanes& rows, std::size_t count) {
    const Index first = place(rows[0]);
    bool exists = first >= 0 && first % lanes == 0, all_known = true;
    for (std::size_t l = 0; l < count; ++l) {
      exists = exists && place(rows[l]) == first + static_cast<Index>(l);
      all_known = all_known && place(rows[l]) >= 0;
    }
    if (exists) return first;
    const auto [known, is_new] = packs_.try_emplace(rows, 0);
    if (!is_new) return known->second;
    const Index to = known->second = new_row();
    if (all_known) {
      add_pack(to, rows);
    } else {
      late_.push_back({to, rows});  // only coefficients of lower orders are read
    }
    return to;
  }

  void add_pack(Index to, const Lanes& rows) {
    WideInstruction wide;
    wide.kernel = &copies;
    wide.to = to;
    std::vector<std::vector<Term>> of_lanes;
    for (const Index row : rows) of_lanes.push_back({{row, 0}});
    append_terms(wide, of_lanes);
    wide_.instructions.push_back(wide);
  }

  const Program& program_;
  Wide wide_;
  std::vector<Index> place_;  ///< of each narrow row: its first number in its lane; -1: none yet
  std::map<std::tuple<int, int, Index, double>, std::vector<int>> buckets_;
  std::vector<const Kernel*> kernels_;
  std::map<Lanes, Index> packs_;
  std::vector<std::pair<Index, Lanes>> late_;
};

/// Sets the pointers, which need vectors that no longer move, and makes the calls.
void connect(Wide& wide) {
  for (WideInstruction& i : wide.instructions) {
    i.term = wide.terms.data() + i.first_term;
    wide.calls.append(i.kernel->wide, i, wide.sums);
    wide.own.push_back(wide.sums);
    wide.sums += i.kernel->reads.linear ? lanes * i.terms : wide_sums_size;
  }
}

}  // namespace

std::shared_ptr<const Wide> widen(const Program& program) {
  Widening widening(program);
  if (!widening.run()) return nullptr;
  const auto wide = std::make_shared<Wide>(widening.take());
  connect(*wide);
  return wide;
}

}  // namespace saltus::tape::series
