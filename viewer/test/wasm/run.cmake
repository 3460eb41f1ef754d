# SPDX-License-Identifier: MIT
# Runs TEST with Node.js, or says what has to be built before.
if(NOT EXISTS ${LIVE}/banyan_live.mjs)
  message(FATAL_ERROR "there is no ${LIVE}/banyan_live.mjs; cmake --preset wasm && cmake --build --preset wasm")
endif()
set(ENV{BANYAN_LIVE} ${LIVE})
set(ENV{BANYAN_PROGRAM} ${PROGRAM})
execute_process(COMMAND ${NODE} --test ${TEST} RESULT_VARIABLE failed)
if(failed)
  message(FATAL_ERROR "${TEST} failed")
endif()
