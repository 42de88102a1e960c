#include "group_bounce.hpp"

#include <algorithm>

#include "body_state.hpp"
#include "impact_sides.hpp"
#include "jump_derivative.hpp"
#include "trajet/portable.hpp"

namespace trajet {

GroupBounce::GroupBounce(const World& world, const std::vector<GroupedContact>& contacts,
                         std::map<int, Instant>& instants, std::vector<std::optional<FrameMotion>> surfaces)
    : world_(world), contacts_(contacts), instants_(instants), surfaces_(std::move(surfaces)) {
  int size = 0;
  for (const auto& [course, instant] : instants_) {
    offsets_[course] = size;
    size += static_cast<int>(instant.q.size());
  }
  before_.resize(size);
  rate_.resize(size);
  for (const auto& [course, instant] : instants_) {
    before_.segment(offsets_[course], instant.q.size()) = instant.before();
    rate_.segment(offsets_[course], instant.q.size()) = instant.rate();
  }
  for (const GroupedContact& contact : contacts_)
    for (const int each : {contact.first, contact.second})
      if (each >= 0) places_.try_emplace(each, static_cast<int>(places_.size()));
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    const std::size_t first = touches_.size();
    if (contacts_[i].points.empty()) touches_.push_back(round_touch(contacts_[i], surfaces_[i]));
    for (const Vector3& place : contacts_[i].points) touches_.push_back(solid_touch(contacts_[i], place));
    for (std::size_t k = first; k < touches_.size(); ++k) touches_[k].contact = i;
  }
  const Setting setting = this->setting(before_);
  for (const GroupContact& contact : setting.contacts) normals_.push_back(contact.normal);
  response_ = resolve_group(setting.bodies, setting.contacts, world_.simultaneous);
}

BodySlice GroupBounce::slice(int index) const {
  BodySlice slice = body(index).slice();
  slice.first += offsets_.at(body(index).group);
  return slice;
}

GroupBounce::Touch GroupBounce::round_touch(const GroupedContact& contact,
                                            const std::optional<FrameMotion>& surface) const {
  const Vector3 position = slice(contact.first).position(before_);
  Touch touch{.place = contact.contact.point, .is_round = true, .normal = contact.contact.normal, .point = position};
  if (contact.second < 0 && !contact.is_lasting)
    touch.turning = normal_derivative(world_, {.id = {contact.first, contact.obstacle}, .contact = contact.contact},
                                      surface, position);
  return touch;
}

GroupBounce::Touch GroupBounce::solid_touch(const GroupedContact& contact, const Vector3& place) const {
  Touch touch{.place = place};
  // a face has the normal, and what lies on it the point
  const TouchedFeatures& touched = *contact.contact.touched;
  const bool turns_with_first = touched.of_body == Feature::face && touched.of_obstacle != Feature::face;
  if (turns_with_first) touch.normal_owner = contact.first;
  if (!turns_with_first && touched.of_obstacle == Feature::face) touch.normal_owner = contact.second;
  touch.point_owner = turns_with_first ? contact.second : contact.first;
  const auto to_frame = [&](int owner, const Vector3& vector) {
    return owner < 0 ? vector : Vector3(rotation_of(body(owner), slice(owner), before_).transpose() * vector);
  };
  touch.normal = to_frame(touch.normal_owner, contact.contact.normal);
  touch.point = touch.point_owner < 0
                    ? place
                    : to_frame(touch.point_owner, place - Vector3(slice(touch.point_owner).position(before_)));
  return touch;
}

bool GroupBounce::is_of_first_alone() const {
  return contacts_.front().points.size() < 2 && ranges::all_of(response_.rounds, [](const GroupRound& round) {
           return round.pushing.empty() || round.pushing == std::vector<int>{0};
         });
}

Vector3 GroupBounce::impulse(std::size_t contact) const {
  Vector3 sum = Vector3::Zero();
  for (std::size_t i = 0; i < touches_.size(); ++i)
    if (touches_[i].contact == contact) sum += impulse_at(i);
  return sum;
}

double GroupBounce::approach(std::size_t contact) const {
  double most = 0.0;
  for (std::size_t i = 0; i < touches_.size(); ++i)
    if (touches_[i].contact == contact) most = std::max(most, response_.approaches[i]);
  return most;
}

