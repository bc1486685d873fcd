# SPDX-License-Identifier: Apache-2.0
# ROS 2 has a library per language and type support of a package; here each of these names is the one library.
foreach(part IN ITEMS rosidl_generator_cpp rosidl_typesupport_cpp rosidl_typesupport_fastrtps_cpp)
  set(target ${CMAKE_FIND_PACKAGE_NAME}::${CMAKE_FIND_PACKAGE_NAME}__${part})
  if(NOT TARGET ${target})
    add_library(${target} INTERFACE IMPORTED)
    target_link_libraries(${target} INTERFACE ${CMAKE_FIND_PACKAGE_NAME}::${CMAKE_FIND_PACKAGE_NAME})
  endif()
endforeach()
unset(target)
