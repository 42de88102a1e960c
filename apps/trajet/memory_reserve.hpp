#pragma once

namespace trajet {

/// Sets some memory aside, if that has not been done. Where there is no other any more it is given back, so that the
/// program can still write what it has computed and say why it ends; `is_out_of_memory` then is true until memory could
/// be set aside anew.
void set_memory_aside();
bool is_out_of_memory();

}  // namespace trajet
