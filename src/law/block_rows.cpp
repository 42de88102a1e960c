#include "block_rows.hpp"

#include "trajet/portable.hpp"

namespace trajet::detail {
namespace {

using Kind = BlockInstruction::Kind;
using Code = BlockStep::Code;

bool makes_block(Kind kind) { return kind != Kind::scalar && kind != Kind::unpack; }
bool has_two_operands(Kind kind) {
  return kind == Kind::add || kind == Kind::multiply || kind == Kind::divide || kind == Kind::dot;
}

Block4 loaded(const double* x, int count) { return Block4(x[0], x[1], count > 2 ? x[2] : 0.0, count > 3 ? x[3] : 0.0); }
void store(const Block4& block, int count, double* x) {
  if (count == 4) return block.store(x);
  std::memcpy(x, &block, 2 * sizeof(double));
  if (count == 3) x[2] = block[2];
}

/// The code of an instruction after one that made `newest`. Operands are swapped where that is better.
Code code_of(BlockInstruction& i, int newest) {
  const auto one_of = [&](Code from_memory, Code newest_first) { return i.a == newest ? newest_first : from_memory; };
  switch (i.kind) {
    case Kind::scalar:
      return Code::scalar;
    case Kind::unpack:
      return Code::unpack;
    case Kind::collect:
      return Code::collect;
    case Kind::permute:
      return one_of(Code::permute_a, Code::permute_x);
    case Kind::add:
      return i.a != i.b && i.b == newest ? Code::add_ax : one_of(Code::add_ab, Code::add_xb);
    case Kind::multiply:
      if (i.b == newest) std::swap(i.a, i.b);
      return one_of(Code::multiply_ab, Code::multiply_xb);
    case Kind::multiply_constant:
      return one_of(Code::multiply_constant_a, Code::multiply_constant_x);
    case Kind::square:
      return one_of(Code::square_a, Code::square_x);
    case Kind::divide:
      return i.a != i.b && i.b == newest ? Code::divide_ax : one_of(Code::divide_ab, Code::divide_xb);
    case Kind::divide_constant:
      return one_of(Code::divide_constant_a, Code::divide_constant_x);
    case Kind::norm:
      return one_of(Code::norm_a, Code::norm_x);
    case Kind::dot:
      return i.a == i.b ? one_of(Code::dot_aa, Code::dot_xx) : Code::dot_ab;
  }
  return Code::scalar;
}

}  // namespace

void BlockRows::allocate(int stride) {
  const auto count = static_cast<std::size_t>(program_.block_count);
  storage_.assign(count * static_cast<std::size_t>(stride), Block4(0.0));
  rows_.resize(count);
  for (std::size_t block = 0; block < count; ++block)
    rows_[block] = storage_.data() + block * static_cast<std::size_t>(stride);
  for (const BlockProgram::Constant& constant : program_.constants)
    *row(constant.block) = loaded(constant.lanes.data(), Block4::kLanes);
  steps_.clear();
  sources_.clear();
  // the state that is needed first
  first_ = program_.groups.front().state;
  const auto needs_block = ranges::find_if(
      program_.instructions, [](const BlockInstruction& i) { return makes_block(i.kind) && i.kind != Kind::collect; });
  if (needs_block != program_.instructions.end() && is_state(needs_block->a)) first_ = needs_block->a;
  newest_ = first_;
  is_made_.assign(count, false);
  for (const BlockInstruction& i : program_.instructions)
    if (makes_block(i.kind)) is_made_[static_cast<std::size_t>(i.result)] = true;
}

bool BlockRows::is_state(int block) const {
  return ranges::any_of(program_.groups, [block](const auto& group) { return group.state == block; });
}

void BlockRows::place_series(int stride, const SlotRow& slot_row) {
  allocate(stride);
  std::vector<std::vector<int>> states(rows_.size());  // whose rate a block is
  for (const auto& group : program_.groups) states[static_cast<std::size_t>(group.rate)].push_back(group.state);
  const auto integrate = [&](int rate, Code code) {
    for (const int state : states[static_cast<std::size_t>(rate)])
      steps_.push_back({.result = row(state), .a = row(rate), .code = code});
  };
  for (int block = 0; block < program_.block_count; ++block)
    if (!is_made(block)) integrate(block, Code::integrate_a);
  for (const BlockInstruction& i : program_.instructions) {
    add_step(i, slot_row);
    if (makes_block(i.kind)) integrate(i.result, Code::integrate_x);
  }
}

void BlockRows::place_rates(Block4* state, Block4* rate, const SlotRow& slot_row) {
  allocate(1);
  const auto& groups = program_.groups;
  for (std::size_t g = 0; g < groups.size(); ++g) rows_[static_cast<std::size_t>(groups[g].state)] = state + g;
  std::vector<std::size_t> copied;
  std::vector<bool> is_placed(rows_.size(), false);
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const auto block = static_cast<std::size_t>(groups[g].rate);
    if (!is_made(groups[g].rate) || is_placed[block]) {
      copied.push_back(g);
      continue;
    }
    // what makes a rate writes it where it is wanted
    rows_[block] = rate + g;
    is_placed[block] = true;
  }
  for (const BlockInstruction& i : program_.instructions) add_step(i, slot_row);
  for (const std::size_t g : copied)
    steps_.push_back({.result = rate + g, .a = row(groups[g].rate), .code = Code::copy_a});
}

