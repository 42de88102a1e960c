# The page of `trajet view`: made of viewer/ by npm and Vite, embedded in the program as page_template.cpp.
#
# trajet_page_template(OUTPUT): the path of that source. Where TRAJET_VIEWER is off, or npm is missing or cannot get its
# packages, the source says so instead, and so does `trajet view`.

function(trajet_install_node_packages result)
  set(folder ${PROJECT_SOURCE_DIR}/viewer)
  find_program(TRAJET_NPM npm)
  if(NOT TRAJET_NPM)
    set(${result} "npm was not found (Debian: nodejs and npm)" PARENT_SCOPE)
    return()
  endif()
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${folder}/package-lock.json)
  file(SHA256 ${folder}/package-lock.json wanted)
  set(stamp ${folder}/node_modules/.installed)
  if(EXISTS ${stamp})
    file(READ ${stamp} present)
  endif()
  if(NOT "${present}" STREQUAL wanted)
    message(STATUS "Installing the page's packages with npm")
    execute_process(COMMAND ${TRAJET_NPM} ci --no-audit --no-fund --loglevel=error WORKING_DIRECTORY ${folder}
      RESULT_VARIABLE code OUTPUT_VARIABLE output ERROR_VARIABLE output)
    if(NOT code EQUAL 0)
      message(STATUS "${output}")
      set(${result} "npm could not install its packages" PARENT_SCOPE)
      return()
    endif()
    file(WRITE ${stamp} ${wanted})
  endif()
  set(${result} "" PARENT_SCOPE)
endfunction()

function(trajet_page_template output)
  set(source ${CMAKE_CURRENT_BINARY_DIR}/page_template.cpp)
  set(embed ${CMAKE_COMMAND} -DOUTPUT=${source})
  set(script ${PROJECT_SOURCE_DIR}/cmake/EmbedPage.cmake)
  set(missing "TRAJET_VIEWER is off")
  if(TRAJET_VIEWER)
    trajet_install_node_packages(missing)
    if(missing)
      message(WARNING "The page of `trajet view` is left out: ${missing}. Run scripts/setup, or configure with -DTRAJET_VIEWER=OFF.")
    endif()
  endif()
  if(missing)
    add_custom_command(OUTPUT ${source} COMMAND ${embed} "-DMISSING=${missing}" -P ${script} DEPENDS ${script} VERBATIM)
  else()
    set(page ${CMAKE_CURRENT_BINARY_DIR}/viewer/index.html)
    set(folder ${PROJECT_SOURCE_DIR}/viewer)
    file(GLOB_RECURSE inputs CONFIGURE_DEPENDS ${folder}/src/*)
    add_custom_command(OUTPUT ${page}
      COMMAND ${TRAJET_NPM} run --silent build -- --logLevel warn --outDir ${CMAKE_CURRENT_BINARY_DIR}/viewer
      WORKING_DIRECTORY ${folder}
      DEPENDS ${inputs} ${folder}/index.html ${folder}/vite.config.ts ${folder}/package-lock.json
      COMMENT "Building the page with Vite"
      VERBATIM)
    add_custom_command(OUTPUT ${source} COMMAND ${embed} -DPAGE=${page} -P ${script} DEPENDS ${page} ${script} VERBATIM)
  endif()
  set(${output} ${source} PARENT_SCOPE)
  set(TRAJET_PAGE_MISSING "${missing}" PARENT_SCOPE)
endfunction()
