# SPDX-License-Identifier: Apache-2.0
"""
Each public header of the stack compiles alone, in the standard of C++ that packages of ROS 2 use, and brings what
programs that include it alone use of it.
"""

import concurrent.futures
import json
import os
import re
import shlex
import subprocess
import unittest
from pathlib import Path

SOURCE = Path(os.environ['SOURCE_DIRECTORY'])
BUILD = Path(os.environ['BUILD_DIRECTORY'])
ALONE = BUILD / 'tests' / 'unit' / 'stack_headers' / 'alone'
PACKAGES = ('rclcpp', 'rclcpp_action', 'rclcpp_lifecycle', 'rclcpp_components', 'rcl', 'rcl_action', 'rcl_lifecycle', 'rmw',
            'rcutils', 'rcpputils', 'tracetools', 'class_loader', 'pluginlib', 'ament_index_cpp')

# What a header must bring: names that programs use after including it alone.
USES = {
    'rclcpp/rclcpp.hpp': '''
        rclcpp::executors::SingleThreadedExecutor a; rclcpp::executors::MultiThreadedExecutor b;
        rclcpp::experimental::executors::EventsExecutor c; rclcpp::executors::EventsCBGExecutor d;
        rclcpp::Rate rate(1.0); rclcpp::WaitSet wait_set; rclcpp::Serialization<rcl_interfaces::msg::Parameter>* s = nullptr; (void)s;
        auto copy = [](auto& x, auto& y) { rclcpp::copy_all_parameter_values(x, y); }; (void)copy;
        rclcpp::ParameterEventHandler* handler = nullptr; (void)handler;
        std::this_thread::sleep_for(std::chrono::seconds(0)); std::mutex mutex; std::map<int, std::vector<std::string>> map;
        std::queue<int> queue; std::cout << std::setprecision(3); (void)std::getenv("A"); RCPPUTILS_SCOPE_EXIT({});
        rcpputils::SharedLibrary* library = nullptr; (void)library; (void)rcpputils::join(std::vector<std::string>{}, ",");
        (void)RCL_DEFAULT_DOMAIN_ID; rcutils_ret_t ret = RCUTILS_RET_OK; (void)ret;''',
    'rclcpp/context.hpp': 'rcl_guard_condition_options_t options; rcl_wait_set_t wait_set;',
    'rclcpp/executors.hpp': '''
        rclcpp::experimental::executors::EventsExecutor executor; std::promise<void> promise;
        rclcpp::Node::SharedPtr node; rclcpp::ok(); rclcpp::WaitSet wait_set;
        (void)rclcpp::spin_until_future_complete(node, promise.get_future());''',
    'rclcpp/node.hpp': '''
        rclcpp::Rate rate(1.0); RCLCPP_INFO(rclcpp::get_logger("a"), "text"); std::unordered_set<int> set;
        (void)rclcpp::expand_topic_or_service_name("a", "b", "/"); rclcpp::SerializationBase* base = nullptr; (void)base;
        std::thread thread; std::vector<int> v{2, 1}; std::sort(v.begin(), v.end());''',
    'rclcpp/publisher.hpp': '''
        rclcpp::Time time; (void)rclcpp::ok(); std::future<int> future; std::map<int, int> map;
        rclcpp::SerializationBase* base = nullptr; (void)base;''',
    'rclcpp/subscription.hpp': '''
        rclcpp::Time time; RCLCPP_INFO(rclcpp::get_logger("a"), "text"); std::stringstream text;
        rclcpp::ContentFilterOptions filter; rclcpp::topic_statistics::SubscriptionTopicStatistics* s = nullptr; (void)s;''',
    'rclcpp/client.hpp': '''
        rclcpp::Clock clock; rclcpp::Time time; (void)rclcpp::ok(); std::unordered_map<int, int> map;
        try { } catch (const rclcpp::exceptions::RCLError&) { }''',
    'rclcpp/service.hpp': '''
        rclcpp::Clock clock; RCLCPP_INFO(rclcpp::get_logger("a"), "text"); throw std::runtime_error("text");''',
    'rclcpp/timer.hpp': 'rclcpp::Rate rate(1.0); (void)rclcpp::ok(); std::thread thread;',
    'rclcpp/qos.hpp': 'throw std::invalid_argument("text"); std::vector<std::string> names;',
    'rclcpp/exceptions.hpp': 'std::stringstream text; throw std::runtime_error("text");',
    'rclcpp/create_timer.hpp': '''
        rclcpp::node_interfaces::NodeBaseInterface::SharedPtr base;
        (void)rclcpp::node_interfaces::get_node_base_interface(base);''',
    'rclcpp/network_flow_endpoint.hpp': '(void)rcl_get_zero_initialized_network_flow_endpoint_array();',
    'rclcpp_action/rclcpp_action.hpp': 'rclcpp::Node node("a"); (void)node.create_wall_timer(std::chrono::seconds(1), [] {});',
    'sensor_msgs/image_encodings.hpp': 'throw std::runtime_error("text");',
}


def include_directories():
    """Those of the stack and of its messages, of all commands of the build."""
    found = {}
    for command in json.loads((BUILD / 'compile_commands.json').read_text(encoding='utf-8')):
        for word in re.findall(r'-I(\S*/instrumented_stack/\S*include)(?=\s)', command['command']):
            found[word] = None
    return list(found)


def headers(package):
    root = SOURCE / 'instrumented_stack' / package / 'include'
    return sorted(str(path.relative_to(root)) for path in root.rglob('*.h*') if '/detail/' not in str(path))


class PublicHeaders(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        cls.flags = [f'-I{folder}' for folder in include_directories()]
        ALONE.mkdir(parents=True, exist_ok=True)

    # Objects in files, because ccache keeps them: a header costs seconds when something in it has changed, else nothing.
    def compile(self, header, use='', compiler='CXX'):
        ending, standard = ('cpp', '-std=c++17') if compiler == 'CXX' else ('c', '-std=c11')
        source = ALONE / (re.sub(r'\W', '_', header) + ('_use.' if use else '.') + ending)
        text = f'#include "{header}"\n' + (f'void use() {{\n{use}\n}}\n' if use else '')
        if not source.exists() or source.read_text(encoding='utf-8') != text:
            source.write_text(text, encoding='utf-8')
        run = subprocess.run([*shlex.split(os.environ[compiler]), standard, '-O0', '-Wall', '-Wno-unused', *self.flags, '-MD',
                              '-c', source, '-o', f'{source}.o'], stderr=subprocess.PIPE, text=True, check=False)
        return f'{header} ({compiler}):\n{run.stderr}' if run.returncode else ''

    def compile_all(self, works):
        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            errors = list(pool.map(lambda work: self.compile(*work), works))
        self.assertEqual('', '\n'.join(error for error in errors if error))

    def test_each_compiles_alone(self):
        works = [(header,) for package in PACKAGES for header in headers(package) if header not in USES]
        self.assertGreater(len(works), 250)
        self.compile_all(works)

    def test_those_in_c_compile_as_c(self):
        self.compile_all([(header, '', 'CC') for package in PACKAGES for header in headers(package) if header.endswith('.h')])

    def test_each_brings_what_programs_use(self):
        self.compile_all(list(USES.items()))


if __name__ == '__main__':
    unittest.main()
