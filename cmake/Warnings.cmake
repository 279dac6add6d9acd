# Warnings for our own targets only: Eigen, SUNDIALS and pybind11 come as imported targets, hence as system headers.
function(saltus_warnings target)
  target_compile_options(${target} PRIVATE
    $<$<COMPILE_LANGUAGE:CXX>:-Wall -Wextra -Wpedantic -Wshadow -Wconversion>
    $<$<BOOL:${SALTUS_WERROR}>:-Werror>)
endfunction()
