# Installs a build, then builds and runs a project that finds it with find_package(trajet).
#
#   cmake -DBUILD=... -DWORK=... -DSOURCE=... -DCXX=... -DFLAGS=... -DVERSION=... -DPYTHON=... -P install_test.cmake
cmake_minimum_required(VERSION 3.25)

function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY OUTPUT_VARIABLE output)
  set(output "${output}" PARENT_SCOPE)
endfunction()

# expect(EXPECTED COMMAND...): the command prints EXPECTED.
function(expect expected)
  run(${ARGN})
  if(NOT output STREQUAL "${expected}\n")
    message(FATAL_ERROR "expected '${expected}', got '${output}'")
  endif()
endfunction()

file(REMOVE_RECURSE ${WORK})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/installed)
run(${CMAKE_COMMAND} -S ${SOURCE}/consumer -B ${WORK}/build -G Ninja
  -DCMAKE_PREFIX_PATH=${WORK}/installed -DCMAKE_CXX_COMPILER=${CXX} -DCMAKE_CXX_FLAGS=${FLAGS} -DCMAKE_BUILD_TYPE=Release)
run(${CMAKE_COMMAND} --build ${WORK}/build)
expect("trajet ${VERSION}: agree, landed" ${WORK}/build/core)
expect("1 impact at 3 s, reported" ${WORK}/build/scene)
set(trajet ${WORK}/installed/bin/trajet)
expect("trajet ${VERSION}" ${trajet} --version)

# the Python package, if there is one
if(PYTHON)
  file(GLOB folder ${WORK}/installed/lib/python*/site-packages)
  file(WRITE ${WORK}/package.py "import trajet
print(trajet.__version__, trajet.run({'time': {'end': 1}, 'body': [{'name': 'a'}]}).status)
")
  expect("${VERSION} finished" ${CMAKE_COMMAND} -E env PYTHONPATH=${folder} ${PYTHON} -B ${WORK}/package.py)
endif()

# the documents, examples, manual and completions come along
set(documents ${WORK}/installed/share/doc/trajet)
run(${trajet} check ${documents}/examples/free_kick.toml)
foreach(file IN ITEMS ${documents}/README.md ${documents}/docs/cookbook.md ${documents}/docs/gallery/free_kick.png
    ${WORK}/installed/share/man/man1/trajet.1)
  if(NOT EXISTS ${file})
    message(FATAL_ERROR "${file} is not installed")
  endif()
endforeach()
foreach(pair IN ITEMS bash:bash-completion/completions/trajet zsh:zsh/site-functions/_trajet
    fish:fish/vendor_completions.d/trajet.fish)
  string(REGEX MATCH "^[a-z]+" shell ${pair})
  string(REGEX REPLACE "^[a-z]+:" "${WORK}/installed/share/" file ${pair})
  run(${trajet} completion ${shell})
  file(READ ${file} installed)
  if(NOT installed STREQUAL output)
    message(FATAL_ERROR "${file} is not what trajet completion ${shell} prints")
  endif()
endforeach()
