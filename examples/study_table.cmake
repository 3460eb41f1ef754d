# SPDX-License-Identifier: MIT
# Runs a small study and lets pandas read it; both must find the same median.
file(REMOVE_RECURSE ${SCRATCH})
execute_process(COMMAND ${BANYAN} study ${SOURCE}/studies/first.toml --set mission.time_limit_s=5 --out ${SCRATCH} --quiet
                COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${PYTHON} ${SOURCE}/examples/study_table.py ${SCRATCH} OUTPUT_VARIABLE printed
                COMMAND_ERROR_IS_FATAL ANY)
if(NOT printed MATCHES "off 3 inwards +10.0 +1.0 +1.0 +1.0" OR NOT printed MATCHES "of 60 pairs")
  message(FATAL_ERROR "printed:\n${printed}")
endif()
