// SPDX-License-Identifier: Apache-2.0
// How the text of a parameter becomes a typed value.
#include <gtest/gtest.h>

#include "tests/unit/actions/launch_text.hpp"

namespace {

using test_support::Planned;

struct Row {
  std::string attributes;  // of <param name="p" …>
  std::string expected;    // YAML of the value, or "load-error"/"visit-error"
};

void PrintTo(const Row& row, std::ostream* out) {
  *out << row.attributes;
}

std::string outcome(const std::string& text) {
  const test_support::PlanOptions options{.arguments = {{"x", "7"}, {"sp", "a b"}, {"l", "[1, 2]"}, {"t", "true"}}};
  const Planned planned = test_support::plan_text(text, options);
  if (!planned.error.empty()) {
    return planned.messages.empty() ? "load-error" : "visit-error";
  }
  const std::string& content = planned.plan.processes.at(0).files.at(0).content;
  const std::string start = "/**:\n  ros__parameters:\n    p: ";
  EXPECT_EQ(content.substr(0, start.size()), start);
  return content.substr(start.size(), content.size() - start.size() - 1);
}

class XmlParameter : public testing::TestWithParam<Row> {};

TEST_P(XmlParameter, IsTypedAsRos2Does) {
  // The message shows whether the error is of the visit or of loading, which prints nothing.
  EXPECT_EQ(outcome("<launch><log message=\"visited\"/><node exec=\"n\"><param name=\"p\" " + GetParam().attributes +
                    "/></node></launch>"),
            GetParam().expected)
      << GetParam().attributes;
}

INSTANTIATE_TEST_SUITE_P(
    Untyped, XmlParameter,
    testing::Values(
        Row{"value='1'", "1"}, Row{"value='01'", "1"}, Row{"value='0x1F'", "31"}, Row{"value='1_000'", "1000"},
        Row{"value='1:30'", "90"}, Row{"value='1.'", "1.0"}, Row{"value='.5'", "0.5"}, Row{"value='1.0e+3'", "1000.0"},
        Row{"value='.inf'", ".inf"}, Row{"value='1e3'", "\"1e3\""}, Row{"value='1.0e3'", "\"1.0e3\""},
        Row{"value='0o17'", "\"0o17\""}, Row{"value='inf'", "\"inf\""}, Row{"value='y'", "\"y\""},
        Row{"value='08'", "\"08\""}, Row{"value='yes'", "true"}, Row{"value='On'", "true"}, Row{"value='TRUE'", "true"},
        Row{"value=''", "\"\""}, Row{"value='null'", "load-error"}, Row{"value='~'", "load-error"},
        Row{"value='2024-01-01'", "load-error"}, Row{"value='{a: 1}'", "load-error"}, Row{"value='a: b'", "load-error"},
        Row{"value='[1, 2.5]'", "load-error"}, Row{"value='[[1],[2]]'", "load-error"}, Row{"value='# x'", "load-error"},
        Row{"value='[1, 2]'", "[1, 2]"}, Row{"value='- 1'", "[1]"}, Row{"value='[]'", "[]"},
        Row{"value='[1, a]'", "load-error"}, Row{"value='[$(var x), a]'", "visit-error"},
        Row{"value='1,2,3' value-sep=','", "[1, 2, 3]"}, Row{"value=\"'1';'2'\" value-sep=';'", "[\"1\", \"2\"]"},
        Row{"value='a, b' value-sep=','", "[\"a\", \"b\"]"}, Row{"value='$(var x)'", "7"},
        Row{"value=\"'$(var x)'\"", "7"}, Row{"value=\"\\'$(var x)\\'\"", "\"7\""}, Row{"value='$(var x)s'", "\"7s\""},
        Row{"value='@x'", "\"@x\""}, Row{"value='*x'", "\"*x\""}, Row{"value='a # b'", "\"a\""},
        Row{"value='$(var l)'", "[1, 2]"}, Row{"value='say &quot;hi&quot; \\\\now'", "\"say \\\"hi\\\" \\\\now\""}));

INSTANTIATE_TEST_SUITE_P(
    Typed, XmlParameter,
    testing::Values(Row{"value='1' type='str'", "\"1\""}, Row{"value='$(var x)' type='str'", "\"7\""},
                    Row{"value='1_000' type='int'", "1000"}, Row{"value='0x1F' type='int'", "load-error"},
                    Row{"value='7.0' type='int'", "load-error"}, Row{"value='$(var sp)' type='int'", "visit-error"},
                    Row{"value='1e3' type='float'", "1000.0"}, Row{"value='7' type='float'", "7.0"},
                    Row{"value='1' type='bool'", "true"}, Row{"value='$(var t)' type='bool'", "true"},
                    Row{"value='maybe' type='bool'", "load-error"}, Row{"value='[1, 2]' type='list_of_int'", "[1, 2]"},
                    Row{"value='[1, 2]' type='list_of_float'", "load-error"},
                    Row{"value='[$(var x), 2]' type='list_of_int'", "[7, 2]"},
                    Row{"value='$(var l)' type='list_of_int'", "load-error"},
                    Row{"value='a, b' value-sep=',' type='list_of_str'", "[\"a\", \" b\"]"},
                    Row{"value='a,b' value-sep=',' type='str'", "load-error"}, Row{"value='5' type='yaml'", "5"}));

class YamlParameter : public testing::TestWithParam<Row> {};

TEST_P(YamlParameter, KeepsTheTypesOfTheFile) {
  EXPECT_EQ(outcome("launch:\n- log: {message: visited}\n- node: {exec: n, param: [{name: p, " + GetParam().attributes +
                    "}]}\n"),
            GetParam().expected)
      << GetParam().attributes;
}

INSTANTIATE_TEST_SUITE_P(Vectors, YamlParameter,
                         testing::Values(Row{"value: 1", "1"}, Row{"value: '1'", "\"1\""}, Row{"value: 010", "8"},
                                         Row{"value: yes", "true"}, Row{"value: [1, 2]", "[1, 2]"},
                                         Row{"value: [a, b]", "[\"a\", \"b\"]"}, Row{"value: [1, a]", "load-error"},
                                         Row{"value: $(var x)", "7"}, Row{"value: \"'$(var x)'\"", "\"7\""},
                                         Row{"value: $(var x), type: str", "\"7\""},
                                         Row{"value: 1.5, type: float", "1.5"},
                                         Row{"value: 1, type: float", "load-error"}, Row{"value: ~", "load-error"}));

}  // namespace
