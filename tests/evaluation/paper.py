# SPDX-License-Identifier: Apache-2.0
"""
The figures of the paper with which this evaluation is compared.

C. Bédard, I. Lütkebohle, M. Dagenais: "ros2_tracing: Multipurpose Low-Overhead Framework for Real-Time Tracing of ROS 2",
IEEE Robotics and Automation Letters, 2022, arXiv 2201.00393.
"""

TITLE = ('C. Bédard, I. Lütkebohle, M. Dagenais: ros2_tracing: Multipurpose Low-Overhead Framework for Real-Time Tracing '
         'of ROS 2. IEEE Robotics and Automation Letters, 2022')

MEAN_OVERHEAD_US = 3.3
MIDDLE_HALF_US = (1.0, 5.6)
PART_OF_LATENCY = (0.01, 0.15)
TRACEPOINT_NS = 158
TRACEPOINTS_ON_THE_WAY = 10
AIM_US = MEAN_OVERHEAD_US / 2

SYSTEM = ('Intel Core i7-3770, four cores at 3.4 GHz, 8 GB, Ubuntu 20.04.2, Linux 5.4.3-rt1 (PREEMPT_RT); simultaneous '
          'multithreading, idle states, SpeedStep and Turbo Boost off; SCHED_FIFO 99')
PROCEDURE = ('two processes, rmw_fastrtps_cpp, reliable; 60 minutes of each combination with a workspace without tracing, '
             '60 with one that records; ros2:* without context fields, buffers of 2 × 2 MB for each process')
