# What the program tells of itself, written when it is installed: its manual page and the completions of shells.
#
#   cmake -DPROGRAM=trajet -DPYTHON=python3 -DSOURCE=... -DVERSION=... -DOUTPUT=FOLDER -P InstalledPages.cmake
#
# Writes OUTPUT/trajet.1 where there is Python, and OUTPUT/completion/, a file for each shell.
cmake_minimum_required(VERSION 3.25)

file(REMOVE_RECURSE ${OUTPUT})
file(MAKE_DIRECTORY ${OUTPUT}/completion)
if(PYTHON)
  execute_process(
    COMMAND ${PYTHON} -B ${SOURCE}/scripts/man_page ${PROGRAM} ${VERSION} ${SOURCE}/docs/formats/report.md ${OUTPUT}/trajet.1
    COMMAND_ERROR_IS_FATAL ANY)
endif()
foreach(pair IN ITEMS bash:trajet zsh:_trajet fish:trajet.fish)
  string(REPLACE ":" ";" pair ${pair})
  list(GET pair 0 shell)
  list(GET pair 1 name)
  execute_process(COMMAND ${PROGRAM} completion ${shell} OUTPUT_FILE ${OUTPUT}/completion/${name} COMMAND_ERROR_IS_FATAL ANY)
endforeach()
