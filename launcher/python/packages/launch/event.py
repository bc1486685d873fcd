# SPDX-License-Identifier: Apache-2.0
"""Event: something that happens while the launch runs."""



class Event:
    name = 'launch.Event'
