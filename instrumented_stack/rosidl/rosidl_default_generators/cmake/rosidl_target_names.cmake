# SPDX-License-Identifier: Apache-2.0
# In ROS 2 a package has a library for each language and type support. Here all these names mean the one library.
foreach(part IN ITEMS rosidl_generator_cpp rosidl_typesupport_cpp rosidl_typesupport_fastrtps_cpp)
  set(target ${CMAKE_FIND_PACKAGE_NAME}::${CMAKE_FIND_PACKAGE_NAME}__${part})
  if(NOT TARGET ${target})
    add_library(${target} INTERFACE IMPORTED)
    target_link_libraries(${target} INTERFACE ${CMAKE_FIND_PACKAGE_NAME}::${CMAKE_FIND_PACKAGE_NAME})
  endif()
endforeach()
unset(target)
