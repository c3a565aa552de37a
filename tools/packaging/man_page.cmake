# cmake -DPROGRAM=... -DVERSION=... -DHELP2MAN=... -DPAGE=... -P man_page.cmake
#
# The man page PAGE of PROGRAM, from what it says to --help. The first line of that is
# "name: what it is."

execute_process(COMMAND "${PROGRAM}" --help OUTPUT_VARIABLE help COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCH "^[^:]*: ([^\n]*)\\.\n" first_line "${help}")
if(NOT first_line)
  message(FATAL_ERROR "${PROGRAM} --help does not begin with 'name: what it is.'")
endif()
execute_process(
  COMMAND "${HELP2MAN}" --no-info "--name=${CMAKE_MATCH_1}" "--version-string=${VERSION}"
          "--output=${PAGE}" "${PROGRAM}" COMMAND_ERROR_IS_FATAL ANY)
