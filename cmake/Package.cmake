# Debian packages, by `cpack` in the folder of the build: one for each component, so that a preset without Python or MPI
# has fewer. The licence is in each.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "the clca authors <authors@clca.invalid>")
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # each package has its own

# The changelog of a package has a form of its own.
string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)
file(WRITE ${PROJECT_BINARY_DIR}/changelog.Debian "clca (${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE}) unstable; urgency=medium

  * Release ${PROJECT_VERSION}.

 -- ${CPACK_PACKAGE_CONTACT}  ${date}
")
execute_process(COMMAND gzip -9nf ${PROJECT_BINARY_DIR}/changelog.Debian COMMAND_ERROR_IS_FATAL ANY)

# clca_package(COMPONENT NAME SECTION SUMMARY DEPENDS [RECOMMENDS])
function(clca_package component name section summary depends)
  install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${name} RENAME copyright COMPONENT ${component})
  install(FILES ${PROJECT_BINARY_DIR}/changelog.Debian.gz DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${name} COMPONENT ${component})
  string(TOUPPER ${component} key)
  set(CPACK_DEBIAN_${key}_PACKAGE_NAME ${name} PARENT_SCOPE)
  set(CPACK_DEBIAN_${key}_PACKAGE_SECTION ${section} PARENT_SCOPE)
  set(CPACK_DEBIAN_${key}_DESCRIPTION "${summary}\n${about}" PARENT_SCOPE)
  set(CPACK_DEBIAN_${key}_PACKAGE_DEPENDS "${depends}" PARENT_SCOPE)
  set(CPACK_DEBIAN_${key}_PACKAGE_RECOMMENDS "${ARGN}" PARENT_SCOPE)
  set(CPACK_COMPONENTS_ALL ${CPACK_COMPONENTS_ALL} ${component} PARENT_SCOPE)
endfunction()

set(about "Grains made of sites of a triangular lattice fall, flow and come to rest, by
rules or by contact dynamics; a gas of inelastic, rough spheres follows the
Boltzmann equation. The same scene and seed always give the same bits.")
set(same "clca (= ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})")
# OSMesa or EGL and the font are found at run time.
clca_package(program clca science "simulator of granular flow in two dimensions" "libosmesa6 | libegl-mesa0, fonts-dejavu-core"
             "python3, python3-gsd, python3-h5py, python3-jinja2, python3-matplotlib, python3-numpy, \
python3-sklearn, python3-yaml, ffmpeg")
clca_package(development libclca-dev libdevel "simulator of granular flow (static libraries and headers)"
             "g++, libeigen3-dev, libfmt-dev, libhdf5-dev, libmuparser-dev, libpango1.0-dev, libpng-dev, \
libyaml-cpp-dev, nlohmann-json3-dev, pkg-config, zlib1g-dev")
if(CLCA_BUILD_PYTHON)
  find_package(Python3 REQUIRED COMPONENTS Interpreter)
  math(EXPR next "${Python3_VERSION_MINOR} + 1")
  clca_package(python python3-clca python "simulator of granular flow (Python package)" "${same}, python3-numpy, python3-h5py, \
python3 (>= ${Python3_VERSION_MAJOR}.${Python3_VERSION_MINOR}~), python3 (<< ${Python3_VERSION_MAJOR}.${next})")
endif()
if(CLCA_MPI)
  clca_package(mpi clca-mpi science "simulator of granular flow (program for mpirun)" "${same}, openmpi-bin")
endif()
include(CPack)
