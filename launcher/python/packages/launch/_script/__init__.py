# SPDX-License-Identifier: Apache-2.0
"""
LaunchService in a Python program of the user's.

The launcher is a process of its own, which the service starts. All Python stays in the user's process: the launcher calls
its objects over a socket, and they ask the launcher back. When either of the two processes dies, the other one notices,
and the launcher or its guardian ends all that was launched.
"""
