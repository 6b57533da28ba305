# Runs COMMAND (a ;-list) in FOLDER and compares exit code, standard output with the file EXPECTED (or
# nothing), and standard error with the regular expression ERROR (or nothing).
execute_process(
  COMMAND ${COMMAND}
  WORKING_DIRECTORY ${FOLDER}
  RESULT_VARIABLE code
  OUTPUT_VARIABLE output
  ERROR_VARIABLE error)
if(NOT code STREQUAL "${EXIT}")
  message(FATAL_ERROR "exit code ${code} where ${EXIT} is expected\n${error}")
endif()
set(expected "")
if(EXPECTED)
  file(READ ${EXPECTED} expected)
endif()
if(NOT output STREQUAL expected)
  file(WRITE ${ACTUAL} "${output}")
  message(FATAL_ERROR "standard output differs from ${EXPECTED}; see ${ACTUAL}")
endif()
if(ERROR)
  if(NOT error MATCHES "^${ERROR}\n$")
    message(FATAL_ERROR "standard error is\n${error}where ${ERROR} is expected")
  endif()
elseif(NOT error STREQUAL "")
  message(FATAL_ERROR "standard error is not empty:\n${error}")
endif()
