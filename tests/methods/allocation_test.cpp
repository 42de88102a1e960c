#include <gtest/gtest.h>

#include <cstdlib>
#include <new>

#include "methods/steppers.hpp"
#include "problems/drag.hpp"
#include "trajet/ode/system_rate.hpp"

namespace {
long allocations = 0;
}  // namespace

// Not inlined: a compiler that saw through one of a pair would warn of a mismatch.
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size == 0 ? 1 : size)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace trajet {
namespace {

using problems::Drag;

template <class Method>
class Allocation : public testing::Test {};
using Methods = testing::Types<Euler, Midpoint, Rk4, Dopri5>;
TYPED_TEST_SUITE(Allocation, Methods);

/// Allocations while a started stepper runs to the end and writes every Segment; a second start included.
template <class Method, int Dim>
long allocations_after_start() {
  StepOptions options;
  options.rtol = options.atol = 1e-6;
  options.step = 0.1;
  const Eigen::Matrix<double, Dim, 1> start = Drag::start();
  auto stepper = Method::template make_stepper<Dim>(Drag(), 6, options);
  Segment<Dim> segment;
  stepper.start(0.0, start);
  stepper.advance(1.0);
  stepper.fill_segment(segment);
  const long before = allocations;
  stepper.start(0.0, start);
  while (stepper.time() != 10.0 && stepper.advance(10.0) == StepStatus::ok) stepper.fill_segment(segment);
  return allocations - before;
}

TYPED_TEST(Allocation, NoneAfterTheStart) {
  EXPECT_EQ((allocations_after_start<TypeParam, Drag::kDimension>()), 0);
  EXPECT_EQ((allocations_after_start<TypeParam, Eigen::Dynamic>()), 0);
}

TEST(Allocation, IsCounted) {
  const long before = allocations;
  int* volatile number = new int(0);  // volatile: not elided
  delete number;
  EXPECT_EQ(allocations, before + 1);
}

}  // namespace
}  // namespace trajet
