# SPDX-License-Identifier: Apache-2.0
# In ROS 2 it brings pybind11 where the system has none. Here pybind11 is that of the system (Debian: pybind11-dev).
