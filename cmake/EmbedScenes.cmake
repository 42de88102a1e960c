# Writes the C++ source that holds scene files as text, for apps/trajet/example_scenes.hpp.
#
#   cmake -DOUTPUT=FILE -P EmbedScenes.cmake -- SCENE.toml...
#
# A scene's name is its file name without the extension.

cmake_minimum_required(VERSION 3.25)

set(delimiter "toml")
set(entries "")
set(names "")
set(in_scenes FALSE)
math(EXPR last "${CMAKE_ARGC} - 1")
foreach(i RANGE ${last})
  set(scene "${CMAKE_ARGV${i}}")
  if(in_scenes)
    cmake_path(GET scene STEM LAST_ONLY name)
    if(name IN_LIST names)
      message(FATAL_ERROR "two example scenes are called ${name}")
    endif()
    list(APPEND names ${name})
    file(READ "${scene}" text)
    string(FIND "${text}" ")${delimiter}\"" found)
    if(NOT found EQUAL -1)
      message(FATAL_ERROR "${scene} holds the delimiter of the raw string literal")
    endif()
    string(APPEND entries "    {\"${name}\", R\"${delimiter}(${text})${delimiter}\"},\n")
  elseif(scene STREQUAL "--")
    set(in_scenes TRUE)
  endif()
endforeach()

file(WRITE "${OUTPUT}"
"#include \"example_scenes.hpp\"

#include <vector>

namespace trajet {

std::span<const ExampleScene> example_scenes() {
  static const std::vector<ExampleScene> scenes = {
${entries}  };
  return scenes;
}

}  // namespace trajet
")
