# Files that `cmake --install` installs, and the Debian package that `cpack` makes of them
# (docs/guide/install.md). The programs print their manual pages and completions from their tables of options.
include(GNUInstallDirs)
set(GRSEG_PROGRAMS grseg-sim ${GRSEG_FORMAT_TOOLS} ${GRSEG_TOOLS})
install(TARGETS ${GRSEG_PROGRAMS} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/sim/scenes DESTINATION ${CMAKE_INSTALL_DATADIR}/grseg)
file(READ ${PROJECT_SOURCE_DIR}/CITATION.cff citation)
file(WRITE ${PROJECT_BINARY_DIR}/CITATION.cff "${citation}${GRSEG_REPOSITORY_LINE}")
install(FILES ${PROJECT_SOURCE_DIR}/README.md ${PROJECT_BINARY_DIR}/CITATION.cff TYPE DOC)
# Sweeps, job arrays of Slurm, reanalysis (docs/guide/campaign.md).
set(scripts ${CMAKE_INSTALL_DATADIR}/grseg/scripts)
foreach(file Makefile values.mk as-job shared.py sweep/Makefile sweep/plan sweep/gather sweep/index.html
             reproduce/array.sbatch reproduce/run.mk reproduce/campaign/__main__.py reproduce/campaign/run.py figures/b-of-p.gp)
  cmake_path(GET file PARENT_PATH folder)
  install(PROGRAMS ${PROJECT_SOURCE_DIR}/scripts/${file} DESTINATION ${scripts}/${folder})
endforeach()
install(FILES ${PROJECT_SOURCE_DIR}/formats/README.md TYPE DOC RENAME file-format.md)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE TYPE DOC RENAME copyright)

# grseg_printed(FILE PROGRAM OPTION ...): makes FILE from the standard output of a program, as part of `all`.
set(GRSEG_PRINTED "")
function(grseg_printed file program)
  add_custom_command(
    OUTPUT ${file}
    COMMAND ${program} ${ARGN} > ${file}.part
    COMMAND ${CMAKE_COMMAND} -E rename ${file}.part ${file}
    DEPENDS ${program}
    VERBATIM)
  set(GRSEG_PRINTED ${GRSEG_PRINTED} ${file} PARENT_SCOPE)
endfunction()

file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/man ${PROJECT_BINARY_DIR}/completions/bash ${PROJECT_BINARY_DIR}/completions/zsh)
# What the manual pages say besides --help.
list(TRANSFORM GRSEG_PROGRAMS REPLACE "(.+)" ".BR \\1 (1)," OUTPUT_VARIABLE see_also)
list(JOIN see_also "\n" see_also)
string(REGEX REPLACE ",$" "" see_also "${see_also}")
file(CONFIGURE OUTPUT man/sections.txt CONTENT "[BUGS]\n@GRSEG_HOW_TO_REPORT@\n\n[SEE ALSO]\n@see_also@\n" @ONLY)
foreach(program ${GRSEG_PROGRAMS})
  grseg_printed(${PROJECT_BINARY_DIR}/completions/bash/${program} ${program} --completion bash)
  grseg_printed(${PROJECT_BINARY_DIR}/completions/zsh/_${program} ${program} --completion zsh)
  if(GRSEG_MANUALS_BUILT)
    set(page ${PROJECT_BINARY_DIR}/man/${program}.1)
    add_custom_command(
      OUTPUT ${page}
      COMMAND
        ${PROJECT_SOURCE_DIR}/scripts/packaging/manual ${HELP2MAN} $<TARGET_FILE:${program}> ${page}
        ${PROJECT_BINARY_DIR}/man/sections.txt
      DEPENDS ${program} ${PROJECT_SOURCE_DIR}/scripts/packaging/manual ${PROJECT_BINARY_DIR}/man/sections.txt
      VERBATIM)
    list(APPEND GRSEG_PRINTED ${page})
  endif()
endforeach()
add_custom_target(grseg_printed ALL DEPENDS ${GRSEG_PRINTED})

# Files are listed by name, since the folders may still contain files of former programs.
# `--component manuals` installs them alone.
list(TRANSFORM GRSEG_PROGRAMS PREPEND ${PROJECT_BINARY_DIR}/completions/bash/ OUTPUT_VARIABLE for_bash)
list(TRANSFORM GRSEG_PROGRAMS PREPEND ${PROJECT_BINARY_DIR}/completions/zsh/_ OUTPUT_VARIABLE for_zsh)
list(TRANSFORM GRSEG_PROGRAMS REPLACE "(.+)" "${PROJECT_BINARY_DIR}/man/\\1.1" OUTPUT_VARIABLE manual_pages)
install(FILES ${for_bash} DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
        COMPONENT manuals)
# Debian's zsh searches site-functions below /usr/local and vendor-completions below /usr.
foreach(folder site-functions vendor-completions)
  install(FILES ${for_zsh} DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/${folder} COMPONENT manuals)
endforeach()
if(GRSEG_MANUALS_BUILT)
  install(FILES ${manual_pages} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT manuals)
endif()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME grseg)
set(CPACK_PACKAGE_CONTACT "The grseg developers")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "stress partition between small and large grains")
set(CPACK_PACKAGE_DESCRIPTION
    "Contact dynamics of rigid discs, and tools that split the stress of a granular flow
between species of grains, under any rule for contacts of small with large ones,
also of archives of LAMMPS, LIGGGHTS, MercuryDPM, Siconos, LMGC90 and YADE.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "ffmpeg, gnuplot-nox, python3-h5py")
include(CPack)
