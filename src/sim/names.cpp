#include "trajet/sim/names.hpp"

namespace trajet {

std::string_view name(RunStatus status) {
  switch (status) {
    case RunStatus::finished:
      return "finished";
    case RunStatus::stopped:
      return "stopped";
    case RunStatus::failed:
      return "failed";
    case RunStatus::interrupted:
      return "interrupted";
  }
  return "";
}

std::string_view name(ImpactKind kind) {
  switch (kind) {
    case ImpactKind::hit:
      return "hit";
    case ImpactKind::graze:
      return "graze";
    case ImpactKind::rest:
      return "rest";
    case ImpactKind::slide:
      return "slide";
    case ImpactKind::roll:
      return "roll";
    case ImpactKind::leave:
      return "leave";
    case ImpactKind::stick:
      return "stick";
  }
  return "";
}

std::string_view name(Feature feature) {
  switch (feature) {
    case Feature::vertex:
      return "vertex";
    case Feature::edge:
      return "edge";
    case Feature::face:
      return "face";
    case Feature::surface:
      break;
  }
  return "surface";
}

}  // namespace trajet
