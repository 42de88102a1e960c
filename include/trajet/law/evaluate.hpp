#pragma once

#include <cmath>
#include <concepts>
#include <vector>

#include "trajet/law/program.hpp"
#include "trajet/math/force_inline.hpp"
#include "trajet/math/number.hpp"

namespace trajet {
namespace detail {

/// 1 where the condition holds, else 0; what lies between where the number type cannot tell.
template <class T, class Condition>
TRAJET_INLINE T truth(const Condition& condition) {
  return where(condition, T(1.0), T(0.0));
}

template <class T>
TRAJET_INLINE T squared(const T& a) {
  if constexpr (requires {
                  { square(a) } -> std::same_as<T>;
                }) {
    return square(a);
  } else {
    return a * a;
  }
}

/// a^k; series have an overload for plain exponents.
template <class T>
TRAJET_INLINE T raised(const T& a, double k) {
  using std::pow;
  if constexpr (requires { typename T::Coefficient; }) {
    return pow(a, k);
  } else {
    return pow(a, T(k));
  }
}

template <class T>
TRAJET_INLINE T decimal_logarithm(const T& a) {
  using std::log, std::log10;
  if constexpr (requires {
                  { log10(a) } -> std::same_as<T>;
                }) {
    return log10(a);
  } else {
    return log(a) / log(T(10.0));
  }
}

/// Runs one instruction. The functions are those of the number type, found beside it, or those of <cmath>.
template <class T>
TRAJET_INLINE void execute(const Instruction& instruction, const Program& program, T* slots) {
  using std::abs, std::acos, std::asin, std::atan, std::atan2, std::cbrt, std::cos, std::cosh, std::exp, std::floor,
      std::log, std::pow, std::sin, std::sinh, std::sqrt, std::tan, std::tanh;
  // found only where the opcode needs them: on plain numbers, finding them is most of the work
  const auto a = [&]() -> const T& { return slots[instruction.a]; };
  const auto b = [&]() -> const T& { return slots[instruction.b]; };
  const auto c = [&]() -> const T& { return slots[instruction.c]; };
  const auto result = [&]() -> T& { return slots[instruction.result]; };
  switch (instruction.opcode) {
    case Opcode::add:
      result() = a() + b();
      break;
    case Opcode::add_constant:
      result() = a() + T(instruction.constant);
      break;
    case Opcode::subtract:
      result() = a() - b();
      break;
    case Opcode::constant_minus:
      result() = T(instruction.constant) - a();
      break;
    case Opcode::multiply:
      result() = a() * b();
      break;
    case Opcode::multiply_constant:
      result() = T(instruction.constant) * a();
      break;
    case Opcode::divide:
      result() = a() / b();
      break;
    case Opcode::divide_constant:
      result() = a() / T(instruction.constant);
      break;
    case Opcode::constant_over:
      result() = T(instruction.constant) / a();
      break;
    case Opcode::negate:
      result() = -a();
      break;
    case Opcode::square:
      result() = squared(a());
      break;
    case Opcode::power:
      result() = pow(a(), b());
      break;
    case Opcode::power_constant:
      result() = raised(a(), instruction.constant);
      break;
    case Opcode::sqrt:
      result() = sqrt(a());
      break;
    case Opcode::cbrt:
      result() = cbrt(a());
      break;
    case Opcode::exp:
      result() = exp(a());
      break;
    case Opcode::log:
      result() = log(a());
      break;
    case Opcode::log10:
      result() = decimal_logarithm(a());
      break;
    case Opcode::sin:
      result() = sin(a());
      break;
    case Opcode::cos:
      result() = cos(a());
      break;
    case Opcode::sin_cos:
      result() = sin(a());
      slots[instruction.b] = cos(a());
      break;
    case Opcode::tan:
      result() = tan(a());
      break;
    case Opcode::asin:
      result() = asin(a());
      break;
    case Opcode::acos:
      result() = acos(a());
      break;
    case Opcode::atan:
      result() = atan(a());
      break;
    case Opcode::atan2:
      result() = atan2(a(), b());
      break;
    case Opcode::sinh:
      result() = sinh(a());
      break;
    case Opcode::cosh:
      result() = cosh(a());
      break;
    case Opcode::sinh_cosh:
      result() = sinh(a());
      slots[instruction.b] = cosh(a());
      break;
    case Opcode::tanh:
      result() = tanh(a());
      break;
    case Opcode::abs:
      result() = abs(a());
      break;
    case Opcode::sign:
      result() = sign(a());
      break;
    case Opcode::floor:
      result() = floor(a());
      break;
    case Opcode::min:
      result() = min(a(), b());
      break;
    case Opcode::max:
      result() = max(a(), b());
      break;
    case Opcode::less:
      result() = truth<T>(less(a(), b()));
      break;
    case Opcode::less_equal:
      result() = truth<T>(less_equal(a(), b()));
      break;
    case Opcode::equal:
      result() = truth<T>(equal(a(), b()));
      break;
    case Opcode::where:
      result() = where(equal(a(), T(0.0)), c(), b());
      break;
    case Opcode::norm:
      result() = norm3(a(), b(), c());
      break;
    case Opcode::table:
      result() = (*program.tables[static_cast<std::size_t>(instruction.b)])(a());
      break;
  }
}

}  // namespace detail

/// Puts the program's constants into their slots; once for any number of evaluations.  // slots: (slot_count)
template <class T>
void load_constants(const Program& program, T* slots) {
  for (const Program::Constant& constant : program.constants) slots[constant.slot] = T(constant.value);
}

/// Evaluates a program whose inputs and constants are already in their slots; the outputs are then found there.
template <class T>
void run_instructions(const Program& program, T* slots) {
  for (const Instruction& instruction : program.instructions) detail::execute(instruction, program, slots);
}

/// A program with slots to run it on numbers of type T: double, Pack, Interval, Series. Allocates once, when made.
/// It keeps a pointer to the program. One evaluator serves one thread at a time.
template <class T>
class Evaluator {
 public:
  explicit Evaluator(const Program& program)
      : program_(&program), slots_(static_cast<std::size_t>(program.slot_count)) {
    load_constants(program, slots_.data());
  }

  /// `state` are the inputs behind t.  // (input_count - 1); outputs: (outputs of the program)
  void operator()(const T& t, const T* state, T* outputs) {
    T* slots = slots_.data();
    slots[0] = t;
    for (int i = 1; i < program_->input_count; ++i) slots[i] = state[i - 1];
    run_instructions(*program_, slots);
    for (const std::int32_t slot : program_->outputs) *outputs++ = slots[slot];
  }

 private:
  const Program* program_;
  std::vector<T> slots_;
};

}  // namespace trajet
