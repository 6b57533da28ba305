cmake_minimum_required(VERSION 3.25)
# Writes OUTPUT, a header with the short git hash of SOURCE; does not touch a file that is up to date.
execute_process(
  COMMAND git -C ${SOURCE} describe --always --dirty --abbrev=10 --exclude *
  OUTPUT_VARIABLE hash
  OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(NOT hash)
  set(hash "no git")
endif()
file(CONFIGURE OUTPUT ${OUTPUT} CONTENT "#pragma once\n#define GRSEG_GIT_HASH \"@hash@\"\n" @ONLY)
