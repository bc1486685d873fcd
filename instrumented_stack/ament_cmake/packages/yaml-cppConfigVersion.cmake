# SPDX-License-Identifier: Apache-2.0
# The version of the installed yaml-cpp, and whether it is the one that is asked for.
find_file(_yaml_cpp_version NAMES yaml-cpp-config-version.cmake yaml-cppConfigVersion.cmake NO_CACHE
  PATH_SUFFIXES lib/${CMAKE_LIBRARY_ARCHITECTURE}/cmake/yaml-cpp lib/cmake/yaml-cpp lib64/cmake/yaml-cpp
    share/cmake/yaml-cpp)
if(_yaml_cpp_version)
  include(${_yaml_cpp_version})
else()
  set(PACKAGE_VERSION_COMPATIBLE FALSE)
endif()
unset(_yaml_cpp_version)
