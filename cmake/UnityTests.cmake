# saltus_unity_tests(RESULT FILE...): RESULT is a list of written files, each of which includes ten of these tests. Each template is
# then instantiated once for ten tests, which halves the work. Forty, where nothing is compiled again (SALTUS_UNITY), save another
# fifth. Names that two tests have stay apart, because each test is in a namespace of its own; what a test includes is included
# before, outside of it.
function(saltus_unity_tests result)
  set(files "")
  set(number 0)
  list(LENGTH ARGN count)
  math(EXPR last "${count} - 1")
  set(size 10)
  if(SALTUS_UNITY GREATER 40)
    set(size 40)
  endif()
  foreach(first RANGE 0 ${last} ${size})
    list(SUBLIST ARGN ${first} ${size} some)
    math(EXPR number "${number} + 1")
    set(file ${CMAKE_CURRENT_BINARY_DIR}/unity/tests_${number}.cpp)
    saltus_write_unity(${file} ${some})
    list(APPEND files ${file})
  endforeach()
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${ARGN})  # a test may include more
  set(${result} ${files} PARENT_SCOPE)
endfunction()

function(saltus_write_unity file)
  set(includes "")
  set(bodies "")
  foreach(test IN LISTS ARGN)
    file(STRINGS ${test} own REGEX "^#include ")
    cmake_path(GET test PARENT_PATH folder)
    foreach(line IN LISTS own)
      string(REGEX REPLACE "^#include \"(.*)\"$" "${folder}/\\1" beside "${line}")
      if(EXISTS ${beside})  # it lies beside the test, not on the path
        set(line "#include \"${beside}\"")
      endif()
      list(APPEND includes ${line})
    endforeach()
    cmake_path(GET test STEM name)
    string(APPEND bodies "namespace ${name} {\n#include \"${test}\"\n}\n")
  endforeach()
  list(REMOVE_DUPLICATES includes)
  list(JOIN includes "\n" includes)
  file(CONFIGURE OUTPUT ${file} CONTENT "${includes}\n${bodies}" @ONLY)  # leaves the file alone if nothing changed
endfunction()
