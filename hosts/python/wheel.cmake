# SPDX-License-Identifier: MIT
# What pyproject.toml builds (banyan_wheel) and installs (component wheel) beside the Python files: the package's folder is
# the prefix of an installation, so that program, scenarios and page find each other wherever the environment is.
add_custom_target(banyan_wheel DEPENDS ${python_modules})
if(NOT BANYAN_INSTALL)
  return()
endif()
install(TARGETS ${python_modules} LIBRARY DESTINATION banyan COMPONENT wheel EXCLUDE_FROM_ALL)
foreach(program IN ITEMS banyan_cli banyan_robot banyan_tune)
  if(TARGET ${program})
    add_dependencies(banyan_wheel ${program})
    install(TARGETS ${program} RUNTIME DESTINATION banyan/bin COMPONENT wheel EXCLUDE_FROM_ALL)
  endif()
endforeach()
install(DIRECTORY ${PROJECT_SOURCE_DIR}/scenarios ${PROJECT_SOURCE_DIR}/studies ${PROJECT_SOURCE_DIR}/parameters ${PROJECT_SOURCE_DIR}/results
        DESTINATION banyan/share/banyan COMPONENT wheel EXCLUDE_FROM_ALL FILES_MATCHING PATTERN "*.toml")
install(FILES banyan/figures.py DESTINATION banyan/share/banyan COMPONENT wheel EXCLUDE_FROM_ALL)
# The page, if viewer/build has built it.
install(DIRECTORY ${PROJECT_SOURCE_DIR}/build/viewer/page/ DESTINATION banyan/share/banyan/viewer COMPONENT wheel EXCLUDE_FROM_ALL OPTIONAL)
