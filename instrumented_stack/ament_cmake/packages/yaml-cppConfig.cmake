# SPDX-License-Identifier: Apache-2.0
# yaml-cpp: the installed one. Since 0.8 its target is yaml-cpp::yaml-cpp, which packages link; an older one gets that name
# here.
find_file(_yaml_cpp_config NAMES yaml-cpp-config.cmake yaml-cppConfig.cmake NO_CACHE
  PATH_SUFFIXES lib/${CMAKE_LIBRARY_ARCHITECTURE}/cmake/yaml-cpp lib/cmake/yaml-cpp lib64/cmake/yaml-cpp
    share/cmake/yaml-cpp)
if(NOT _yaml_cpp_config)
  set(yaml-cpp_FOUND FALSE)
  set(yaml-cpp_NOT_FOUND_MESSAGE "yaml-cpp is not installed (Debian: libyaml-cpp-dev)")
  return()
endif()
include(${_yaml_cpp_config})
if(TARGET yaml-cpp AND NOT TARGET yaml-cpp::yaml-cpp)
  add_library(yaml-cpp::yaml-cpp INTERFACE IMPORTED)
  set_target_properties(yaml-cpp::yaml-cpp PROPERTIES INTERFACE_LINK_LIBRARIES yaml-cpp)
endif()
unset(_yaml_cpp_config)
