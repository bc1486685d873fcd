# SPDX-License-Identifier: Apache-2.0
# eigen3_cmake_module: find_package(Eigen3) finds the configuration that Debian's libeigen3-dev brings.
