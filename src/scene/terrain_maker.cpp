#include "terrain_maker.hpp"

#include <array>

#include "trajet/law/evaluate.hpp"
#include "trajet/law/program_builder.hpp"

namespace trajet {
namespace {

/// A height by a program of t, x and y that makes no use of t.
class ProgramLandscape : public Landscape {
 public:
  ProgramLandscape(Program height, const Vector3& p_WB, const Matrix3& R_WB)
      : Landscape(p_WB, R_WB), program_(std::move(height)) {}

  double height(double x, double y) const override { return evaluate<double>(x, y); }
  IntervalJet height(const IntervalJet& x, const IntervalJet& y) const override { return evaluate<IntervalJet>(x, y); }

 private:
  template <class T>
  T evaluate(const T& x, const T& y) const {
    const std::array<T, 2> place{x, y};
    T height(0.0);
    Evaluator<T> evaluator(program_);
    evaluator(T(0.0), place.data(), &height);
    return height;
  }

  Program program_;
};

}  // namespace

std::shared_ptr<const Landscape> make_landscape(const Expression& height, const Symbols& constants, const Vector3& p_WB,
                                                const Matrix3& R_WB) {
  Symbols symbols(&constants);
  symbols.set_input("x", 1);
  symbols.set_input("y", 2);
  constexpr int kInputs = 3;
  ProgramBuilder program(kInputs);
  program.add_output(program.compile_scalar(height, symbols));
  return std::make_shared<const ProgramLandscape>(program.build(), p_WB, R_WB);
}

}  // namespace trajet
