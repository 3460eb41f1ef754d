# SPDX-License-Identifier: MIT
# Writes OUTPUT, the source file that holds the git id of SOURCE, if it would change.
set(id unknown)
find_program(GIT git)
if(GIT)
  # A copy of these sources inside somebody else's repository has no id of its own.
  execute_process(COMMAND ${GIT} -C ${SOURCE} rev-parse --show-prefix
                  OUTPUT_VARIABLE prefix OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
  if(NOT failed AND prefix STREQUAL "")
    execute_process(COMMAND ${GIT} -C ${SOURCE} --no-optional-locks describe --always --dirty --abbrev=12 --exclude=*
                    OUTPUT_VARIABLE described OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
    if(NOT failed)
      set(id ${described})
    endif()
  endif()
endif()
set(text "// SPDX-License-Identifier: MIT
#include \"banyan/version.hpp\"

namespace banyan {

std::string_view git_id() noexcept { return \"${id}\"; }

}  // namespace banyan
")
set(old "")
if(EXISTS ${OUTPUT})
  file(READ ${OUTPUT} old)
endif()
if(NOT text STREQUAL old)
  file(WRITE ${OUTPUT} "${text}")
endif()
