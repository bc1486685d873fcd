# SPDX-License-Identifier: Apache-2.0
"""`launch doctor` on machines that are directories."""

import json
import os
import pathlib
import subprocess
import tempfile
import unittest

LAUNCH = os.environ['LAUNCH_PROGRAM']

# A machine that is well prepared for real time on its CPUs 2 and 3.
GOOD = {
    'proc/version': 'Linux version 6.12.1 (gcc) #1 SMP PREEMPT_RT\n',
    'proc/swaps': 'Filename\tType\tSize\tUsed\tPriority\n',
    'proc/self/limits': 'Limit                     Soft Limit           Hard Limit           Units\n'
                        'Max open files            65536                65536                files\n'
                        'Max locked memory         unlimited            unlimited            bytes\n'
                        'Max realtime priority     98                   98\n',
    'proc/self/status': 'Name:\tlaunch\nUid:\t1000\t1000\t1000\t1000\nGroups:\t4 984\nCapEff:\t0000000000000000\n',
    'proc/self/cgroup': '0::/\n',
    'proc/self/mountinfo': '29 23 0:26 / /sys/fs/cgroup rw shared:9 - cgroup2 cgroup2 rw\n',
    'proc/sys/kernel/sched_rt_runtime_us': '950000\n',
    'proc/sys/kernel/sched_rt_period_us': '1000000\n',
    'proc/sys/kernel/osrelease': '6.12.1\n',
    'proc/irq/9/smp_affinity_list': '0-1\n',
    'proc/irq/24/effective_affinity_list': '1\n',
    'proc/irq/24/smp_affinity_list': '0-3\n',
    'sys/devices/system/cpu/isolated': '2-3\n',
    'sys/devices/system/clocksource/clocksource0/current_clocksource': 'tsc\n',
    'sys/kernel/mm/transparent_hugepage/enabled': 'always [madvise] never\n',
    'sys/module/lttng_tracer/refcnt': '0\n',
    'sys/fs/cgroup/cgroup.controllers': 'cpuset cpu io memory pids\n',
    'etc/group': 'root:x:0:\ntracing:x:984:ada\n',
    'dev/shm/x': '',
    **{f'sys/devices/system/cpu/cpu{cpu}/cpufreq/scaling_governor': 'performance\n' for cpu in range(4)},
    **{f'sys/devices/system/cpu/cpu{cpu}/cpuidle/state0/{name}': value for cpu in range(4)
       for name, value in {'name': 'POLL\n', 'latency': '0\n', 'disable': '0\n'}.items()},
    **{f'sys/devices/system/cpu/cpu{cpu}/cpuidle/state1/{name}': value for cpu in range(4)
       for name, value in {'name': 'C6\n', 'latency': '133\n', 'disable': '1\n'}.items()},
}


