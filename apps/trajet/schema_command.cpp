#include "commands.hpp"
#include "trajet/io/output_file.hpp"
#include "trajet/io/scene_schema.hpp"

namespace trajet {

int schema_command() {
  OutputFile out("-");
  out.write(scene_schema_json());
  out.finish();
  return kDone;
}

}  // namespace trajet
