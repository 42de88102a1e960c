#include "block_program.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "graph.hpp"
#include "hidden_poles.hpp"
#include "lane_reader.hpp"
#include "trajet/portable.hpp"

namespace trajet::detail {
namespace {

using Kind = BlockInstruction::Kind;

/// Makes a BlockProgram from the rates back to the state. Where blocks do not pay, what they needed is undone.
class Bundler {
 public:
  explicit Bundler(const Program& program)
      : program_(program),
        lanes_(program),
        hides_pole_(find_hidden_poles(program)),
        homes_(static_cast<std::size_t>(program.slot_count)),
        is_ready_(static_cast<std::size_t>(program.slot_count), false) {}

  BlockProgram run() {
    const std::vector<int> counts = choose_groups();
    undo_to({});
    groups_are_chosen_ = true;
    int first = 0;
    for (const int count : counts) {
      if (count > 1) result_.groups.push_back({first, count, new_block(lanes_.inputs(first, count), true), -1});
      if (count == 1) result_.single.push_back(first);
      first += count;
    }
    for (const int component : result_.single) make_ready(program_.outputs[static_cast<std::size_t>(component)]);
    for (BlockProgram::Group& group : result_.groups) group.rate = block(lanes_.outputs(group.first, group.count));
    return std::move(result_);
  }

 private:
  /// How far the work has come, to go back to.
  struct Mark {
    std::size_t instructions = 0, constants = 0, blocks = 0, homes = 0, ready = 0;
    int block_count = 0;
  };
  Mark mark() const {
    return {result_.instructions.size(), result_.constants.size(), known_in_order_.size(), at_home_.size(),
            ready_in_order_.size(),      result_.block_count};
  }
  void undo_to(const Mark& mark) {
    result_.instructions.resize(mark.instructions);
    result_.constants.resize(mark.constants);
    result_.block_count = mark.block_count;
    for (; known_in_order_.size() > mark.blocks; known_in_order_.pop_back()) known_.erase(known_in_order_.back());
    for (; at_home_.size() > mark.homes; at_home_.pop_back()) home(at_home_.back()) = {};
    for (; ready_in_order_.size() > mark.ready; ready_in_order_.pop_back())
      is_ready_[static_cast<std::size_t>(ready_in_order_.back())] = false;
  }

  /// How many neighbouring components make a group each, 1 … 4: what saves the most for each of them.
  std::vector<int> choose_groups() {
    const int dimension = static_cast<int>(program_.outputs.size());
    std::vector<int> counts;
    for (int first = 0; first < dimension; first += counts.back()) {
      int best = 1;
      double most = 0.0;
      for (int count = 2; count <= std::min(4, dimension - first); ++count) {
        const Mark before = mark();
        make_rates(first, count, false);
        const auto alone = static_cast<double>(result_.instructions.size());
        undo_to(before);
        make_rates(first, count, true);
        const auto together = static_cast<double>(result_.instructions.size());
        undo_to(before);
        // the state's next coefficients are computed together too
        const double saved = (alone - together + count - 1) / count;
        if (saved > most) std::tie(most, best) = std::pair(saved, count);
      }
      make_rates(first, best, best > 1);
      counts.push_back(best);
    }
    return counts;
  }
  void make_rates(int first, int count, bool as_block) {
    if (as_block) {
      new_block(lanes_.inputs(first, count), true);
      block(lanes_.outputs(first, count));
    } else {
      for (int i = first; i < first + count; ++i) make_ready(program_.outputs[static_cast<std::size_t>(i)]);
    }
  }

  Place& home(int slot) { return homes_[static_cast<std::size_t>(slot)]; }
  bool is_ready(int slot) const { return lanes_.is_constant(slot) || is_ready_[static_cast<std::size_t>(slot)]; }
  void set_ready(int slot) {
    is_ready_[static_cast<std::size_t>(slot)] = true;
    ready_in_order_.push_back(slot);
  }

  /// A new block of these lanes; where it computes them, they are at home there.
  int new_block(const Lanes& lanes, bool computes) {
    const int block = result_.block_count++;
    known_[lanes] = block;
    known_in_order_.push_back(lanes);
    for (int lane = 0; computes && lane < Block4::kLanes; ++lane) {
      const int slot = lanes[static_cast<std::size_t>(lane)];
      if (slot < 0 || LaneReader::is_negative(slot) || lanes_.is_constant(slot)) continue;
      if (home(slot).block >= 0) continue;
      home(slot) = {block, lane};
      at_home_.push_back(slot);
    }
    return block;
  }

