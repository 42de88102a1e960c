#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "driven_obstacle.hpp"
#include "trajet/collide/detect/contact.hpp"
#include "trajet/geom/box_tree.hpp"
#include "trajet/geom/convex_pieces.hpp"
#include "trajet/rigid/frame_path.hpp"
#include "trajet/scene/world.hpp"

namespace trajet {

/// Finds the first contacts of bodies with obstacles and with each other where they are no points or balls: piece by
/// piece of what is not convex.
class SolidSearch {
 public:
  /// The world must live as long as this.
  explicit SolidSearch(const World& world);

  /// The first contact between two times on the body's Segment, or, of a body that the memory has inside, the first
  /// time at which it is out again; `driven`: the obstacle, where it moves.
  ContactResult first_contact(int body, int obstacle, const Segment<>& motion, DrivenObstacle* driven, double from,
                              double to, const ContactMemory& memory);

  /// The first contact of two bodies between two times on their Segments.
  ContactResult first_contact_of_bodies(int first, const Segment<>& motion, int second, const Segment<>& other,
                                        double from, double to, const ContactMemory& memory);

 private:
  /// A thing in convex pieces.
  struct Pieces {
    ConvexPieces cores;
    std::optional<BoxTree> tree{};  ///< of many
  };
  /// A pair of things on a stretch of time on which each has one path.
  struct Stretch {
    const Pieces& body;
    const Pieces& obstacle;
    const FramePath& body_path;
    const FramePath& obstacle_path;
    double reach;  // m, of the body
  };

  const Pieces& pieces_of_body(int body);
  const Pieces& pieces_of_obstacle(int obstacle);
  static ContactResult search(const Stretch& stretch, double from, double to, const ContactMemory& memory);
  static ContactResult search_pieces(const Stretch& stretch, std::span<const int> near, double from, double to,
                                     const ContactMemory& memory);
  /// Of what overlaps: when it is apart again.
  static ContactResult search_parting(const Stretch& stretch, double from, double to, const ContactMemory& memory);
  /// The pieces of the obstacle that the body may come near to.
  static std::vector<int> near(const Stretch& stretch, double from, double to);

  const World& world_;
  std::vector<std::unique_ptr<Pieces>> bodies_;     // made when first needed
  std::vector<std::unique_ptr<Pieces>> obstacles_;  // likewise
};

}  // namespace trajet
