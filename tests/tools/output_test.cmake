# Runs COMMAND (a ;-list) in FOLDER and compares exit code, standard output with the file EXPECTED (or
# with nothing), and standard error with the regular expression ERROR (or nothing).
execute_process(
  COMMAND ${COMMAND}
  WORKING_DIRECTORY ${FOLDER}
  RESULT_VARIABLE code
  OUTPUT_VARIABLE output
  ERROR_VARIABLE error)
if(NOT code STREQUAL "${EXIT}")
  message(FATAL_ERROR "exit code ${code} where ${EXIT} is expected\n${error}")
endif()
if(EXPECTED)
  file(WRITE ${ACTUAL} "${output}")
  execute_process(COMMAND /usr/bin/python3 ${CMAKE_CURRENT_LIST_DIR}/same_output.py ${ACTUAL} ${EXPECTED}
                  RESULT_VARIABLE differs ERROR_VARIABLE difference)
  if(differs)
    message(FATAL_ERROR "standard output differs from ${EXPECTED}; see ${ACTUAL}\n${difference}")
  endif()
elseif(NOT output STREQUAL "")
  message(FATAL_ERROR "standard output is not empty:\n${output}")
endif()
if(ERROR)
  if(NOT error MATCHES "^${ERROR}\n$")
    message(FATAL_ERROR "standard error is\n${error}where ${ERROR} is expected")
  endif()
elseif(NOT error STREQUAL "")
  message(FATAL_ERROR "standard error is not empty:\n${error}")
endif()
