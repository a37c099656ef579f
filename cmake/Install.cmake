# Installs the program with its data, documents, man pages and completion, the libraries, and the Python package where it is built. Others
# use the libraries by find_package(clca), with COMPONENTS clca (all, the default), core or boltzmann, or by pkg-config.
# Each component is a Debian package (Package.cmake).
include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/clca)

set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME program)
install(TARGETS clca_program RUNTIME)
install(DIRECTORY scenes DESTINATION ${CMAKE_INSTALL_DATADIR}/clca)
# What reads folders, for the commands that draw: plain Python.
install(DIRECTORY src/python/clca DESTINATION ${CMAKE_INSTALL_DATADIR}/clca/python PATTERN __pycache__ EXCLUDE)
install(FILES src/cli/completion/clca.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME clca)
install(FILES src/cli/completion/_clca DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions)
install(FILES src/cli/completion/clca.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)
install(CODE "
  set(folder \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_MANDIR}/man1\")
  file(MAKE_DIRECTORY \${folder})
  execute_process(COMMAND $<TARGET_FILE:clca_program> __man \${folder} COMMAND_ERROR_IS_FATAL ANY)
  file(GLOB pages \${folder}/clca*.1)
  execute_process(COMMAND gzip -9nf \${pages} COMMAND_ERROR_IS_FATAL ANY)")

set(documents ${CMAKE_INSTALL_DATADIR}/doc/clca)
install(DIRECTORY examples DESTINATION ${documents} PATTERN __pycache__ EXCLUDE)
find_program(MKDOCS mkdocs)
if(MKDOCS)  # the site, else its pages
  install(CODE "
    execute_process(COMMAND ${CMAKE_COMMAND} -E env PYTHONDONTWRITEBYTECODE=1 ${MKDOCS} build --quiet --strict
                            --config-file ${PROJECT_SOURCE_DIR}/mkdocs.yml
                            --site-dir \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${documents}/html\"
                    COMMAND_ERROR_IS_FATAL ANY)")
else()
  install(FILES README.md CHANGELOG.md DESTINATION ${documents})
  install(DIRECTORY docs DESTINATION ${documents})
endif()

if(CLCA_MPI)
  install(TARGETS clca_mpi_program RUNTIME COMPONENT mpi)
endif()

if(CLCA_BUILD_PYTHON)
  set(CLCA_PYTHON_DIR lib/python3/dist-packages CACHE STRING "Where to install the Python package, below the prefix")
  install(TARGETS clca_python LIBRARY DESTINATION ${CLCA_PYTHON_DIR}/clca COMPONENT python)
  install(DIRECTORY src/python/clca DESTINATION ${CLCA_PYTHON_DIR} COMPONENT python PATTERN __pycache__ EXCLUDE)
  if(NOT CLCA_PYTHON_DIR STREQUAL ".")  # so that the program draws grains by it, too; pip has no program
    file(RELATIVE_PATH compiled /${CMAKE_INSTALL_DATADIR}/clca/python/clca /${CLCA_PYTHON_DIR}/clca)
    install(CODE "
      set(folder \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_DATADIR}/clca/python/clca\")
      file(MAKE_DIRECTORY \${folder})
      file(CREATE_LINK ${compiled}/$<TARGET_FILE_NAME:clca_python> \${folder}/$<TARGET_FILE_NAME:clca_python> SYMBOLIC)"
            COMPONENT python)
  endif()
endif()

set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME development)
install(TARGETS clca clca_core clca_boltzmann EXPORT clcaTargets ARCHIVE)
install(DIRECTORY include/ TYPE INCLUDE FILES_MATCHING PATTERN "*.hpp")
install(EXPORT clcaTargets NAMESPACE clca:: DESTINATION ${package_dir})

# Version 0 promises nothing beyond its minor version.
write_basic_package_version_file(clcaConfigVersion.cmake COMPATIBILITY SameMinorVersion)
file(WRITE ${PROJECT_BINARY_DIR}/clcaConfig.cmake
     [[include(${CMAKE_CURRENT_LIST_DIR}/Dependencies.cmake)
include(${CMAKE_CURRENT_LIST_DIR}/clcaTargets.cmake)
foreach(component IN LISTS clca_FIND_COMPONENTS)
  if(NOT TARGET clca::${component})
    set(clca_FOUND FALSE)
    set(clca_NOT_FOUND_MESSAGE "no component ${component}; there are clca, core and boltzmann")
  endif()
endforeach()
]])
install(FILES ${PROJECT_BINARY_DIR}/clcaConfig.cmake ${PROJECT_BINARY_DIR}/clcaConfigVersion.cmake
              cmake/Dependencies.cmake
        DESTINATION ${package_dir})
configure_file(cmake/clca.pc.in clca.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/clca.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)

include(cmake/Package.cmake)
