# SPDX-License-Identifier: Apache-2.0
# rmw_implementation_cmake: loops over middlewares. This stack has one, which speaks as rmw_fastrtps_cpp does.
include(CMakeFindDependencyMacro)
find_dependency(ament_cmake)
include_guard(GLOBAL)
cmake_policy(VERSION 3.20...3.25)

# get_available_rmw_implementations(<variable>), get_default_rmw_implementation(<variable>)
function(get_available_rmw_implementations variable)
  set(${variable} rmw_fastrtps_cpp PARENT_SCOPE)
endfunction()
function(get_default_rmw_implementation variable)
  set(${variable} rmw_fastrtps_cpp PARENT_SCOPE)
endfunction()

# call_for_each_rmw_implementation(<function> [GENERATE_DEFAULT]): calls it once, with rmw_implementation set. Names of
# targets get no suffix, because there is no second middleware.
macro(call_for_each_rmw_implementation function)
  set(rmw_implementation rmw_fastrtps_cpp)
  set(rmw_implementation_is_default TRUE)
  set(target_suffix "")
  cmake_language(CALL ${function})
endmacro()

# get_rmw_typesupport(<variable> <middleware> [LANGUAGE <language>]): the type supports that the middleware uses, for c,
# cpp or both.
function(get_rmw_typesupport variable middleware)
  cmake_parse_arguments(PARSE_ARGV 2 ARG "" "LANGUAGE" "")
  set(supports rosidl_typesupport_fastrtps_c rosidl_typesupport_fastrtps_cpp)
  if(ARG_LANGUAGE)
    list(FILTER supports INCLUDE REGEX "_${ARG_LANGUAGE}$")
  endif()
  set(${variable} ${supports} PARENT_SCOPE)
endfunction()
