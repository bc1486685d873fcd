// SPDX-License-Identifier: Apache-2.0
// The launcher reads a parameter file as a node does, though they do not share a parser: what one refuses the other
// refuses, and the values are equal.
#include <gmock/gmock.h>

#include <map>
#include <stdexcept>

#include "actions/parameters/parameter_reader.hpp"
#include "launcher/language/parameter_value.hpp"
#include "rcl_yaml_param_parser/read_yaml.hpp"

namespace {

using Values = std::map<std::string, std::string>;

struct ToText {
  std::string operator()(bool value) const { return launch::to_yaml(launch::ParameterScalar(value)); }
  std::string operator()(std::int64_t value) const { return launch::to_yaml(launch::ParameterScalar(value)); }
  std::string operator()(double value) const { return launch::to_yaml(launch::ParameterScalar(value)); }
  std::string operator()(const std::string& value) const { return launch::to_yaml(launch::ParameterScalar(value)); }
  std::string operator()(std::uint8_t value) const {
    return launch::to_yaml(launch::ParameterScalar(std::byte{value}));
  }
  template <typename Item>
  std::string operator()(const std::vector<Item>& list) const {
    std::string text;
    for (const Item& item : list) {
      text += (text.empty() ? "" : ", ") + (*this)(item);
    }
    return "[" + text + "]";
  }
};

class Sink : public rcl_yaml::ParameterSink {
 public:
  void add_node(const std::string& node) override { node_ = node; }
  void add_parameter(const std::string& name, std::optional<rcl_yaml::ParameterValue> value,
                     const std::string& /*place*/) override {
    values[node_ + " " + name] = value ? std::visit(ToText(), *value) : "[]";
  }
  Values values;

