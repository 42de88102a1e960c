#include "trajet/io/run_spool.hpp"

#include <cstdint>
#include <type_traits>

namespace trajet {

namespace {

template <class T>
concept Plain = std::is_arithmetic_v<T> || std::is_enum_v<T>;

template <Plain T>
void put(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

void put(std::string& bytes, const std::string& text) {
  put(bytes, text.size());
  bytes += text;
}

void put(std::string& bytes, const Vector3& v) {
  for (const double x : v) put(bytes, x);
}

template <Plain T>
bool get(Spool::Reader& reader, T& value) {
  return reader.read({reinterpret_cast<char*>(&value), sizeof value});
}

bool get(Spool::Reader& reader, std::string& text) {
  std::size_t size = 0;
  if (!get(reader, size)) return false;
  text.resize(size);
  return reader.read(text);
}

bool get(Spool::Reader& reader, Vector3& v) {
  return reader.read({reinterpret_cast<char*>(v.data()), sizeof(double) * 3});
}

/// Calls `each` for the members of an impact, or of an event, until it says false; whether it never did.
template <class Record, class Each>
bool all_of_impact(Record& impact, const Each& each) {
  return each(impact.time) && each(impact.elapsed) && each(impact.body) && each(impact.with) && each(impact.kind) &&
         each(impact.point) && each(impact.normal) && each(impact.position) && each(impact.velocity_before) &&
         each(impact.velocity_after) && each(impact.angular_velocity_before) && each(impact.angular_velocity_after) &&
         each(impact.impulse) && each(impact.time_error_bound);
}

template <class Record, class Each>
bool all_of_event(Record& event, const Each& each) {
  return each(event.time) && each(event.elapsed) && each(event.event) && each(event.direction) && each(event.law);
}

void put(std::string& bytes, const std::optional<TouchedFeatures>& touched) {
  put(bytes, touched.has_value());
  if (!touched) return;
  put(bytes, touched->of_body);
  put(bytes, touched->of_obstacle);
  put(bytes, touched->points.size());
  for (const Vector3& point : touched->points) put(bytes, point);
}

bool get(Spool::Reader& reader, std::optional<TouchedFeatures>& touched) {
  bool is_known = false;
  if (!get(reader, is_known)) return false;
  touched.reset();
  if (!is_known) return true;
  TouchedFeatures& features = touched.emplace();
  std::size_t count = 0;
  if (!get(reader, features.of_body) || !get(reader, features.of_obstacle) || !get(reader, count)) return false;
  features.points.resize(count);
  for (Vector3& point : features.points)
    if (!get(reader, point)) return false;
  return true;
}

void put(std::string& bytes, const std::optional<int>& number) {
  put(bytes, number.has_value());
  if (number) put(bytes, *number);
}

bool get(Spool::Reader& reader, std::optional<int>& number) {
  bool is_there = false;
  if (!get(reader, is_there)) return false;
  number.reset();
  return !is_there || get(reader, number.emplace());
}

void put(std::string& bytes, const std::optional<ImpactPartner>& partner) {
  put(bytes, partner.has_value());
  if (!partner) return;
  for (const Vector3& v : {partner->velocity_before, partner->velocity_after, partner->angular_velocity_before,
                           partner->angular_velocity_after})
    put(bytes, v);
}

bool get(Spool::Reader& reader, std::optional<ImpactPartner>& partner) {
  bool is_known = false;
  if (!get(reader, is_known)) return false;
  partner.reset();
  if (!is_known) return true;
  ImpactPartner& other = partner.emplace();
  return get(reader, other.velocity_before) && get(reader, other.velocity_after) &&
         get(reader, other.angular_velocity_before) && get(reader, other.angular_velocity_after);
}

auto putter(std::string& bytes) {
  bytes.clear();
  return [&bytes](const auto& member) {
    put(bytes, member);
    return true;
  };
}

auto getter(Spool::Reader& reader) {
  return [&reader](auto& member) { return get(reader, member); };
}

constexpr std::size_t kImpacts = 0, kEvents = 1;

class SpoolReader : public RecordedMotion::Reader {
 public:
  SpoolReader(const Spool& spool, int group) : reader_(spool, static_cast<std::size_t>(group)) {}

  const RecordedPiece* next() override {
    double t0 = 0.0, t1 = 0.0;
    int dimension = 0, degree = 0;
    if (!get(reader_, piece_.from) || !get(reader_, piece_.to) || !get(reader_, t0) || !get(reader_, t1) ||
        !get(reader_, dimension) || !get(reader_, degree))
      return nullptr;
    piece_.segment.resize(dimension, degree);
    piece_.segment.set_interval(t0, t1);
    auto& coefficients = piece_.segment.coefficients();
    const auto size = sizeof(double) * static_cast<std::size_t>(coefficients.size());
    return reader_.read({reinterpret_cast<char*>(coefficients.data()), size}) ? &piece_ : nullptr;
  }

 private:
  Spool::Reader reader_;
  RecordedPiece piece_;
};

}  // namespace

void RecordSpool::impact(const Impact& impact) {
  all_of_impact(impact, putter(bytes_));
  put(bytes_, impact.touched);
  put(bytes_, impact.partner);
  put(bytes_, impact.group);
  spool_.append(kImpacts, bytes_);
}

void RecordSpool::event(const EventRecord& event) {
  all_of_event(event, putter(bytes_));
  spool_.append(kEvents, bytes_);
}

void RecordSpool::each_impact(const std::function<void(const Impact&)>& use) const {
  Spool::Reader reader(spool_, kImpacts);
  Impact impact;
  while (all_of_impact(impact, getter(reader)) && get(reader, impact.touched) && get(reader, impact.partner) &&
         get(reader, impact.group))
    use(impact);
}

void RecordSpool::each_event(const std::function<void(const EventRecord&)>& use) const {
  Spool::Reader reader(spool_, kEvents);
  EventRecord event;
  while (all_of_event(event, getter(reader))) use(event);
}

void MotionSpool::motion(const MotionPiece& piece) {
  const Segment<>& segment = piece.segment;
  bytes_.clear();
  for (const double time : {piece.from, piece.to, segment.t0(), segment.t1()}) put(bytes_, time);
  put(bytes_, segment.dimension());
  put(bytes_, segment.degree());
  const auto& coefficients = segment.coefficients();
  bytes_.append(reinterpret_cast<const char*>(coefficients.data()),
                sizeof(double) * static_cast<std::size_t>(coefficients.size()));
  spool_.append(static_cast<std::size_t>(piece.group), bytes_);
}

std::unique_ptr<RecordedMotion::Reader> MotionSpool::read(int group) const {
  return std::make_unique<SpoolReader>(spool_, group);
}

}  // namespace trajet