Vector3 GroupBounce::point(std::size_t contact) const {
  Vector3 sum = Vector3::Zero();
  double total = 0.0;
  for (std::size_t i = 0; i < touches_.size(); ++i) {
    if (touches_[i].contact != contact) continue;
    sum += response_.impulses[i] * touches_[i].place;
    total += response_.impulses[i];
  }
  return total > 0.0 ? Vector3(sum / total) : contacts_[contact].contact.point;
}

GroupBounce::Setting GroupBounce::setting(const Eigen::VectorXd& q) const {
  Setting setting;
  setting.bodies.resize(places_.size());
  for (const auto& [index, place] : places_) {
    const BodySlice slice = this->slice(index);
    const Instant& instant = instants_.at(body(index).group);
    // the velocity of the centre is dr/dt, which a position_rate may set apart from v
    const Vector3 drift = Vector3(slice.position(rate_)) - Vector3(slice.velocity(before_));
    const double mass = mass_in_meetings(world_, index, instant);
    const ImpactSide side =
        impact_side(body(index), slice, q, Vector3(slice.velocity(q)) + drift, mass, Vector3(slice.position(q)));
    setting.bodies[static_cast<std::size_t>(place)] = {side.velocity, side.angular_velocity, side.inverse_mass,
                                                       side.inverse_inertia};
  }
  const auto to_world = [&](int owner, const Vector3& vector) {
    return owner < 0 ? vector : Vector3(rotation_of(body(owner), slice(owner), q) * vector);
  };
  for (const Touch& touch : touches_) {
    const GroupedContact& contact = contacts_[touch.contact];
    GroupContact& grouped = setting.contacts.emplace_back();
    grouped.first = places_.at(contact.first);
    grouped.restitution = contact.surface.restitution;
    grouped.friction = friction_of(contact.surface).coefficient;
    const Vector3 first = slice(contact.first).position(q);
    Vector3 point;
    if (touch.is_round) {
      const double radius = bounding_radius(body(contact.first).solid);
      grouped.normal = contact.second < 0 ? Vector3(touch.normal + touch.turning * (first - touch.point)).normalized()
                                          : (first - Vector3(slice(contact.second).position(q))).normalized();
      grouped.arm_first = -radius * grouped.normal;
      point = first + grouped.arm_first;
      if (contact.second >= 0) grouped.arm_second = bounding_radius(body(contact.second).solid) * grouped.normal;
    } else {
      grouped.normal = to_world(touch.normal_owner, touch.normal);
      point = to_world(touch.point_owner, touch.point);
      if (touch.point_owner >= 0) point += Vector3(slice(touch.point_owner).position(q));
      grouped.arm_first = point - first;
      if (contact.second >= 0) grouped.arm_second = point - Vector3(slice(contact.second).position(q));
    }
    if (contact.second >= 0) {
      grouped.second = places_.at(contact.second);
      continue;
    }
    grouped.second = static_cast<int>(setting.bodies.size());
    GroupBody& surface = setting.bodies.emplace_back();
    if (const auto& moving = surfaces_[touch.contact])
      surface.velocity = moving->velocity_at(touch.is_round ? first : point);
  }
  return setting;
}

void GroupBounce::put_after(const Setting& before, const std::vector<GroupBody>& after, Eigen::VectorXd& q) const {
  for (const auto& [index, place] : places_) {
    const GroupBody &from = before.bodies[static_cast<std::size_t>(place)],
                    &to = after[static_cast<std::size_t>(place)];
    const BodySlice slice = this->slice(index);
    const Vector3 drift = Vector3(slice.position(rate_)) - Vector3(slice.velocity(before_));
    if (from.velocity != to.velocity) q.segment<3>(slice.velocity_index()) = to.velocity - drift;
    if (!body(index).rotation || from.angular_velocity == to.angular_velocity) continue;
    ImpactSide side_before, side_after;
    side_before.angular_velocity = from.angular_velocity;
    side_after.angular_velocity = to.angular_velocity;
    put(body(index), slice, side_before, side_after, q);
  }
}

