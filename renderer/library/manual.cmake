# SPDX-License-Identifier: MIT
# cmake -DTOOLS=PROGRAM -DFOLDER=FOLDER -P manual.cmake: writes the man page of minkray, and those of
# the verbs that it names, into the folder.
file(REMOVE_RECURSE ${FOLDER})
file(MAKE_DIRECTORY ${FOLDER})
execute_process(COMMAND ${TOOLS} man OUTPUT_FILE ${FOLDER}/minkray.1 COMMAND_ERROR_IS_FATAL ANY)
file(READ ${FOLDER}/minkray.1 page)
string(REPLACE "\\-" "-" page "${page}")
string(REGEX MATCHALL "minkray-[a-z0-9-]+ \\(1\\)" pages "${page}")
foreach(name IN LISTS pages)
  string(REGEX REPLACE "^minkray-(.*) \\(1\\)$" "\\1" verb "${name}")
  execute_process(COMMAND ${TOOLS} man ${verb} OUTPUT_FILE ${FOLDER}/minkray-${verb}.1 COMMAND_ERROR_IS_FATAL ANY)
endforeach()
file(GLOB texts ${FOLDER}/*.1)
execute_process(COMMAND gzip -n9 ${texts} COMMAND_ERROR_IS_FATAL ANY)
