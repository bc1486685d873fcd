# SPDX-License-Identifier: Apache-2.0
"""What is measured beside the experiment of the paper: one module for each question."""