  /// Has a number in its slot.
  void make_ready(int slot) {
    if (is_ready(slot)) return;
    const int producer = lanes_.producer(slot);
    if (const Place place = home(slot); place.block >= 0) {
      result_.instructions.push_back({.kind = Kind::unpack, .result = slot, .a = place.block, .b = place.index});
    } else if (producer >= 0) {
      const Instruction& i = program_.instructions[static_cast<std::size_t>(producer)];
      if (reduce(slot) >= 0) return;
      const std::array operands{i.a, i.b, i.c};
      for (int k = 0; k < operand_count(i.opcode); ++k) make_ready(operands[static_cast<std::size_t>(k)]);
      result_.instructions.push_back({.kind = Kind::scalar, .result = producer});
      if (i.opcode == Opcode::sin_cos || i.opcode == Opcode::sinh_cosh) set_ready(slot == i.result ? i.b : i.result);
    }
    set_ready(slot);
  }

  /// Has these lanes in a block; -1 where there are negatives among them that no operation takes in.
  int block(Lanes lanes) {
    lanes = LaneReader::spread(lanes);
    if (const auto known = known_.find(lanes); known != known_.end()) return known->second;
    if (lanes_.are_constant(lanes)) {
      const int result = new_block(lanes, false);
      result_.constants.push_back({result, lanes_.values(lanes), lanes_.constant_slots(lanes)});
      return result;
    }
    const int computed = compute(lanes);
    return computed >= 0 || LaneReader::has_negative(lanes) ? computed : collect(lanes);
  }

  /// The lanes from where they are, which is found or made.
  int collect(const Lanes& lanes) {
    // until groups are chosen, neighbours may become one
    if (!groups_are_chosen_ && lanes_.are_neighbouring_inputs(lanes)) return new_block(lanes, false);
    Lanes constants{-1, -1, -1, -1};
    for (std::size_t lane = 0; lane < 4; ++lane)
      if (lanes[lane] >= 0 && lanes_.is_constant(lanes[lane])) constants[lane] = lanes[lane];
    const int constant_block = constants == Lanes{-1, -1, -1, -1} ? -1 : block(constants);
    BlockInstruction instruction{.kind = Kind::collect};
    for (std::size_t lane = 0; lane < 4; ++lane) {
      const bool is_spare = lanes[lane] < 0;
      const int slot = is_spare ? lanes[0] : lanes[lane];
      Place& place = instruction.places[lane];
      if (lanes_.is_constant(slot)) {
        place = {constant_block, is_spare ? 0 : static_cast<int>(lane)};
        continue;
      }
      if (home(slot).block < 0) make_ready(slot);
      place = home(slot).block >= 0 ? home(slot) : Place{-1, slot};
    }
    const int source = instruction.places[0].block;
    if (source >= 0 &&
        ranges::all_of(instruction.places, [source](const Place& place) { return place.block == source; })) {
      instruction.kind = Kind::permute;
      instruction.a = source;
    }
    instruction.result = new_block(lanes, false);
    result_.instructions.push_back(instruction);
    return instruction.result;
  }
  /// The collect that was the last instruction, if it made this block.
  const BlockInstruction* last_collect(int block) const {
    if (result_.instructions.empty()) return nullptr;
    const BlockInstruction& last = result_.instructions.back();
    const bool collects = last.kind == Kind::collect || last.kind == Kind::permute;
    return collects && last.result == block ? &last : nullptr;
  }

