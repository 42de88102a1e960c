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
TRAJET_INLINE T raised(const T& a, const ExtendedConstant& k) {
  using std::pow;
  if constexpr (requires { typename T::Coefficient; }) {
    return pow(a, k.value);
  } else {
    return pow(a, k.as<T>());
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

/// Runs the instructions from `i` on that are of the same opcode, up to `end`, and returns the one behind them. The
/// functions are those of the number type, found beside it, or those of <cmath>.
template <class T>
TRAJET_INLINE const Instruction* run_alike(const Instruction* i, const Instruction* end, const Program& program,
                                           T* slots) {
  using std::abs, std::acos, std::asin, std::atan, std::atan2, std::cbrt, std::cos, std::cosh, std::exp, std::floor,
      std::log, std::pow, std::sin, std::sinh, std::sqrt, std::tan, std::tanh;
  // found only where the opcode needs them: on plain numbers, finding them is most of the work
  const auto a = [&]() -> const T& { return slots[i->a]; };
  const auto b = [&]() -> const T& { return slots[i->b]; };
  const auto c = [&]() -> const T& { return slots[i->c]; };
  const auto k = [&] { return i->constant.as<T>(); };
  const auto result = [&]() -> T& { return slots[i->result]; };
  const auto each = [&, opcode = i->opcode](const auto& compute) {
    do {
      compute();
      ++i;
    } while (i != end && i->opcode == opcode);
    return i;
  };
  switch (i->opcode) {
    case Opcode::add:
      return each([&] { result() = a() + b(); });
    case Opcode::add_constant:
      return each([&] { result() = a() + k(); });
    case Opcode::subtract:
      return each([&] { result() = a() - b(); });
    case Opcode::constant_minus:
      return each([&] { result() = k() - a(); });
    case Opcode::multiply:
      return each([&] { result() = a() * b(); });
    case Opcode::multiply_constant:
      return each([&] { result() = k() * a(); });
    case Opcode::divide:
      return each([&] { result() = a() / b(); });
    case Opcode::divide_constant:
      return each([&] { result() = a() / k(); });
    case Opcode::constant_over:
      return each([&] { result() = k() / a(); });
    case Opcode::negate:
      return each([&] { result() = -a(); });
    case Opcode::square:
      return each([&] { result() = squared(a()); });
    case Opcode::power:
      return each([&] { result() = pow(a(), b()); });
    case Opcode::power_constant:
      return each([&] { result() = raised(a(), i->constant); });
    case Opcode::sqrt:
      return each([&] { result() = sqrt(a()); });
    case Opcode::cbrt:
      return each([&] { result() = cbrt(a()); });
    case Opcode::exp:
      return each([&] { result() = exp(a()); });
    case Opcode::log:
      return each([&] { result() = log(a()); });
    case Opcode::log10:
      return each([&] { result() = decimal_logarithm(a()); });
    case Opcode::sin:
      return each([&] { result() = sin(a()); });
    case Opcode::cos:
      return each([&] { result() = cos(a()); });
    case Opcode::sin_cos:
      return each([&] {
        result() = sin(a());
        slots[i->b] = cos(a());
      });
    case Opcode::tan:
      return each([&] { result() = tan(a()); });
    case Opcode::asin:
      return each([&] { result() = asin(a()); });
    case Opcode::acos:
      return each([&] { result() = acos(a()); });
    case Opcode::atan:
      return each([&] { result() = atan(a()); });
    case Opcode::atan2:
      return each([&] { result() = atan2(a(), b()); });
    case Opcode::sinh:
      return each([&] { result() = sinh(a()); });
    case Opcode::cosh:
      return each([&] { result() = cosh(a()); });
    case Opcode::sinh_cosh:
      return each([&] {
        result() = sinh(a());
        slots[i->b] = cosh(a());
      });
    case Opcode::tanh:
      return each([&] { result() = tanh(a()); });
    case Opcode::abs:
      return each([&] { result() = abs(a()); });
    case Opcode::sign:
      return each([&] { result() = sign(a()); });
    case Opcode::floor:
      return each([&] { result() = floor(a()); });
    case Opcode::min:
      return each([&] { result() = min(a(), b()); });
    case Opcode::max:
      return each([&] { result() = max(a(), b()); });
    case Opcode::less:
      return each([&] { result() = truth<T>(less(a(), b())); });
    case Opcode::less_equal:
      return each([&] { result() = truth<T>(less_equal(a(), b())); });
    case Opcode::equal:
      return each([&] { result() = truth<T>(equal(a(), b())); });
    case Opcode::where:
      return each([&] { result() = where(equal(a(), T(0.0)), c(), b()); });
    case Opcode::norm:
      return each([&] { result() = norm3(a(), b(), c()); });
    case Opcode::table:
      return each([&] { result() = (*program.tables[static_cast<std::size_t>(i->b)])(a()); });
  }
  return end;
}

}  // namespace detail

/// Puts the program's constants into their slots; once for any number of evaluations.  // slots: (slot_count)
template <class T>
void load_constants(const Program& program, T* slots) {
  for (const Program::Constant& constant : program.constants) slots[constant.slot] = constant.value.as<T>();
}

/// Evaluates a program whose inputs and constants are already in their slots; the outputs are then found there.
template <class T>
void run_instructions(const Program& program, T* slots) {
  const Instruction* const end = program.instructions.data() + program.instructions.size();
  for (const Instruction* i = program.instructions.data(); i != end;) i = detail::run_alike(i, end, program, slots);
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
  /// From now on the constant in a slot is another one than the program's.
  void set_constant(std::int32_t slot, double value) { slots_[static_cast<std::size_t>(slot)] = T(value); }

 private:
  const Program* program_;
  std::vector<T> slots_;
};

}  // namespace trajet
