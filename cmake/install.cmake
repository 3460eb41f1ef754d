# SPDX-License-Identifier: MIT
# What `cmake --install` and the Debian packages contain: one export set per room, so that robot
# code can ask for the controller alone and needs nothing else installed.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(cmake_dir ${CMAKE_INSTALL_LIBDIR}/cmake/banyan)
set(rooms "")
foreach(room IN ITEMS version controller baselines algorithms world measure record config)
  if(NOT TARGET banyan_${room})
    continue()
  endif()
  list(APPEND rooms ${room})
  target_compile_features(banyan_${room} PUBLIC cxx_std_20)
  set_target_properties(banyan_${room} PROPERTIES EXPORT_NAME ${room})
  install(TARGETS banyan_${room} EXPORT banyan-${room} ARCHIVE COMPONENT development)
  install(EXPORT banyan-${room} FILE banyan-${room}-targets.cmake NAMESPACE banyan:: DESTINATION ${cmake_dir}
          COMPONENT development)
  if(NOT room STREQUAL version)
    # A room has one include/, baselines/ one in each folder.
    file(GLOB faces ${PROJECT_SOURCE_DIR}/${room}/include ${PROJECT_SOURCE_DIR}/${room}/*/include)
    foreach(face IN LISTS faces)
      install(DIRECTORY ${face}/ TYPE INCLUDE COMPONENT development FILES_MATCHING PATTERN "*.hpp")
    endforeach()
  endif()
endforeach()
if(TARGET banyan_version)
  install(FILES ${PROJECT_BINARY_DIR}/version/include/banyan/version.hpp
          DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/banyan COMPONENT development)
endif()

set(generated ${PROJECT_BINARY_DIR}/install)
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/banyan-config.cmake.in ${generated}/banyan-config.cmake
                              INSTALL_DESTINATION ${cmake_dir} NO_SET_AND_CHECK_MACRO)
# Before 1.0 every minor version may change what users call.
write_basic_package_version_file(${generated}/banyan-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${generated}/banyan-config.cmake ${generated}/banyan-config-version.cmake
        DESTINATION ${cmake_dir} COMPONENT development)

# The prefix is found from where the file lies, so `cmake --install --prefix` may differ from the
# prefix of the configuration. Link order: users before what they use.
set(pc_dir ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
file(RELATIVE_PATH pc_prefix /${pc_dir} /)
string(REGEX REPLACE "/$" "" pc_prefix "${pc_prefix}")
if(IS_ABSOLUTE ${CMAKE_INSTALL_LIBDIR} OR IS_ABSOLUTE ${CMAKE_INSTALL_INCLUDEDIR})
  message(FATAL_ERROR "CMAKE_INSTALL_LIBDIR and CMAKE_INSTALL_INCLUDEDIR must be relative to the prefix")
endif()
set(pc_libs "")
foreach(room IN LISTS rooms)
  string(PREPEND pc_libs "-lbanyan_${room} ")
endforeach()
set(pc_requires "")
set(pc_system_libs "")
if(TARGET banyan_world)
  if(BANYAN_HAVE_BOX2D)
    list(APPEND pc_requires box2d)
  endif()
  if(BANYAN_HAVE_ZSTD)
    list(APPEND pc_requires libzstd)
  endif()
  if(BANYAN_HAVE_MAPS)
    list(APPEND pc_requires yaml-0.1)
  endif()
  if(BANYAN_TOML_LIBRARY)
    list(APPEND pc_requires tomlplusplus)
  endif()
  list(JOIN pc_requires ", " pc_requires)
  set(pc_system_libs "-pthread")
endif()
configure_file(${PROJECT_SOURCE_DIR}/cmake/banyan.pc.in ${generated}/banyan.pc @ONLY)
install(FILES ${generated}/banyan.pc DESTINATION ${pc_dir} COMPONENT development)

if(TARGET banyan_cli)
  foreach(program IN ITEMS banyan_cli banyan_robot banyan_tune)
    if(TARGET ${program})
      install(TARGETS ${program} RUNTIME COMPONENT program)
    endif()
  endforeach()
  # Maps lie beside the scenarios that name them; some studies name parameters that tuning found.
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/scenarios DESTINATION ${CMAKE_INSTALL_DATADIR}/banyan COMPONENT program
          FILES_MATCHING PATTERN "*.png" PATTERN "*.yaml")
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/scenarios ${PROJECT_SOURCE_DIR}/studies ${PROJECT_SOURCE_DIR}/parameters ${PROJECT_SOURCE_DIR}/results
          DESTINATION ${CMAKE_INSTALL_DATADIR}/banyan COMPONENT program
          FILES_MATCHING PATTERN "*.toml")
  # The program needs it without the package of Python.
  install(FILES ${PROJECT_SOURCE_DIR}/hosts/python/banyan/figures.py DESTINATION ${CMAKE_INSTALL_DATADIR}/banyan COMPONENT program)
  # By which a workspace of colcon knows what is installed in it.
  install(FILES ${PROJECT_SOURCE_DIR}/package.xml DESTINATION ${CMAKE_INSTALL_DATADIR}/banyan COMPONENT program)
  # The page, if viewer/build has built it.
  if(EXISTS ${PROJECT_SOURCE_DIR}/build/viewer/page/index.html)
    install(DIRECTORY ${PROJECT_SOURCE_DIR}/build/viewer/page/ DESTINATION ${CMAKE_INSTALL_DATADIR}/banyan/viewer COMPONENT program)
  endif()
  if(EXISTS ${PROJECT_SOURCE_DIR}/cli/completion/banyan.bash)
    install(FILES ${PROJECT_SOURCE_DIR}/cli/completion/banyan.bash RENAME banyan
            DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT program)
  endif()
  install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME copyright COMPONENT program)
endif()

# In a package of its own, so that nobody else needs DDS.
if(TARGET banyan_ros2)
  install(TARGETS banyan_ros2 RUNTIME COMPONENT ros2)
  install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/banyan-ros2 RENAME copyright COMPONENT ros2)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/hosts/ros2/launch ${PROJECT_SOURCE_DIR}/hosts/ros2/rviz ${PROJECT_SOURCE_DIR}/hosts/ros2/foxglove
          DESTINATION ${CMAKE_INSTALL_DATADIR}/banyan COMPONENT ros2 PATTERN __pycache__ EXCLUDE)
  # By which `ros2 launch` finds them: an entry in ament's index, and hooks for colcon's setup (colcon.pkg).
  file(WRITE ${generated}/index/banyan "")
  file(WRITE ${generated}/hook/ament_prefix_path.dsv "prepend-non-duplicate;AMENT_PREFIX_PATH;\n")
  file(WRITE ${generated}/hook/ament_prefix_path.sh "_colcon_prepend_unique_value AMENT_PREFIX_PATH \"$COLCON_CURRENT_PREFIX\"\n")
  install(FILES ${generated}/index/banyan DESTINATION ${CMAKE_INSTALL_DATADIR}/ament_index/resource_index/packages COMPONENT ros2)
  install(DIRECTORY ${generated}/hook DESTINATION ${CMAKE_INSTALL_DATADIR}/banyan COMPONENT ros2)
endif()

# cpack -G DEB: `banyan` (the program), `libbanyan-dev` (what a developer links), and `python3-banyan` and
# `banyan-ros2` where they are built.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME banyan)
set(CPACK_PACKAGE_VENDOR "The Banyan authors")
set(CPACK_PACKAGE_CONTACT "The Banyan authors, by an issue where you found Banyan")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL program development)
if(TARGET banyan_python)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()
if(TARGET banyan_ros2)
  list(APPEND CPACK_COMPONENTS_ALL ros2)
endif()
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME banyan)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION "${PROJECT_DESCRIPTION}
 A swarm of robots deploys to several distant targets and keeps its radio
 network connected by growing a tree. This is the simulator and its tools.")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libbanyan-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(depends libtomlplusplus-dev)
if(BANYAN_HAVE_BOX2D)
  list(APPEND depends libbox2d-dev)
endif()
if(BANYAN_HAVE_ZSTD)
  list(APPEND depends libzstd-dev)
endif()
if(BANYAN_HAVE_MAPS)
  list(APPEND depends libyaml-dev)
endif()
list(JOIN depends ", " CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS)
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "${PROJECT_DESCRIPTION} (development files)
 The robot's program (controller), its algorithms, the simulated world, its measures and the
 writer of recordings, as static libraries with headers.")
set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-banyan)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
# The module is for the interpreter that it was built with; scenarios and films come with the program.
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "banyan, python3-numpy, python3 (>= 3.11), python3 (<< 3.12)")
if(Python_VERSION_MAJOR)
  math(EXPR next_minor "${Python_VERSION_MINOR} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
      "banyan, python3-numpy, python3 (>= 3.${Python_VERSION_MINOR}), python3 (<< 3.${next_minor})")
endif()
set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS "python3-pandas, python3-matplotlib")
set(CPACK_COMPONENT_PYTHON_DESCRIPTION "${PROJECT_DESCRIPTION} (Python)
 Runs, worlds, studies and recordings as arrays and tables; controllers of
 your own, and environments for learning.")
set(CPACK_DEBIAN_ROS2_PACKAGE_NAME banyan-ros2)
set(CPACK_DEBIAN_ROS2_PACKAGE_SECTION science)
set(CPACK_COMPONENT_ROS2_DESCRIPTION "${PROJECT_DESCRIPTION} (bridge to ROS 2)
 Robots and tracker of ROS 2 for a hub and robots of Banyan, without ROS.")
find_program(DPKG_SHLIBDEPS dpkg-shlibdeps)
find_program(FILE_PROGRAM file)
mark_as_advanced(DPKG_SHLIBDEPS FILE_PROGRAM)
if(DPKG_SHLIBDEPS AND FILE_PROGRAM)
  set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
  if(BANYAN_HAVE_PIXELS)
    set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS "librsvg2-2")  # loaded by the first picture, so not seen there
  endif()
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
  set(CPACK_DEBIAN_ROS2_PACKAGE_SHLIBDEPS ON)
else()
  set(CPACK_DEBIAN_ROS2_PACKAGE_DEPENDS "libc6, libstdc++6, libsodium23, libddsc0debian")
  set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS
      "libc6, libstdc++6, libbox2d2, libzstd1, libyaml-0-2, libtomlplusplus3, libpagmo8, libboost-serialization1.74.0, libopenmpi3, librsvg2-2, libcairo2, libcpp-httplib0.11")
endif()
# The program does without, but for figures, for mpirun, for films and for the text in pictures.
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "python3-matplotlib, openmpi-bin, ffmpeg, fonts-dejavu-core, xdg-utils")
include(CPack)
