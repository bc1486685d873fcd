// SPDX-License-Identifier: Apache-2.0
// Launch files written anew in the form of the documentation.
#include <gtest/gtest.h>

#include "actions/builtin_actions.hpp"
#include "base/diagnostics/diagnostic.hpp"
#include "programs/launch/rewrite/formatted.hpp"

namespace launch {
namespace {

std::string format(const std::string& text) {
  static const Registry registry = builtin_actions();
  const std::string once = formatted(std::make_shared<SourceFile>("a", text), registry);
  EXPECT_EQ(formatted(std::make_shared<SourceFile>("a", once), registry), once) << "a second time gives another text";
  return once;
}

TEST(Format, WritesXmlAsTheDocumentationDoes) {
  EXPECT_EQ(format("<?xml version=\"1.0\"?>\n\n\n\n<launch>\n\n"
                   "<arg default='1'   name = \"x\" ></arg>\n\n\n"
                   "\t<!-- two\n\t     lines -->\n"
                   "      <node exec='talker' if=\"$(var x)\" pkg='a' name='say \"n\"'><param value='1' name='p' /> "
                   "<!-- why -->\n"
                   "  </node></launch>\n\n"),
            "<?xml version=\"1.0\"?>\n"
            "\n"
            "<launch>\n"
            "  <arg name=\"x\" default=\"1\"/>\n"
            "\n"
            "  <!-- two\n"
            "       lines -->\n"
            "  <node pkg=\"a\" exec=\"talker\" name='say \"n\"' if=\"$(var x)\">\n"
            "    <param name=\"p\" value=\"1\"/> <!-- why -->\n"
            "  </node>\n"
            "</launch>\n");
}

TEST(Format, BreaksLongTagsOfXmlBelowTheFirstAttribute) {
  const std::string word(60, 'w');
  EXPECT_EQ(format("<launch><executable cmd=\"" + word + "\" name=\"" + word + "\" output=\"screen\"/></launch>"),
            "<launch>\n"
            "  <executable cmd=\"" +
                word +
                "\"\n"
                "              name=\"" +
                word +
                "\" output=\"screen\"/>\n"
                "</launch>\n");
}

TEST(Format, KeepsLineEndsWithinValuesAndOfTheFile) {
  EXPECT_EQ(format("<launch>\r\n<executable cmd=\"a\r\n   b\"/>\r\n</launch>"),
            "<launch>\r\n  <executable cmd=\"a\r\n   b\"/>\r\n</launch>\r\n");
}

TEST(Format, WritesCommasAtTheEndOfAListOfYamlInOneWay) {
  const std::string once = format("launch:\n- arg: {name: x,}\n- let: {name: a, value: b, }\n");
  EXPECT_NE(once.find("{name: x,}"), std::string::npos) << once;
  EXPECT_NE(once.find("{name: a, value: b,}"), std::string::npos) << once;
}

TEST(Format, WritesYamlAsTheDocumentationDoes) {
  EXPECT_EQ(format("# the file\n"
                   "launch:\n"
                   "\n\n"
                   "    # an argument\n"
                   "    -   arg :   {name:   x,default: '1' }   \n"
                   "    - node:\n"
                   "            pkg: a   # the package\n"
                   "            exec:    \"t\"\n"
                   "            param:\n"
                   "                - name: p\n"
                   "                  value: [1,2 , 'a  b']\n"
                   "            # between\n"
                   "            args: >\n"
                   "               one\n"
                   "\n"
                   "               two # no comment\n"
                   "    - group:\n"
                   "        - log: {message: a, level: INFO}\n"),
            "# the file\n"
            "launch:\n"
            "\n"
            "# an argument\n"
            "- arg: {name: x, default: '1'}\n"
            "- node:\n"
            "    pkg: a   # the package\n"
            "    exec: \"t\"\n"
            "    param:\n"
            "    - name: p\n"
            "      value: [1, 2, 'a  b']\n"
            "    # between\n"
            "    args: >\n"
            "       one\n"
            "\n"
            "       two # no comment\n"
            "- group:\n"
            "  - log: {message: a, level: INFO}\n");
}

TEST(Format, NamesAFormThatItDoesNotKnow) {
  try {
    format("launch:\n-\n  log: {message: a, level: INFO}\n");
    FAIL();
  } catch (const LaunchError& error) {
    EXPECT_EQ(error.diagnostics().front().message, "this form is not formatted");
    EXPECT_EQ(error.diagnostics().front().where.file->position(error.diagnostics().front().where.begin).line, 3U);
  }
}

}  // namespace
}  // namespace launch
