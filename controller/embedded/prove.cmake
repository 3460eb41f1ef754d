# SPDX-License-Identifier: MIT
# Fails if the controller's objects, or the firmware linked from them, refer to a heap, exceptions,
# run-time type information, streams, a clock or emulated double arithmetic, or if the firmware has outgrown
# 88 KB; prints the sizes.
set(forbidden
  # heap
  "malloc|calloc|realloc|_malloc_r|_free_r|free|_sbrk|sbrk"
  "_Zn[wa].*|_Zd[la].*"
  # exceptions and run-time type information (pure virtual functions are allowed)
  "__cxa_(allocate_exception|throw|rethrow|begin_catch|end_catch|get_exception_ptr|bad_cast|bad_typeid)|__gxx_personality.*|_Unwind_.*"
  "_ZSt[0-9]+__throw_.*|_ZSt9terminatev|__dynamic_cast|_ZTI.*|_ZTS.*"
  # input and output, clocks, threads
  "_ZNSt8ios_base.*|_ZSt4cout|_ZSt4cerr|printf|fprintf|snprintf|puts|_write|_read|fopen|time|clock|gettimeofday|_gettimeofday|_ZNSt6chrono.*|pthread_.*|abort|exit|_exit|rand|srand"
  # double: the chip has none
  "__aeabi_(d.*|f2d|i2d|ui2d|l2d|ul2d|cd.*)|sqrt|sin|cos|atan2|exp|log|pow|hypot|hypotf|sinf|cosf|atan2f|expf|logf|powf")
list(JOIN forbidden "|" forbidden)

foreach(file IN ITEMS ${ARCHIVE} ${FIRMWARE})
  # All names that occur: defined or not. An archive that defines malloc would be no better.
  execute_process(COMMAND ${NM} --format=posix ${file} OUTPUT_VARIABLE symbols RESULT_VARIABLE failed)
  if(failed OR symbols STREQUAL "")
    message(FATAL_ERROR "cannot read the symbols of ${file}")
  endif()
  string(REGEX MATCHALL "(^|\n)[^ \n]+ [A-Za-z?]" lines "${symbols}")
  list(LENGTH lines count)
  set(found "")
  foreach(line IN LISTS lines)
    string(REGEX REPLACE "^\n?([^ ]+) .*" "\\1" name "${line}")
    if(name MATCHES "^(${forbidden})$")
      list(APPEND found ${name})
    endif()
  endforeach()
  get_filename_component(base ${file} NAME)
  if(found)
    list(REMOVE_DUPLICATES found)
    message(FATAL_ERROR "${base} must not refer to: ${found}")
  endif()
  message(STATUS "${base}: ${count} symbols, none of a heap, exceptions, streams, clocks or double arithmetic")
endforeach()

execute_process(COMMAND ${SIZE} -t ${ARCHIVE} COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${SIZE} ${FIRMWARE} OUTPUT_VARIABLE sizes COMMAND_ERROR_IS_FATAL ANY)
message(STATUS "the firmware:\n${sizes}")
# All algorithms together: convoy, caravan, and the paper's two in both readings. A robot carries one of them.
math(EXPR most "88 * 1024")
if(NOT sizes MATCHES "\n *([0-9]+)" OR CMAKE_MATCH_1 GREATER most)
  message(FATAL_ERROR "the firmware has ${CMAKE_MATCH_1} bytes of code, more than ${most}")
endif()
