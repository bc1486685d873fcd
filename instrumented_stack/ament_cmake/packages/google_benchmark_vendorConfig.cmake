# SPDX-License-Identifier: Apache-2.0
# google_benchmark_vendor: in ROS 2 it brings Google Benchmark where the system has none. Here it is that of the system
# (Debian: libbenchmark-dev), of any version.
find_package(benchmark QUIET)
