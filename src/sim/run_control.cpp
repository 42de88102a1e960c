#include "run_control.hpp"

#include <cmath>

#include "run_loop.hpp"

namespace trajet {

const World& RunControl::world() const { return loop_.world_; }
Course& RunControl::course(int index) const { return loop_.course(index); }
Encounters& RunControl::encounters() const { return loop_.encounters_; }
Meetings& RunControl::meetings() const { return loop_.meetings_; }
Recorder& RunControl::recorder() const { return loop_.recorder_; }
LastingContacts& RunControl::lasting_contacts() const { return loop_.lasting_contacts_; }
GroupHandler& RunControl::groups() const { return loop_.groups_; }

void RunControl::go_on(int course, const Instant& instant) const { loop_.go_on(course, instant); }
void RunControl::advance(int course) const { loop_.advance(course); }
void RunControl::enqueue(int course) const { loop_.enqueue(course); }

void RunControl::pass_on(int index) const {
  const Course& moving = course(index);
  for (const int body : moving.group().bodies) encounters().search(body, moving, moving.next().time);
  enqueue(index);
}

bool RunControl::has_event_at(int index, double t) const {
  const Crossing& crossing = course(index).next();
  return crossing.kind == Crossing::Kind::event && std::abs(crossing.time - t) <= crossing.error_bound;
}
void RunControl::handle_event(int course, double time) const { loop_.events_.handle(course, time); }

void RunControl::stop() const { loop_.stop(); }
void RunControl::stop_after(double time, double error_bound) const {
  if (!loop_.stop_) loop_.stop_ = {time, error_bound};
}
void RunControl::fail(double time, const std::string& reason) const { loop_.fail(time, reason); }

void RunControl::fail_unresolved(double time, const std::string& body, const std::string& with,
                                 const std::string& why) const {
  recorder().unresolved(time, body, with, why.empty() ? "the contact can neither be shown nor excluded" : why);
  fail(time, "contact of '" + body + "' with '" + with + "' is unresolved" + (why.empty() ? "" : ": " + why));
}

}  // namespace trajet
