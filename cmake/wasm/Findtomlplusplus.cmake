# SPDX-License-Identifier: MIT
include(${CMAKE_CURRENT_LIST_DIR}/header_only.cmake)
header_only_library(tomlplusplus::tomlplusplus toml++/toml.h)
set(tomlplusplus_FOUND TRUE)
