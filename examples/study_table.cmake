# SPDX-License-Identifier: MIT
# Runs a small study and lets pandas read it: with a limit that nobody keeps, and with one that all keep.
function(table_of limit result)
  file(REMOVE_RECURSE ${SCRATCH})
  execute_process(COMMAND ${BANYAN} study ${SOURCE}/studies/first.toml --set mission.time_limit_s=${limit} --out ${SCRATCH} --quiet
                  COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND ${PYTHON} ${SOURCE}/examples/study_table.py ${SCRATCH} OUTPUT_VARIABLE printed
                  COMMAND_ERROR_IS_FATAL ANY)
  set(${result} "${printed}" PARENT_SCOPE)
endfunction()

table_of(5 printed)
if(NOT printed MATCHES "off 3 inwards +10.0 +1.0 +1.0 +1.0 +10")
  message(FATAL_ERROR "printed:\n${printed}")
endif()

# The verdict and the shift are those of the study's own table.
table_of(150 printed)
if(NOT printed MATCHES "off +3 outwards +inwards +([a-z]+) +(-?[0-9.]+)")
  message(FATAL_ERROR "printed:\n${printed}")
endif()
set(verdict ${CMAKE_MATCH_1})
string(REGEX REPLACE "0+$" "" shift ${CMAKE_MATCH_2})
file(READ ${SCRATCH}/comparisons.csv comparisons)
if(NOT comparisons MATCHES ",off,3,normalized_time,outwards,inwards,${verdict},[^\n]*,${shift},")
  message(FATAL_ERROR "${verdict} by ${shift} is not what comparisons.csv says:\n${printed}")
endif()