  /// The lanes by one operation on blocks, -1 if there is none, or none that pays.
  int compute(const Lanes& lanes) {
    if (LaneReader::count_distinct(lanes) == 1 && !LaneReader::has_negative(lanes)) {
      if (is_ready(lanes[0])) return -1;
      if (const int reduced = reduce(lanes[0]); reduced >= 0) return reduced;
    }
    const auto operation = lanes_.operation(lanes);
    if (!operation || hides_pole(*operation, lanes)) return -1;
    const Mark before = mark();
    BlockInstruction instruction{.kind = operation->kind, .constant = operation->constant};
    int collects = 0;
    const auto operand = [&](const Lanes& needed) {
      const auto count = result_.instructions.size();
      const int result = block(needed);
      if (result_.instructions.size() > count && last_collect(result) != nullptr) ++collects;
      return result;
    };
    instruction.a = operand(operation->a);
    if (has_two_operands(operation->kind)) instruction.b = operand(operation->b);
    // else it is as many instructions, and a collect
    if (instruction.a < 0 || instruction.b < 0 || collects > operation->replaced) {
      undo_to(before);
      return -1;
    }
    instruction.result = new_block(lanes, true);
    result_.instructions.push_back(instruction);
    return instruction.result;
  }
  static bool has_two_operands(Kind kind) {
    return kind == Kind::add || kind == Kind::multiply || kind == Kind::divide;
  }
  bool hides_pole(const LaneReader::Operation& operation, const Lanes& lanes) const {
    return operation.kind == Kind::divide && ranges::any_of(lanes, [this](int slot) {
             return slot >= 0 && hides_pole_[static_cast<std::size_t>(lanes_.producer(slot))];
           });
  }

  /// A length or a product of vectors, in all lanes and in its slot; -1 where the vectors are in no blocks.
  int reduce(int slot) {
    const auto operation = lanes_.reduction(slot);
    if (!operation) return -1;
    const Mark before = mark();
    bool is_in_blocks = true;
    const auto operand = [&](const Lanes& vector) {
      const int result = block(vector);
      const BlockInstruction* collected = last_collect(result);
      if (collected != nullptr && ranges::any_of(collected->places, [](const Place& place) { return place.block < 0; }))
        is_in_blocks = false;
      return result;
    };
    BlockInstruction instruction{.kind = operation->kind, .slot = slot};
    instruction.a = operand(operation->a);
    if (operation->kind == Kind::dot) instruction.b = operand(operation->b);
    if (!is_in_blocks) {
      undo_to(before);
      return -1;
    }
    instruction.result = new_block({slot, slot, slot, slot}, true);
    result_.instructions.push_back(instruction);
    set_ready(slot);
    return instruction.result;
  }

  const Program& program_;
  LaneReader lanes_;
  std::vector<bool> hides_pole_;
  BlockProgram result_;
  bool groups_are_chosen_ = false;
  std::map<Lanes, int> known_;
  std::vector<Place> homes_;    // of slots: the lanes in which they are computed
  std::vector<bool> is_ready_;  // slots that have their number
  std::vector<Lanes> known_in_order_;
  std::vector<int> at_home_, ready_in_order_;
};

/// The longest chain of instructions that need each other.
int depth(const Program& program) {
  std::vector<int> depths(static_cast<std::size_t>(program.slot_count), 0);
  int deepest = 0;
  for (const Instruction& i : program.instructions) {
    const std::array operands{i.a, i.b, i.c};
    int& result = depths[static_cast<std::size_t>(i.result)];
    for (int k = 0; k < operand_count(i.opcode); ++k)
      result = std::max(result, depths[static_cast<std::size_t>(operands[static_cast<std::size_t>(k)])] + 1);
    if (i.opcode == Opcode::sin_cos || i.opcode == Opcode::sinh_cosh) depths[static_cast<std::size_t>(i.b)] = result;
    deepest = std::max(deepest, result);
  }
  return deepest;
}

}  // namespace

std::optional<BlockProgram> bundle(const Program& program) {
  constexpr int kDeepest = 1000;  // the bundler calls itself this often
  constexpr double kWorthwhile = 0.8;
  constexpr std::size_t kLongest = 200;  // bundling costs more than its square, and contacts make laws anew often
  if (program.instructions.size() > kLongest || depth(program) > kDeepest) return std::nullopt;
  BlockProgram blocks = Bundler(program).run();
  const auto work = blocks.instructions.size() + blocks.groups.size() + blocks.single.size();
  const auto work_on_slots = program.instructions.size() + program.outputs.size();
  if (static_cast<double>(work) > kWorthwhile * static_cast<double>(work_on_slots)) return std::nullopt;
  return blocks;
}

}  // namespace trajet::detail