class Doctor(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.root = pathlib.Path(temporary.name)

    def run_doctor(self, *words, changes=None):
        for name, text in {**GOOD, **(changes or {})}.items():
            path = self.root / name
            path.parent.mkdir(parents=True, exist_ok=True)
            if text is None:
                path.unlink(missing_ok=True)
            else:
                path.write_text(text, encoding='utf-8')
        return subprocess.run([LAUNCH, 'doctor', '--root', self.root, *words], capture_output=True, text=True, timeout=60,
                              stdin=subprocess.DEVNULL, check=False)

    def checks(self, *words, changes=None):
        result = self.run_doctor('--json', *words, changes=changes)
        answer = json.loads(result.stdout)
        self.assertEqual(answer['version'], 1)
        self.assertEqual(result.returncode, int(any(check['verdict'] == 'warn' for check in answer['checks'])))
        return {check['name']: check for check in answer['checks']}

    def warnings(self, *words, changes=None):
        found = self.checks(*words, changes=changes)
        return {name: (check['found'], check['advice']) for name, check in found.items() if check['verdict'] == 'warn'
                and name not in ('shared memory', 'cgroups')}  # they depend on the machine that runs the test

    def test_a_machine_that_is_prepared_has_no_warnings(self):
        self.assertEqual(self.warnings(), {})
        found = self.checks()
        self.assertEqual(found['isolated CPUs']['found'], '2-3 are isolated')
        self.assertEqual(found['interrupts']['found'], 'none comes to the CPUs 2-3')
        self.assertEqual(found['governor']['found'], 'CPUs 2-3: performance')
        self.assertEqual({check['area'] for check in found.values()}, {'real time', 'tracing', 'limits', 'nodes'})

    def test_what_is_in_the_way_of_real_time(self):
        found = self.warnings(changes={
            'proc/version': 'Linux version 6.12.1 (gcc) #1 SMP PREEMPT_DYNAMIC\n',
            'proc/swaps': 'Filename\tType\n/dev/sda2 partition\n',
            'proc/self/limits': 'Max locked memory         8388608              8388608              bytes\n'
                                'Max realtime priority     0                    0\n',
            'proc/sys/kernel/sched_rt_runtime_us': '500000\n',
            'proc/irq/9/smp_affinity_list': '0-3\n',
            'sys/devices/system/clocksource/clocksource0/current_clocksource': 'hpet\n',
            'sys/kernel/mm/transparent_hugepage/enabled': '[always] madvise never\n',
            'sys/devices/system/cpu/cpu3/cpufreq/scaling_governor': 'powersave\n',
            'sys/devices/system/cpu/cpu2/cpuidle/state1/disable': '0\n',
        })
        self.assertEqual(found['kernel'][0], 'not PREEMPT_RT: a thread may have to wait for the kernel, whatever its priority')
        self.assertEqual(found['governor'], ('CPUs 2: performance, CPUs 3: powersave', 'cpupower frequency-set -g performance'))
        self.assertEqual(found['idle states'], ('the deepest, C6, takes 133 us to leave', 'cpupower idle-set -D 49'))
        self.assertEqual(found['priorities'][0],
                         'sched_policy fifo and rr are not allowed to this user (RLIMIT_RTPRIO is 0)')
        self.assertEqual(found['locked memory'][0], 'programs may lock 8388608 bytes only')
        self.assertEqual(found['throttling'][0], 'real-time threads get 500000 us of each 1000000 us (sched_rt_runtime_us)')
        self.assertEqual(found['interrupts'][0], 'those of the numbers 9 come to the CPUs 2-3')
        self.assertEqual(found['huge pages'][0],
                         'transparent huge pages: always. The kernel moves memory for them at any time')
        self.assertEqual(found['swap'][0], 'memory can be swapped out')
        self.assertEqual(found['clock'][0], 'hpet: each look at the time is a system call')

    def test_chosen_cpus_need_not_be_the_isolated_ones(self):
        found = self.warnings('--cpus', '1,3,9')
        self.assertEqual(found['CPUs'], ('this machine has no CPU 9', 'its CPUs are 0-3'))
        self.assertEqual(found['isolated CPUs'], ('others may run on 1,9, too',
                                                  'boot with isolcpus=1,3,9 nohz_full=1,3,9 rcu_nocbs=1,3,9'))
        self.assertEqual(found['interrupts'][0], 'those of the numbers 9,24 come to the CPUs 1,3,9')

    def test_capabilities_count(self):
        changes = {'proc/self/limits': '', 'proc/self/status': 'Uid:\t0\t0\nGroups:\t0\nCapEff:\t000001ffffffffff\n'}
        found = self.checks(changes=changes)
        self.assertEqual(found['priorities']['found'], 'allowed, by CAP_SYS_NICE')
        self.assertEqual(found['locked memory']['verdict'], 'ok')
        self.assertEqual(found['group']['found'], 'root may record everything')

    def test_what_is_in_the_way_of_tracing(self):
        found = self.warnings(changes={
            'etc/group': 'root:x:0:\ntracing:x:985:\n',
            'proc/self/limits': GOOD['proc/self/limits'].replace('65536 ', '1024  '),
        })
        self.assertEqual(found['group'], (
            'this user is not in the group tracing: its own processes can be recorded, not the kernel',
            'adduser YOUR_USER tracing, and log in again'))
        self.assertEqual(found['descriptors'][0], '1024 for each process')

    def test_modules_that_are_not_there(self):
        self.run_doctor()
        (self.root / 'sys/module/lttng_tracer/refcnt').unlink()
        (self.root / 'sys/module/lttng_tracer').rmdir()
        result = subprocess.run([LAUNCH, 'doctor', '--root', self.root, '--json'], capture_output=True, text=True, timeout=60,
                                check=False)
        found = {check['name']: check for check in json.loads(result.stdout)['checks']}
        self.assertEqual(found['kernel modules']['found'],
                         "LTTng's are not there, nor is tracefs: the kernel can't be recorded")

    def test_cgroups_of_version_1_hold_no_limits(self):
        changes = {'proc/self/cgroup': '4:memory:/\n', 'proc/self/mountinfo': ''}
        found = self.checks(changes=changes)['cgroups']
        self.assertEqual((found['verdict'], found['found'], found['advice']), (
            'warn', 'cgroups of version 2 are not mounted: memory_max and the like have no effect',
            'boot with systemd.unified_cgroup_hierarchy=1'))

    def test_the_text_has_a_line_for_each(self):
        result = self.run_doctor(changes={'proc/swaps': 'Filename\n/dev/sda2\n'})
        self.assertEqual(result.returncode, 1)
        self.assertIn('real time\n  ok    kernel          PREEMPT_RT\n', result.stdout)
        self.assertIn('  warn  swap            memory can be swapped out\n'
                      '                        do: swapoff -a, or lock the memory in the program\n', result.stdout)

    def test_a_wrong_list_of_cpus(self):
        result = self.run_doctor('--cpus', 'two')
        self.assertEqual((result.returncode, result.stdout), (2, ''))
        self.assertEqual(result.stderr, "launch doctor: error: 'two' is no list of CPUs\n"
                                        "      = help: write numbers and ranges, such as 0,2-3\n")

    def test_a_machine_that_is_no_directory(self):
        result = subprocess.run([LAUNCH, 'doctor', '--root', self.root / 'none'], capture_output=True, text=True, timeout=60,
                                check=False)
        self.assertEqual((result.returncode, result.stdout), (2, ''))
        self.assertEqual(result.stderr, f"launch doctor: error: --root: there is no directory '{self.root / 'none'}'\n"
                                        "      = help: see 'launch doctor --help'\n")

    def test_this_machine(self):
        result = subprocess.run([LAUNCH, 'doctor', '--json'], capture_output=True, text=True, timeout=60, check=False)
        self.assertIn(result.returncode, (0, 1))
        areas = {check['area'] for check in json.loads(result.stdout)['checks']}
        self.assertEqual(areas, {'real time', 'tracing', 'limits', 'nodes'})

    def add_node(self, pid, name, library='librmw_fastrtps_cpp.so', user=1000, network='net:[1]', shared_memory='a', **variables):
        process = self.root / 'proc' / str(pid)
        (process / 'ns').mkdir(parents=True)
        (process / 'ns/net').symlink_to(network)
        (process / 'root').symlink_to(self.root / 'roots' / shared_memory)
        (self.root / 'roots' / shared_memory / 'dev/shm').mkdir(parents=True, exist_ok=True)
        libraries = ['librmw_dds_common__rosidl_typesupport_introspection_cpp.so', 'librmw_fastrtps_shared_cpp.so', library,
                     'librmw_dds_common.so', 'librmw_implementation.so']
        (process / 'maps').write_text('7f00-7f01 r-xp 00000000 08:01 12 /usr/bin/x\n' + ''.join(
            f'7f02-7f03 r-xp 0 08:01 13 /opt/ros/lib/{each}\n' for each in libraries))
        (process / 'cmdline').write_text(f'/opt/ros/lib/p/{name}\0--ros-args\0-r\0__node:={name}_node\0')
        (process / 'environ').write_text(''.join(f'{key}={value}\0' for key, value in variables.items()))
        (process / 'status').write_text(f'Name:\tx\nUid:\t{user}\t{user}\t{user}\t{user}\n')

    def test_nodes_that_hear_each_other_are_no_warning(self):
        self.add_node(12, 'talker')
        self.add_node(13, 'listener', ROS_DOMAIN_ID='')
        found = self.checks()
        self.assertEqual(found['middleware']['found'], 'rmw_fastrtps_cpp: talker_node (12), listener_node (13)')
        self.assertEqual(found['domains']['found'], '0: talker_node (12), listener_node (13)')
        self.assertEqual(found['networks']['found'], 'all are in one network and share /dev/shm')
        self.assertEqual(self.warnings(), {})

    def test_nodes_that_cannot_hear_each_other(self):
        self.add_node(12, 'talker')
        self.add_node(13, 'listener', library='librmw_zenoh_cpp.so')
        self.assertEqual(self.warnings(), {'middleware': (
            'rmw_fastrtps_cpp: talker_node (12); rmw_zenoh_cpp: listener_node (13). They do not hear each other',
            'give all nodes the same RMW_IMPLEMENTATION')})

    def test_nodes_of_two_kinds_of_dds(self):
        self.add_node(12, 'talker')
        self.add_node(13, 'listener', library='librmw_cyclonedds_cpp.so')
        self.assertEqual(self.warnings()['middleware'][0],
                         'rmw_cyclonedds_cpp: listener_node (13); rmw_fastrtps_cpp: talker_node (12). Topics pass between them, '
                         'services and the graph not always')

    def test_nodes_of_two_domains_and_of_none(self):
        self.add_node(12, 'talker', ROS_DOMAIN_ID='4')
        self.add_node(13, 'listener')
        self.add_node(14, 'map', ROS_AUTOMATIC_DISCOVERY_RANGE='OFF')
        self.assertEqual(self.warnings(), {
            'domains': ('0: listener_node (13), map_node (14); 4: talker_node (12). They do not hear each other',
                        'give the nodes that belong together the same ROS_DOMAIN_ID'),
            'discovery': ('domain 0: ROS_AUTOMATIC_DISCOVERY_RANGE=OFF: map_node (14); any other node of this machine: listener_node (13). '
                          'Whoever has OFF finds nobody', 'give all nodes the same range, SUBNET or LOCALHOST')})

    def test_each_domain_is_looked_at(self):
        for pid in (12, 13, 14):
            self.add_node(pid, 'camera', ROS_DOMAIN_ID='4')
        self.add_node(15, 'talker')
        self.assertEqual(self.checks()['users']['found'],
                         'domain 0: user 1000: talker_node (15); domain 4: user 1000: camera_node (12), camera_node (13), '
                         'camera_node (14)')
        self.add_node(16, 'listener', user=0)
        self.assertEqual(self.warnings()['users'], (
            'domain 0: user 0: listener_node (16); user 1000: talker_node (15). They cannot open each other\'s shared memory, so '
            'messages are lost', 'run them as one user, or set FASTDDS_BUILTIN_TRANSPORTS=UDPv4'))

    def test_nodes_of_two_users_and_in_a_container(self):
        self.add_node(12, 'talker')
        self.add_node(13, 'listener', user=0, shared_memory='b')
        self.assertEqual(self.warnings(), {
            'users': ('user 0: listener_node (13); user 1000: talker_node (12). They cannot open each other\'s shared memory, so '
                      'messages are lost', 'run them as one user, or set FASTDDS_BUILTIN_TRANSPORTS=UDPv4'),
            'networks': ('one network, and a /dev/shm each: ' + self.warnings()['networks'][0].split(': ', 1)[1],
                         'run containers with --ipc=host, or set FASTDDS_BUILTIN_TRANSPORTS=UDPv4')})
        self.assertIn('Nodes find each other, and their messages are lost', self.warnings()['networks'][0])

    def test_nodes_of_two_networks(self):
        self.add_node(12, 'talker')
        self.add_node(13, 'listener', network='net:[2]')
        self.assertEqual(self.warnings()['networks'],
                         ('net:[1]: talker_node (12); net:[2]: listener_node (13). Nodes of different networks find each other '
                          'only by a bridge between them',
                          'run containers with --network=host and --ipc=host, or name peers in ROS_STATIC_PEERS'))


if __name__ == '__main__':
    unittest.main()
