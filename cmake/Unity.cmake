# saltus_unity(TARGET GROUP FILE...): with SALTUS_UNITY these files are compiled as one, so headers are read once and each
# template is instantiated once, which is most of the work. Without it each file is compiled alone, so a change costs less.
function(saltus_unity target group)
  foreach(source IN LISTS ARGN)
    if(NOT EXISTS ${CMAKE_CURRENT_SOURCE_DIR}/${source} AND NOT EXISTS ${source})
      message(FATAL_ERROR "saltus_unity(${target} ${group}): there is no file ${source}")
    endif()
  endforeach()
  if(SALTUS_UNITY)
    string(REPLACE / _ group ${group})
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
    set_source_files_properties(${ARGN} PROPERTIES UNITY_GROUP ${group})
  endif()
endfunction()
