#include "last_contact.hpp"

#include <algorithm>

namespace trajet {

std::optional<ContactMemory> memory_of_last_contact(const ContactResult& contact, const ContactMemory& known,
                                                    double height) {
  ContactMemory memory = contact.memory;
  memory.side = contact.side_before;
  memory.contact_time = contact.time;
  // how far Segments go astray is found by trying
  constexpr double kLeast = 0x1p-40;  // of the height
  constexpr double kMore = 16.0;
  memory.tolerance = std::max(memory.tolerance, kLeast * height);
  if (known.contact_time == contact.time) memory.tolerance = std::max(memory.tolerance, kMore * known.tolerance);
  if (memory.tolerance > 0.5 * height) return std::nullopt;
  return memory;
}

}  // namespace trajet
