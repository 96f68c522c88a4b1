# SPDX-License-Identifier: MIT
# Debian packages, one a component: ./run package.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME minkray)
set(CPACK_PACKAGE_VENDOR Minkray)
set(CPACK_PACKAGE_CONTACT "Minkray <minkray@example.invalid>")
set(CPACK_PACKAGE_DIRECTORY ${CMAKE_BINARY_DIR}/packages)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
set(CPACK_COMPONENTS_ALL program library development documentation cases)
if(MINKRAY_PYTHON)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()

# minkray_package(COMPONENT NAME SECTION DEPENDS TITLE TEXT)
function(minkray_package component name section depends title text)
  string(TOUPPER ${component} upper)
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${name} PARENT_SCOPE)
  set(CPACK_DEBIAN_${upper}_PACKAGE_SECTION ${section} PARENT_SCOPE)
  set(CPACK_DEBIAN_${upper}_PACKAGE_DEPENDS "${depends}" PARENT_SCOPE)
  set(CPACK_COMPONENT_${upper}_DESCRIPTION "${title}\n${text}" PARENT_SCOPE)
  # Policy wants both of every package.
  install(FILES ${CMAKE_SOURCE_DIR}/LICENSE DESTINATION share/doc/${name} RENAME copyright
          COMPONENT ${component})
  install(FILES ${CMAKE_CURRENT_BINARY_DIR}/changelog.gz DESTINATION share/doc/${name}
          COMPONENT ${component})
endfunction()
file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/changelog
"minkray (${PROJECT_VERSION}) unstable; urgency=medium

  * See CHANGELOG.md, in the package minkray-doc.

 -- ${CPACK_PACKAGE_CONTACT}  Mon, 23 Nov 2026 00:00:00 +0000
")
execute_process(COMMAND gzip -n9 -k -f ${CMAKE_CURRENT_BINARY_DIR}/changelog)

set(same "(= ${PROJECT_VERSION})")
# The module is compiled for one Python.
math(EXPR next_python "0${Python_VERSION_MINOR} + 1")
set(python_from "${Python_VERSION_MAJOR}.${Python_VERSION_MINOR}")
set(python_until "${Python_VERSION_MAJOR}.${next_python}")
minkray_package(program minkray graphics "" "rays at exact convex shapes: the program"
  "Casts rays at convex shapes that are known by their support mappings, renders\npictures of them, answers queries and proves its answers.")
minkray_package(library libminkray0 libs "" "rays at exact convex shapes: the library"
  "The shared library, with a C interface.")
minkray_package(development libminkray-dev libdevel "libminkray0 ${same}"
  "rays at exact convex shapes: headers and the static library"
  "What programs in C and C++ are compiled with, for CMake and pkg-config.")
minkray_package(python python3-minkray python "libminkray0 ${same}, python3 (>= ${python_from}), python3 (<< ${python_until}), python3-numpy"
  "rays at exact convex shapes: the Python module" "Arrays in, arrays out: rays, proofs, distances, shapes of your own.")
minkray_package(documentation minkray-doc doc "" "rays at exact convex shapes: documentation"
  "What the formats, the answers and the proofs mean, and example programs.")
minkray_package(cases minkray-cases science python3
  "casts and distances that solvers get wrong, with proven answers"
  "Queries from the trackers of collision libraries, exact answers, certificates,\na schema, and a checker that needs Python alone.")
set(CPACK_DEBIAN_CASES_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_DOCUMENTATION_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SHLIBDEPS ON)
file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/shlibs "libminkray ${PROJECT_VERSION_MAJOR} libminkray0 (>= ${PROJECT_VERSION})\n")
file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/triggers "activate-noawait ldconfig\n")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_CONTROL_EXTRA
  ${CMAKE_CURRENT_BINARY_DIR}/shlibs ${CMAKE_CURRENT_BINARY_DIR}/triggers)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
# What Python keeps beside the module goes with it.
file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/prerm
"#!/bin/sh
set -e
rm -rf /usr/lib/python3/dist-packages/minkray/__pycache__
")
file(CHMOD ${CMAKE_CURRENT_BINARY_DIR}/prerm PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE
     GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA ${CMAKE_CURRENT_BINARY_DIR}/prerm)
# The module needs the library of this very build, which is not installed yet.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${CMAKE_BINARY_DIR})
include(CPack)
