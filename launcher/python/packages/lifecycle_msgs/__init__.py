# SPDX-License-Identifier: Apache-2.0
"""The numbers of states and transitions, for launch files."""
