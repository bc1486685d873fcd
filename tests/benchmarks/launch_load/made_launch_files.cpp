// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/launch_load/made_launch_files.hpp"

#include <fmt/format.h>

#include <fstream>

namespace bench {

std::string nodes_as_xml(int count) {
  std::string text = "<launch>\n<arg name=\"robot\" default=\"r1\"/>\n";
  for (int i = 0; i < count; ++i) {
    text += fmt::format(R"xml(  <node exec="/bin/true" name="node_{0}" namespace="group_{1}">
    <param name="rate" value="{0}"/>
    <param name="label" value="$(var robot) number {0}"/>
    <param name="gains" value="[1.0, 2.5]"/>
    <remap from="chatter" to="/out_{0}"/>
    <remap from="in" to="$(var robot)/in"/>
  </node>
)xml",
                        i, i % 10);
  }
  return text + "</launch>\n";
}

std::string nodes_as_yaml(int count) {
  std::string text = "launch:\n- arg: {name: robot, default: r1}\n";
  for (int i = 0; i < count; ++i) {
    text += fmt::format(R"yaml(- node:
    exec: /bin/true
    name: node_{0}
    namespace: group_{1}
    param:
    - name: rate
      value: {0}
    - name: label
      value: $(var robot) number {0}
    - name: gains
      value: [1.0, 2.5]
    remap:
    - from: chatter
      to: /out_{0}
    - from: in
      to: $(var robot)/in
)yaml",
                        i, i % 10);
  }
  return text;
}

std::string write_include_chain(const std::string& directory, int depth) {
  const auto path = [&](int level) { return fmt::format("{}/level_{}.launch.xml", directory, level); };
  for (int level = 0; level < depth; ++level) {
    std::ofstream file(path(level));
    file << "<launch>\n  <arg name=\"level\" default=\"outermost\"/>\n";
    if (level + 1 < depth) {
      file << fmt::format(
          "  <include file=\"$(dirname)/level_{0}.launch.xml\">\n    <arg name=\"level\" value=\"{0}\"/>\n  "
          "</include>\n",
          level + 1);
    } else {
      file << "  <node exec=\"/bin/true\" name=\"innermost_$(var level)\"/>\n";
    }
    file << "</launch>\n";
  }
  return path(0);
}

}  // namespace bench
