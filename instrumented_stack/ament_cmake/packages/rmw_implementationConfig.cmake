# SPDX-License-Identifier: Apache-2.0
# rmw_implementation: the library that chooses a middleware. This stack has one, which is in its rmw.
include(CMakeFindDependencyMacro)
find_dependency(rmw)
if(NOT TARGET rmw_implementation::rmw_implementation)
  add_library(rmw_implementation::rmw_implementation INTERFACE IMPORTED)
  target_link_libraries(rmw_implementation::rmw_implementation INTERFACE rmw::rmw)
  target_compile_definitions(rmw_implementation::rmw_implementation INTERFACE DEFAULT_RMW_IMPLEMENTATION=rmw_fastrtps_cpp)
endif()
set(rmw_implementation_TARGETS rmw_implementation::rmw_implementation)
set(rmw_implementation_LIBRARIES rmw_implementation::rmw_implementation)
set(rmw_implementation_INCLUDE_DIRS "")
