# Compiler options of everything built here, and trajet_add_library.

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
if(PROJECT_IS_TOP_LEVEL AND NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release)
endif()

set(gcc_12 $<AND:$<CXX_COMPILER_ID:GNU>,$<VERSION_LESS:$<CXX_COMPILER_VERSION>,13>>)

# Tuned for this machine. Passed on to users of the library: Eigen aligns and allocates by the widest vector of the
# instruction set, on which both must agree.
set(native_options "")
if(TRAJET_NATIVE)
  list(APPEND native_options -march=native)
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64)$")
    # GCC before 12.3 copies constants {c, c, 0, 0, ...} as {c, c, c, c, ...} with AVX-512 (its bug 108599): the series
    # of 1 + t lost its zeros. It takes that path only where it moves integers to vector registers directly.
    list(APPEND native_options $<${gcc_12}:-mtune-ctrl=^inter_unit_moves_to_vec>)
  endif()
endif()

# What all our targets compile with; not passed on.
add_library(trajet_options INTERFACE)
target_compile_options(trajet_options INTERFACE
  -Wall -Wextra -Wconversion -Wshadow
  $<$<BOOL:${TRAJET_WERROR}>:-Werror>
  # GCC 12 warns falsely about `"text" + std::string` (its bug 105651).
  $<${gcc_12}:-Wno-restrict>
  # GCC 12 warns falsely about the undefined vectors in its own AVX-512 headers (its bug 105593); without them, as in
  # the presets debug and asan, the warnings stay.
  $<$<AND:${gcc_12},$<BOOL:${TRAJET_NATIVE}>>:-Wno-uninitialized;-Wno-maybe-uninitialized>
  # GCC turns a square root into one instruction, and vectorises it, only where it need not set errno.
  -fno-math-errno)
if(TRAJET_SANITIZE)
  set(sanitize -fsanitize=${TRAJET_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_compile_options(trajet_options INTERFACE ${sanitize})
  target_link_options(trajet_options INTERFACE ${sanitize})
endif()
if(TRAJET_FUZZ)
  target_compile_options(trajet_options INTERFACE -fsanitize=fuzzer-no-link)
endif()

# trajet_add_library(NAME EXPORT_AS SHORT SOURCES FILE...): a static library that installs as trajet::SHORT.
function(trajet_add_library name)
  cmake_parse_arguments(arg "" "EXPORT_AS" "SOURCES" ${ARGN})
  add_library(${name} STATIC ${arg_SOURCES})
  add_library(trajet::${arg_EXPORT_AS} ALIAS ${name})
  set_target_properties(${name} PROPERTIES EXPORT_NAME ${arg_EXPORT_AS} POSITION_INDEPENDENT_CODE ON)
  target_compile_features(${name} PUBLIC cxx_std_20)
  target_compile_options(${name} PUBLIC ${native_options})
  target_include_directories(${name} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>
    $<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/include>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_link_libraries(${name} PRIVATE $<BUILD_INTERFACE:trajet_options>)
endfunction()
