# SPDX-License-Identifier: Apache-2.0
# Finds Fast DDS: version 3, whose package is `fastdds`, or version 2 from 2.9 on, whose package is `fastrtps`. Sets FAST_DDS
# to the target to link, and FAST_DDS_VERSION; both are empty if there is none. Must be included at the top, because
# imported targets are known below the folder that finds them.
find_package(fastcdr QUIET)
set(FAST_DDS "")
set(FAST_DDS_VERSION "")
if(fastcdr_FOUND)
  find_package(fastdds QUIET)
  if(fastdds_FOUND)
    set(FAST_DDS fastdds)
    set(FAST_DDS_VERSION ${fastdds_VERSION})
  else()
    find_package(fastrtps QUIET)
    if(fastrtps_FOUND AND fastrtps_VERSION VERSION_GREATER_EQUAL 2.9)
      set(FAST_DDS fastrtps)
      set(FAST_DDS_VERSION ${fastrtps_VERSION})
    endif()
  endif()
endif()
