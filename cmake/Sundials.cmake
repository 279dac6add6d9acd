# Finds SUNDIALS and wraps it in one target, saltus_sundials. Two ways, SALTUS_SUNDIALS = wheel | system | auto (the first that works):
#
#   wheel   the official Python wheel carries headers and optimised static libraries without MPI. pip fetches it, we unpack
#           it, nothing of it is imported. CVODES (a superset of CVODE). Linux on x86-64.
#   system  find_package(SUNDIALS). Debian's own build is not optimised: right, but 2.5 times slower.
set(SALTUS_SUNDIALS auto CACHE STRING "Where SUNDIALS comes from: auto, wheel or system")
set_property(CACHE SALTUS_SUNDIALS PROPERTY STRINGS auto wheel system)
set(SALTUS_SUNDIALS_CACHE ${CMAKE_CURRENT_BINARY_DIR}/sundials CACHE PATH "Where the SUNDIALS wheel is kept, unpacked")
if(NOT SALTUS_SUNDIALS MATCHES "^(auto|wheel|system)$")
  message(FATAL_ERROR "SALTUS_SUNDIALS is '${SALTUS_SUNDIALS}'; it can be auto, wheel or system")
endif()

# Leaves the unpacked wheel in ${dir}, or says in ${error} why not.
function(saltus_fetch_sundials dir error)
  file(STRINGS ${PROJECT_SOURCE_DIR}/cmake/sundials-wheel.txt pin REGEX "^sundials4py")
  string(REGEX REPLACE "^sundials4py==([0-9.]+).*" "\\1" version "${pin}")
  set(target ${SALTUS_SUNDIALS_CACHE}/${version})
  set(${dir} ${target} PARENT_SCOPE)
  if(EXISTS ${target}/lib64/cmake/sundials/SUNDIALSConfig.cmake)
    return()
  endif()
  if(NOT CMAKE_SYSTEM_NAME STREQUAL Linux OR NOT CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64)$")
    set(${error} "there is no wheel with libraries for ${CMAKE_SYSTEM_NAME} on ${CMAKE_SYSTEM_PROCESSOR}" PARENT_SCOPE)
    return()
  endif()
  find_package(Python COMPONENTS Interpreter QUIET)
  message(STATUS "Fetching the SUNDIALS ${version} wheel with pip")
  set(part ${SALTUS_SUNDIALS_CACHE}/part)
  file(REMOVE_RECURSE ${part})
  execute_process(  # it needs Python 3.12 to be imported, any to be unpacked
    COMMAND ${Python_EXECUTABLE} -m pip download --quiet --no-deps --only-binary=:all: --require-hashes --python-version 3.12
      --implementation cp --abi abi3 --platform manylinux_2_28_x86_64 --platform manylinux_2_27_x86_64
      --requirement ${PROJECT_SOURCE_DIR}/cmake/sundials-wheel.txt --dest ${part}
    RESULT_VARIABLE failed OUTPUT_VARIABLE text ERROR_VARIABLE text)
  if(failed)
    set(${error} "'${Python_EXECUTABLE} -m pip download sundials4py==${version}' failed: ${text}" PARENT_SCOPE)
    return()
  endif()
  file(GLOB wheel ${part}/*.whl)
  file(ARCHIVE_EXTRACT INPUT ${wheel} DESTINATION ${part} PATTERNS include/* lib64/* *.dist-info/licenses/*)
  file(REMOVE_RECURSE ${wheel} ${target})
  file(RENAME ${part} ${target})  # last, so that what is there is whole
endfunction()

unset(SUNDIALS_DIR CACHE)  # so that a build directory can change its mind
set(cvode cvode)
set(solvers nvecserial sunlinsolspgmr sunnonlinsolfixedpoint sunnonlinsolnewton)
set(SALTUS_SUNDIALS_WHEEL "")  # where it is, if that is what we use
if(NOT SALTUS_SUNDIALS STREQUAL "system")
  saltus_fetch_sundials(unpacked error)
  if(NOT error)
    set(SALTUS_SUNDIALS_WHEEL ${unpacked})
    set(cvode cvodes)
    find_package(SUNDIALS CONFIG REQUIRED COMPONENTS ${cvode} ${solvers} PATHS ${unpacked}/lib64/cmake/sundials NO_DEFAULT_PATH)
  elseif(SALTUS_SUNDIALS STREQUAL "wheel")
    message(FATAL_ERROR "No SUNDIALS wheel: ${error}\nOr use the installed one: -DSALTUS_SUNDIALS=system")
  else()
    message(STATUS "No SUNDIALS wheel, trying the installed one: ${error}")
  endif()
endif()
if(NOT SALTUS_SUNDIALS_WHEEL)
  find_package(SUNDIALS CONFIG QUIET COMPONENTS ${cvode} ${solvers})  # no version: a range refuses 6.4, a minimum refuses 7
endif()
if(NOT SUNDIALS_FOUND OR SUNDIALS_VERSION VERSION_LESS 6.2)
  message(FATAL_ERROR "saltus needs SUNDIALS >= 6.2 with CVODE, found: '${SUNDIALS_VERSION}' ${SUNDIALS_DIR}. Install it "
    "(Debian: libsundials-dev) or let pip fetch it: -DSALTUS_SUNDIALS=wheel")
endif()

add_library(saltus_sundials INTERFACE)
if(SALTUS_SUNDIALS_WHEEL)
  # The wheel's libraries call hooks of its Python layer. The archive that stands in for it must come after them when linking.
  add_library(saltus_sundials_hooks STATIC ${PROJECT_SOURCE_DIR}/src/solver/sundials_hooks.c)
  set_target_properties(saltus_sundials_hooks PROPERTIES POSITION_INDEPENDENT_CODE ON)
  target_link_libraries(SUNDIALS::core_static INTERFACE saltus_sundials_hooks)
  target_compile_definitions(saltus_sundials INTERFACE SALTUS_SUNDIALS_CVODES=1)
  set(SALTUS_SUNDIALS_FOUND "${SUNDIALS_VERSION} (wheel)")
else()
  set(SALTUS_SUNDIALS_FOUND "${SUNDIALS_VERSION} (system, ${SUNDIALS_DIR})")
endif()

set(SALTUS_SUNDIALS_COMPONENTS ${cvode} ${solvers})
foreach(component ${SALTUS_SUNDIALS_COMPONENTS} core)
  if(TARGET SUNDIALS::${component})  # 6.x has no core
    if(SALTUS_SUNDIALS_WHEEL)  # an installed saltus brings its copy of the archives, see Install.cmake
      get_target_property(archive SUNDIALS::${component}_static LOCATION)
      list(APPEND SALTUS_SUNDIALS_ARCHIVES ${archive})
      get_filename_component(name ${archive} NAME)
      target_link_libraries(saltus_sundials INTERFACE $<BUILD_INTERFACE:SUNDIALS::${component}>
        $<INSTALL_INTERFACE:$<INSTALL_PREFIX>/${CMAKE_INSTALL_LIBDIR}/saltus/${name}>)
    else()
      target_link_libraries(saltus_sundials INTERFACE SUNDIALS::${component})
    endif()
  endif()
endforeach()
if(SALTUS_SUNDIALS_WHEEL)
  target_link_libraries(saltus_sundials INTERFACE saltus_sundials_hooks m)
endif()
