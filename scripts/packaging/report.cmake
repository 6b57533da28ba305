# Where users report faults: the one place from which --version, the manual pages and the installed CITATION.cff
# take it. A clone knows the repository from which it came; whoever packs grseg may set another address.
execute_process(COMMAND git -C ${PROJECT_SOURCE_DIR} config --get remote.origin.url OUTPUT_VARIABLE origin
                OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
string(REGEX REPLACE "//[^/@]*@" "//" origin "${origin}") # leaves out a name and password
if(NOT origin MATCHES "^(https?|ssh)://|^git@")           # a folder of somebody's computer
  set(origin "")
endif()
set(GRSEG_REPORT_TO "${origin}" CACHE STRING "Address to which users report faults; default: that of the cloned repository")
if(GRSEG_REPORT_TO)
  set(GRSEG_HOW_TO_REPORT "Report faults to ${GRSEG_REPORT_TO}, with this version and the command.")
  set(GRSEG_REPOSITORY_LINE "repository-code: \"${GRSEG_REPORT_TO}\"\n")
else()
  set(GRSEG_HOW_TO_REPORT
      "Report faults, with this version and the command, where you got grseg: a clone says it by 'git remote get-url origin'.")
  set(GRSEG_REPOSITORY_LINE "")
endif()
