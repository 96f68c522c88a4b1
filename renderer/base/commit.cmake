# SPDX-License-Identifier: MIT
# cmake -DSOURCES=FOLDER -DVERSION=TEXT -DOUT=FILE -P commit.cmake: writes what renderer/base/build.h
# declares, if it has changed. No commit, where the sources are no git repository of their own.
set(commit "")
find_program(GIT git)
if(GIT)
  execute_process(COMMAND ${GIT} -C ${SOURCES} rev-parse --show-toplevel
                  OUTPUT_VARIABLE top OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  file(REAL_PATH ${SOURCES} sources)
  if(top STREQUAL sources)
    execute_process(COMMAND ${GIT} -C ${SOURCES} describe --always --abbrev=12 --dirty=+ --exclude=*
                    OUTPUT_VARIABLE described OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
    if(described)
      set(commit " (${described})")
    endif()
  endif()
endif()
file(WRITE ${OUT}.new "#include \"renderer/base/build.h\"

namespace minkray {

std::string_view version_and_commit() {
  return \"minkray ${VERSION}${commit}\";
}

}  // namespace minkray
")
file(COPY_FILE ${OUT}.new ${OUT} ONLY_IF_DIFFERENT)