 private:
  std::string node_;
};

// Nothing when the file is refused.
std::optional<Values> as_node(const std::string& text) {
  try {
    Sink sink;
    rcl_yaml::read_parameters(text, "p.yaml", sink);
    return sink.values;
  } catch (const std::invalid_argument&) {
    return std::nullopt;
  }
}

std::optional<Values> as_launcher(const std::string& text) {
  const auto file = std::make_shared<const launch::SourceFile>("/p.yaml", text);
  const launch::ParameterSections found =
      launch::read_parameter_sections(launch::LocatedText(text, {file, 0, static_cast<std::uint32_t>(text.size())}));
  if (found.no_yaml || found.node_refuses) {
    return std::nullopt;
  }
  Values values;
  for (const launch::ParameterSection& section : found.sections) {
    if (!section.errors.empty() || !section.node_errors.empty()) {
      return std::nullopt;
    }
    for (const launch::FileParameter& parameter : section.parameters) {
      values[section.pattern + " " + parameter.name] = launch::to_yaml(parameter.value);
    }
  }
  return values;
}

class ParameterAgreement : public testing::TestWithParam<const char*> {};

TEST_P(ParameterAgreement, OfAFile) {
  EXPECT_EQ(as_launcher(GetParam()), as_node(GetParam()));
}

INSTANTIATE_TEST_SUITE_P(
    Structure, ParameterAgreement,
    testing::Values("", "# nothing", "a: {ros__parameters: {}}", "a:\n  ros__parameters:\n", "a:\n", "- a", "text",
                    "a: {b: 1}", "ros__parameters: {a: 1}", "/**:\n  ros__parameters: {a: 1}\n",
                    "/a:\n  b: {ros__parameters: {c: 1}}\n  ros__parameters: {d: 2}\n",
                    "a: {ros__parameters: {x: 1}}\na: {ros__parameters: {y: 2, x: 3}}",
                    "my-node: {ros__parameters: {}}", "/a//b: {ros__parameters: {}}", "/*/b: {ros__parameters: {a: 1}}",
                    "/a*: {ros__parameters: {}}", "a: {ros__parameters: {x: {y: {z: 1}}, x.y.z: 2}}",
                    "a: {ros__parameters: {\"\": 1}}",
                    "a: {ros__parameters: {x: 1}}\n---\nb: {ros__parameters: {y: 1}}",
                    "a: &x {ros__parameters: {}}\nb: *x", "a: {ros__parameters: 1}", "a: {ros__parameters: [1]}",
                    "a: {ros__parameters: {x: 1}", "a:\n\tros__parameters: {}",
                    "a: {ros__parameters: {1: 2, true: 3, ~: 4, null: 5}}",
                    "%YAML 1.1\n---\na: {ros__parameters: {x: 1}}"));
INSTANTIATE_TEST_SUITE_P(
    Values, ParameterAgreement,
    testing::ValuesIn(std::vector<const char*>{
        "a: {ros__parameters: {a: nan, b: inf, c: .nan, d: 5e-06, e: 1.0e+20, g: 0x1F, h: 010, i: 1_000, j: 1e3, k: "
        "y}}",
        "a: {ros__parameters: {l: \"on\", m: -.inf, n: 1:30, o: 2026-01-01, p: !!str 5, q: !!float 3, r: '', s: ~}}",
        "a: {ros__parameters: {t: null, u: +1, v: 1., w: .5, x: 08, y: 0b1, z: 0o7, aa: 9223372036854775808, ab: -0}}",
        "a: {ros__parameters: {a: [1.0e-5, 2e-5], b: [!!float 1, 2.5], c: [], d: [a, '1'], e: [on, off]}}",
        "a: {ros__parameters: {a: [1, 2.5]}}",
        "a: {ros__parameters: {a: [x, y]}}",
        "a: {ros__parameters: {a: [[1]]}}",
        "a: {ros__parameters: {a: [{b: 1}]}}",
        "a: {ros__parameters: {a: }}",
        "a: {ros__parameters: {a: [1, ~]}}",
        "a:\n  ros__parameters:\n    b:\n    null: 1\n",
        "a:\n  ros__parameters:\n    b:\n",
        "a: {ros__parameters: {a: !!int abc}}",
        "a: {ros__parameters: {a: !!bool 1}}",
        "a: {ros__parameters: {a: !foo 1}}",
        "a: {ros__parameters: {a: ! 5, b: ! '5'}}",
        "a: {ros__parameters: {a: !!str }}",
        "a: {ros__parameters: {a: !!binary AQID, b: [!!binary AQ==, !!binary Aw==]}}",
        "a: {ros__parameters: {a: !!binary A}}",
        "a: {ros__parameters: {a: !!map [1]}}",
        "a: {ros__parameters: {a: !!seq [1], b: !!map {c: 1}}}",
        "a: {ros__parameters: {a: !!seq {b: 1}}}",
        "a: {ros__parameters: {a: !!null ''}}",
        "a: {ros__parameters: {a: &x 1, b: &y [1]}}",
        "a: {ros__parameters: {a: &x 1, b: *x}}",
        "a:\n  ros__parameters:\n    b: |\n      5\n    c: >-\n      true\n    d: |-\n      7\n    e: \"a\\tb\"\n",
        "a:\n  ros__parameters:\n    b: two\n      lines\n    c: 'it''s'  # not \"this\"\n    d: a#b\n",
        "a:\n  ros__parameters:\n  - b\n",
        "a: {ros__parameters: {b: @x}}",
        "a: {ros__parameters: {b: http://x:1/y}}",
        "a:\n  ros__parameters:\n    b: [1,\n      2]\n    c:\n    - 1\n    - 2\n",
        "a: {ros__parameters: {b: 'x}}",
        "a:\n  ros__parameters:\n    b: c: d\n",
        "a:\n  ros__parameters:\n    b\n    c: 1\n",
        "a:\n  ros__parameters:\n    b: 1\n    c\n",
        "a:\n  ros__parameters:\n    b: \"x\n"}));

}  // namespace
