#include "trajet/law/rate_evaluator.hpp"

#include <algorithm>
#include <utility>

#include "block_rows.hpp"
#include "trajet/law/evaluate.hpp"

namespace trajet {

RateEvaluator::RateEvaluator(const Program& program)
    : program_(&program), slots_(static_cast<std::size_t>(program.slot_count)) {
  load_constants(program, slots_.data());
  auto blocks = detail::bundle(program);
  if (!blocks) return;
  blocks_ = std::make_unique<detail::BlockRows>(std::move(*blocks));
  const auto& groups = blocks_->program().groups;
  state_.resize((groups.size() + 3) / 4);
  rate_.resize(state_.size());
  blocks_->place_rates(state(), rate_.data()->data(),
                       [this](int slot) { return &slots_[static_cast<std::size_t>(slot)]; });
  if (!blocks_->program().single.empty()) return;
  for (std::size_t g = 0; g < groups.size(); ++g)
    for (int lane = 0; lane < groups[g].count; ++lane) lanes_.push_back(static_cast<int>(g) * Block4::kLanes + lane);
}

RateEvaluator::~RateEvaluator() = default;

void RateEvaluator::set_constant(std::int32_t slot, double value) {
  slots_[static_cast<std::size_t>(slot)] = value;
  if (blocks_) blocks_->set_constant(slot, value);
}

void RateEvaluator::run_blocks() {
  const Instruction* const instructions = program_->instructions.data();
  blocks_->run(detail::ValueOnly(), 1.0, [&](int index) {
    const Instruction* const i = instructions + index;
    detail::run_alike(i, i + 1, *program_, slots_.data());
  });
}

void RateEvaluator::evaluate_blocks(double t) {
  slots_[0] = t;
  run_blocks();
}

void RateEvaluator::operator()(double t, const double* q, double* dq) {
  slots_[0] = t;
  if (!blocks_) {
    std::copy(q, q + program_->input_count - 1, slots_.begin() + 1);
    run_instructions(*program_, slots_.data());
    for (const std::int32_t slot : program_->outputs) *dq++ = slots_[static_cast<std::size_t>(slot)];
    return;
  }
  blocks_->pack(q, state());
  for (const int i : blocks_->program().single) slots_[static_cast<std::size_t>(1 + i)] = q[i];
  run_blocks();
  blocks_->unpack(rate(), dq);
  for (const int i : blocks_->program().single)
    dq[i] = slots_[static_cast<std::size_t>(program_->outputs[static_cast<std::size_t>(i)])];
}

}  // namespace trajet
