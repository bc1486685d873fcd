# SPDX-License-Identifier: Apache-2.0
# rosidl_generator_py_get_typesupports(<variable>): the type supports that messages in Python work with.
function(rosidl_generator_py_get_typesupports variable)
  set(${variable} rosidl_typesupport_c PARENT_SCOPE)
endfunction()
