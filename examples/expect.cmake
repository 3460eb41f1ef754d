# SPDX-License-Identifier: MIT
# Runs PROGRAM, with ARGUMENTS: it must exit with 0 and print something that matches the regular expression EXPECTED.
execute_process(COMMAND ${PROGRAM} ${ARGUMENTS} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE errors)
if(NOT status STREQUAL "0")
  message(FATAL_ERROR "exit status ${status}\n${output}${errors}")
endif()
if(NOT output MATCHES "${EXPECTED}")
  message(FATAL_ERROR "the output does not match ${EXPECTED}\n${output}")
endif()
