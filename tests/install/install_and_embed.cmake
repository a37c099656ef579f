# Run as a script, with BUILD, PAGES, EXAMPLE, WORK, GENERATOR, COMPILER and SANITIZE given.
set(prefix ${WORK}/prefix)
set(example_build ${WORK}/example)
file(REMOVE_RECURSE ${prefix} ${example_build})

function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${prefix})
run(${prefix}/bin/clca check wall-removal)
foreach(file clca/python/clca/__main__.py man/man1/clca-run.1.gz bash-completion/completions/clca
        doc/clca/${PAGES} doc/clca/examples/read_trajectory.py)
  if(NOT EXISTS ${prefix}/share/${file})
    message(FATAL_ERROR "${file} is not installed")
  endif()
endforeach()

# What clca::core must not need is not to be found.
set(disabled)
foreach(package fmt yaml-cpp nlohmann_json PNG ZLIB PkgConfig HDF5)
  list(APPEND disabled -DCMAKE_DISABLE_FIND_PACKAGE_${package}=ON)
endforeach()
set(flags)
if(SANITIZE)
  set(flags -fsanitize=${SANITIZE})
endif()
run(${CMAKE_COMMAND} -S ${EXAMPLE} -B ${example_build} -G ${GENERATOR} -DCMAKE_BUILD_TYPE=Release
    -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_CXX_FLAGS=${flags} -DCMAKE_PREFIX_PATH=${prefix}
    ${disabled})
run(${CMAKE_COMMAND} --build ${example_build})

function(expect_output program pattern)
  execute_process(COMMAND ${example_build}/${program} OUTPUT_VARIABLE said COMMAND_ERROR_IS_FATAL ANY)
  message("${said}")
  if(NOT said MATCHES "^${pattern}\n$")
    message(FATAL_ERROR "${program} says something else than expected")
  endif()
endfunction()

expect_output(embed "200 particles settled after [1-9][0-9]* steps, state hash [0-9a-f]+")
expect_output(embed_contact "60 grains at rest after [1-9][0-9]* steps, [1-9][0-9]* contacts, [1-9][0-9]* % of the energy lost")
