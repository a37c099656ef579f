# Installs the program, the scenes and the libraries; others use them by find_package(clca), with
# COMPONENTS clca (all, the default), core or boltzmann.
include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/clca)

install(TARGETS clca_program RUNTIME)
if(CLCA_MPI)
  install(TARGETS clca_mpi_program RUNTIME)
endif()
install(DIRECTORY scenes/ DESTINATION ${CMAKE_INSTALL_DATADIR}/clca/scenes
        FILES_MATCHING PATTERN "*.yaml" PATTERN "*.json" PATTERN "*.png")
install(DIRECTORY plots/ DESTINATION ${CMAKE_INSTALL_DATADIR}/clca/plots
        FILES_MATCHING PATTERN "*.gp" PATTERN "*.gpi")

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
