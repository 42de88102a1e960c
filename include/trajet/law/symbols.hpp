#pragma once

#include <array>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "trajet/law/lookup_table.hpp"
#include "trajet/math/extended_constant.hpp"
#include "trajet/math/vector.hpp"

namespace trajet {

/// What the names of a formula mean where it is used. An inner scope sees the names of the outer one and may hide them.
class Symbols {
 public:
  /// Nodes of the ProgramBuilder that compiles the formula; its inputs are the first ones.
  struct Scalar {
    int node;
  };
  struct Vector {
    std::array<int, 3> nodes;
  };
  /// A name that has a meaning elsewhere: using it is an error that gives the reason.
  struct Forbidden {
    std::string reason;
  };
  using ConstantVector = std::array<ExtendedConstant, 3>;
  using Meaning = std::variant<ExtendedConstant, ConstantVector, Scalar, Vector, Forbidden>;

  /// `outer`, if any, must live as long as this scope is used.
  explicit Symbols(const Symbols* outer = nullptr) : outer_(outer) {}

  /// Defines a name, anew if it is known.
  void set(const std::string& name, Meaning meaning) { meanings_.insert_or_assign(name, std::move(meaning)); }
  void set_constant(const std::string& name, const ExtendedConstant& value) { set(name, value); }
  void set_constant(const std::string& name, const ConstantVector& value) { set(name, value); }
  void set_constant(const std::string& name, const Vector3& value) {
    set(name, ConstantVector{value.x(), value.y(), value.z()});
  }
  /// The name stands for an input of the program: 0 is t.
  void set_input(const std::string& name, int input) { set(name, Scalar{input}); }
  void set_inputs(const std::string& name, const std::array<int, 3>& inputs) { set(name, Vector{inputs}); }
  /// The name stands for what the ProgramBuilder has computed already.
  void set_node(const std::string& name, int node) { set(name, Scalar{node}); }
  void set_nodes(const std::string& name, const std::array<int, 3>& nodes) { set(name, Vector{nodes}); }
  /// `reason` is a whole message: "t is not allowed in a parameter".
  void forbid(const std::string& name, const std::string& reason) { set(name, Forbidden{reason}); }

  /// What `table("NAME", x)` looks up.
  void set_table(const std::string& name, std::shared_ptr<const LookupTable> table) {
    tables_.insert_or_assign(name, std::move(table));
  }

  /// The table of that name here, or nullptr.
  std::shared_ptr<const LookupTable> find_table(std::string_view name) const {
    const auto found = tables_.find(name);
    if (found != tables_.end()) return found->second;
    return outer_ == nullptr ? nullptr : outer_->find_table(name);
  }

  /// The meaning of a name here, or nullptr.
  const Meaning* find(std::string_view name) const {
    const auto found = meanings_.find(name);
    if (found != meanings_.end()) return &found->second;
    return outer_ == nullptr ? nullptr : outer_->find(name);
  }

  /// All names that may be used here, inner scope first.
  std::vector<std::string_view> names() const {
    std::vector<std::string_view> result;
    for (const Symbols* scope = this; scope != nullptr; scope = scope->outer_) {
      for (const auto& [name, meaning] : scope->meanings_) {
        if (!std::holds_alternative<Forbidden>(meaning)) result.push_back(name);
      }
    }
    return result;
  }

 private:
  const Symbols* outer_;
  std::map<std::string, Meaning, std::less<>> meanings_;
  std::map<std::string, std::shared_ptr<const LookupTable>, std::less<>> tables_;
};

}  // namespace trajet