Eigen::MatrixXd GroupBounce::derivative_at_fixed_time() const {
  Eigen::MatrixXd derivative = Eigen::MatrixXd::Identity(before_.size(), before_.size());
  for (const auto& [index, place] : places_) {
    const BodySlice slice = this->slice(index);
    for (int i = slice.first; i < slice.first + slice.size(); ++i) {
      const double part = small_part(before_[i]);
      Eigen::VectorXd change = Eigen::VectorXd::Zero(before_.size());
      for (const double sign : {1.0, -1.0}) {
        Eigen::VectorXd moved = before_;
        moved[i] += sign * part;
        const Setting setting = this->setting(moved);
        if (const auto after = repeat_rounds(setting.bodies, setting.contacts, response_.rounds))
          put_after(setting, *after, moved);
        change += sign / (2.0 * part) * moved;
      }
      derivative.col(i) = change;
    }
  }
  return derivative;
}

Eigen::RowVectorXd GroupBounce::time_gradient(std::size_t i) const {
  const GroupedContact& contact = contacts_[touches_[i].contact];
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(before_.size());
  // dt = -dg / g'
  if (!(response_.approaches[i] > 0.0)) return gradient;
  const auto add = [&](int index, const Vector3& direction) {
    const BodySlice slice = this->slice(index);
    if (touches_[i].is_round)
      gradient.segment<3>(slice.position_index()) += direction;
    else
      add_gradient(body(index), slice, before_, touches_[i].place, direction, gradient);
  };
  add(contact.first, normals_[i]);
  if (contact.second >= 0) add(contact.second, -normals_[i]);
  return gradient / response_.approaches[i];
}

void GroupBounce::apply(const std::map<int, Eigen::MatrixXd>& errors) {
  const Setting setting = this->setting(before_);
  Eigen::VectorXd after = before_;
  put_after(setting, response_.after, after);
  Eigen::MatrixXd derivative = derivative_at_fixed_time();
  for (auto& [course, instant] : instants_) instant.q = after.segment(offsets_[course], instant.q.size());

  Eigen::VectorXd rate_after(before_.size());
  for (const auto& [course, instant] : instants_)
    rate_after.segment(offsets_[course], instant.q.size()) = instant.rate();
  // D f- - f+ times dt/dq, of each body by its contacts
  const Eigen::VectorXd jump = derivative * rate_ - rate_after;
  for (const auto& [index, place] : places_) {
    const BodySlice slice = this->slice(index);
    double total = 0.0;
    Eigen::RowVectorXd mean = Eigen::RowVectorXd::Zero(before_.size());
    Eigen::MatrixXd shift = Eigen::MatrixXd::Zero(3, before_.size());
    for (std::size_t i = 0; i < touches_.size(); ++i) {
      const GroupedContact& contact = contacts_[touches_[i].contact];
      const bool is_first = contact.first == index;
      if ((!is_first && contact.second != index) || !(response_.impulses[i] > 0.0)) continue;
      const Eigen::RowVectorXd time = time_gradient(i);
      const double impulse = response_.impulses[i];
      mean += impulse * time;
      total += impulse;
      const double inverse_mass = setting.bodies[static_cast<std::size_t>(place)].inverse_mass;
      shift -= (is_first ? inverse_mass : -inverse_mass) * impulse_at(i) * time;
    }
    if (!(total > 0.0)) continue;
    mean /= total;
    derivative.middleRows<3>(slice.position_index()) += shift;
    const int rest = slice.size() - 3;
    derivative.middleRows(slice.velocity_index(), rest) += jump.segment(slice.velocity_index(), rest) * mean;
  }
  for (auto& [course, instant] : instants_) {
    const Eigen::Index n = instant.q.size();
    instant.derivative = derivative.block(offsets_[course], offsets_[course], n, n);
    Eigen::MatrixXd further(n, 0);
    for (const auto& [other, columns] : errors) {
      if (other == course) continue;
      const Eigen::Index known = further.cols();
      further.conservativeResize(Eigen::NoChange, known + columns.cols());
      further.rightCols(columns.cols()) =
          derivative.block(offsets_[course], offsets_[other], n, columns.rows()) * columns;
    }
    instant.further_errors = std::move(further);
  }
}

}  // namespace trajet
