# SPDX-License-Identifier: Apache-2.0
# rmw_fastrtps_cpp: the middleware of this stack speaks as it does, and is found under its name. It is in the stack's rmw.
include(CMakeFindDependencyMacro)
find_dependency(rmw)
if(NOT TARGET rmw_fastrtps_cpp::rmw_fastrtps_cpp)
  add_library(rmw_fastrtps_cpp::rmw_fastrtps_cpp INTERFACE IMPORTED)
  target_link_libraries(rmw_fastrtps_cpp::rmw_fastrtps_cpp INTERFACE rmw::rmw)
endif()
set(rmw_fastrtps_cpp_TARGETS rmw_fastrtps_cpp::rmw_fastrtps_cpp)
set(rmw_fastrtps_cpp_LIBRARIES rmw_fastrtps_cpp::rmw_fastrtps_cpp)
set(rmw_fastrtps_cpp_INCLUDE_DIRS "")