void BlockRows::add_sources(const BlockInstruction& i, const SlotRow& slot_row) {
  Sources sources;
  for (std::size_t lane = 0; lane < i.places.size(); ++lane) {
    const auto [block, index] = i.places[lane];
    sources.row[lane] = block < 0 ? slot_row(index) : reinterpret_cast<const double*>(row(block)) + index;
    sources.stride[lane] = block < 0 ? 1 : Block4::kLanes;
  }
  sources_.push_back(sources);
}

void BlockRows::add_step(const BlockInstruction& instruction, const SlotRow& slot_row) {
  BlockInstruction i = instruction;
  BlockStep step{.constant = i.constant, .code = code_of(i, newest_)};
  step.a = row(i.a);
  if (has_two_operands(i.kind)) step.b = row(i.b);
  if (makes_block(i.kind)) {
    step.result = row(i.result);
    newest_ = i.result;
  }
  switch (i.kind) {
    case Kind::scalar:
      step.index = i.result;
      break;
    case Kind::unpack:
      step.slot = slot_row(i.result);
      step.index = i.b;
      break;
    case Kind::norm:
    case Kind::dot:
      step.slot = slot_row(i.slot);
      break;
    case Kind::divide_constant:
      step.own = i.constant;
      step.constant = Block4(1.0) / i.constant;
      break;
    case Kind::permute: {
      const auto lane = [&](std::size_t k) { return std::int64_t{i.places[k].index}; };
      step.own = Block4(Block4::Bits{lane(0), lane(1), lane(2), lane(3)});
      break;
    }
    case Kind::collect:
      step.index = static_cast<int>(sources_.size());
      add_sources(i, slot_row);
      break;
    default:
      break;
  }
  steps_.push_back(step);
}

void BlockRows::set_constant(int slot, double value) {
  for (BlockProgram::Constant& constant : program_.constants)
    for (std::size_t lane = 0; lane < constant.lanes.size(); ++lane) {
      if (constant.slots[lane] != slot) continue;
      constant.lanes[lane] = value;
      if (!rows_.empty()) *row(constant.block) = loaded(constant.lanes.data(), Block4::kLanes);
    }
}

void BlockRows::pack(const double* q, Block4* blocks) const {
  for (const auto& group : program_.groups) *blocks++ = loaded(q + group.first, group.count);
}

void BlockRows::unpack(const Block4* blocks, double* q) const {
  for (const auto& group : program_.groups) store(*blocks++, group.count, q + group.first);
}

void BlockRows::set_state(const double* q) {
  for (const auto& group : program_.groups) *row(group.state) = loaded(q + group.first, group.count);
}

void BlockRows::write_state(int order, int dimension, double direction, double* coefficients) const {
  double power = 1.0;  // (ds/dt)^k
  for (int k = 0; k <= order; ++k, power *= direction)
    for (const auto& [first, count, state, rate] : program_.groups) {
      const Block4 series = power * row(state)[k];
      double* const place = coefficients + k * dimension + first;
      // what the spare lane writes is written over by what comes next, but for the last
      if (k < order || first + Block4::kLanes <= dimension) {
        series.store(place);
      } else {
        store(series, count, place);
      }
    }
}

void BlockRows::unpack_state(int order, const SlotRow& component_row) const {
  for (const auto& group : program_.groups)
    for (int lane = 0; lane < group.count; ++lane) {
      double* const series = component_row(group.first + lane);
      for (int k = 0; k <= order; ++k) series[k] = row(group.state)[k][lane];
    }
}

}  // namespace trajet::detail
