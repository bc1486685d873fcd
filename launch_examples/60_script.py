# SPDX-License-Identifier: Apache-2.0
# A program of one's own launches a system, waits for its output, and ends it: python3 60_script.py
import asyncio

from launch import LaunchDescription, LaunchService
from launch.actions import ExecuteProcess, RegisterEventHandler
from launch.event_handlers import OnProcessIO


async def main():
    heard = asyncio.Event()
    talker = ExecuteProcess(cmd=['sh', '-c', 'echo ready to work; sleep 600'])
    listen = OnProcessIO(target_action=talker, on_stdout=lambda event: b'ready' in event.text and heard.set())
    service = LaunchService()
    service.include_launch_description(LaunchDescription([RegisterEventHandler(listen), talker]))
    run = asyncio.create_task(service.run_async())
    await asyncio.wait_for(heard.wait(), timeout=30)
    service.shutdown()
    assert await run == 0


asyncio.run(main())
