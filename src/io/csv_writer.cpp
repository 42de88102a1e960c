#include "trajet/io/csv_writer.hpp"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <cmath>
#include <iterator>

namespace trajet {

namespace {

constexpr std::string_view kHeader = "t,body,x,y,z,vx,vy,vz,ax,ay,az,qw,qx,qy,qz,wx,wy,wz";
constexpr std::string_view kNoBody = ",,,,,,,,,,,,,,,,,";

std::string_view name_of(SamplePhase phase) {
  return phase == SamplePhase::before ? "before" : phase == SamplePhase::after ? "after" : "";
}

void append(std::string& text, double value) {
  if (std::isnan(value))
    text += "nan";  // never "-nan": the sign of what is no number says nothing
  else
    fmt::format_to(std::back_inserter(text), FMT_COMPILE("{}"), value);
}

void append(std::string& text, const Vector3& v) {
  for (const double value : v) {
    text += ',';
    append(text, value);
  }
}

}  // namespace

void CsvWriter::sample(const Sample& sample) {
  rows_.clear();
  if (!has_header_) {
    rows_ += kHeader;
    for (const NamedValue& state : sample.states) rows_ += "," + state.name;
    rows_ += ",phase\n";
    has_header_ = true;
  }
  const std::string_view phase = name_of(sample.phase);
  const auto append_states = [&] {
    for (const NamedValue& state : sample.states) {
      rows_ += ',';
      append(rows_, state.value);
    }
    rows_ += ',';
    rows_ += phase;
    rows_ += '\n';
  };
  for (const BodyState& body : sample.bodies) {
    append(rows_, sample.time);
    rows_ += ',';
    rows_ += body.body;
    append(rows_, body.position);
    append(rows_, body.velocity);
    append(rows_, body.acceleration);
    const Quaternion& q_WB = body.orientation;
    rows_ += ',';
    append(rows_, q_WB.w());
    append(rows_, Vector3(q_WB.vec()));
    append(rows_, body.angular_velocity);
    append_states();
  }
  if (sample.bodies.empty()) {
    append(rows_, sample.time);
    rows_ += kNoBody;
    append_states();
  }
  file_.write(rows_);
}

}  // namespace trajet
