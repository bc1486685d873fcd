# SPDX-License-Identifier: Apache-2.0
# Stands for a program that no file holds. The program gives the launch description.
