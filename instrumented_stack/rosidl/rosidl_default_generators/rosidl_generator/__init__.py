# SPDX-License-Identifier: Apache-2.0
"""Turns .msg and .srv files into C++ (see __main__.py for the command line)."""
