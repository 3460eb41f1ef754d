# SPDX-License-Identifier: MIT
include(${CMAKE_CURRENT_LIST_DIR}/header_only.cmake)
header_only_library(nlohmann_json::nlohmann_json nlohmann/json.hpp)
set(nlohmann_json_FOUND TRUE)
