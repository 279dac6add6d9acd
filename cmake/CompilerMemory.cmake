# GCC frees memory from 128 MB on, again and again, which is a seventh of the time of a large file. Here it does so from 500 MB
# on, which takes a fifth more memory, where each core has 3 GB of it: the largest of our files takes 2 GB.
cmake_host_system_information(RESULT memory QUERY TOTAL_PHYSICAL_MEMORY)  # [MiB]
cmake_host_system_information(RESULT cores QUERY NUMBER_OF_LOGICAL_CORES)
math(EXPR memory_of_a_core "${memory} / ${cores}")
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU AND memory_of_a_core GREATER 3000)
  add_compile_options($<$<COMPILE_LANGUAGE:CXX>:--param=ggc-min-heapsize=500000>)
endif()
