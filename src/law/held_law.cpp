#include "trajet/law/held_law.hpp"

#include <array>
#include <vector>

#include "graph.hpp"

namespace trajet {

std::optional<HeldLaw> hold_on_border(const Program& law, const Program& w, const Eigen::VectorXd& direction) {
  detail::Graph graph(law.input_count);
  std::vector<int> rates = graph.insert(law);
  const int border = graph.insert(w).front();
  std::vector<int> motion{graph.constant(1.0)}, along{graph.constant(0.0)};
  motion.insert(motion.end(), rates.begin(), rates.end());
  for (const double component : direction) along.push_back(graph.constant(component));

  const std::optional<int> direct = graph.derivative(border, along);
  if (!direct || !graph.is_constant(*direct, 0.0)) return std::nullopt;
  const std::optional<int> first = graph.derivative(border, motion);
  if (!first) return std::nullopt;
  const std::optional<int> second = graph.derivative(*first, motion);
  const std::optional<int> effect = graph.derivative(*first, along);
  if (!second || !effect || graph.is_constant(*effect, 0.0)) return std::nullopt;

  const int push = graph.negate(graph.divide(*second, *effect));
  for (std::size_t i = 0; i < rates.size(); ++i)
    if (const double part = direction[static_cast<Eigen::Index>(i)]; part != 0.0)
      rates[i] = graph.add(rates[i], graph.multiply(push, graph.constant(part)));
  return HeldLaw{graph.build(rates), graph.build(std::array{*second}),
                 graph.build(std::array{border, *first, *effect})};
}

}  // namespace trajet
