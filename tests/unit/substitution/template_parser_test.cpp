// SPDX-License-Identifier: Apache-2.0
#include "launcher/substitution/template_parser.hpp"

#include <gtest/gtest.h>

#include "tests/unit/substitution/template_test.hpp"

namespace launch {
namespace {

struct Vector {
  const char* text;
  const char* result;
};

class TemplateText : public testing::TestWithParam<Vector> {};

TEST_P(TemplateText, IsPerformed) {
  EXPECT_EQ(perform(GetParam().text), GetParam().result);
}

INSTANTIATE_TEST_SUITE_P(Reference, TemplateText,
                         testing::Values(Vector{R"(a\b \\ \$(var x) $$(var x) $5)", R"(ab \ $(var x) $7 $5)"},
                                         Vector{R"(\\$(var x))", R"(\$(var x))"}, Vector{"$(var $(var which))", "7"},
                                         Vector{R"($(var y 'pre $(var x) "q" post'))", R"(pre 7 "q" post)"},
                                         Vector{R"($(var y a\(b\)c))", "a(b)c"}, Vector{R"($(var y 'it\'s'))", "it's"},
                                         Vector{R"($(var y 'a $(var z "i") b'))", R"(a "i" b)"},
                                         Vector{"$(var y $(var z 'two words'))", "two words"},
                                         Vector{"$(env E '')", ""}, Vector{"$(equals 1 TRUE)", "true"},
                                         Vector{"$(equals 1e3 1000)", "true"}, Vector{"$(equals a A)", "false"},
                                         Vector{"$(not yes)", "false"}, Vector{"$(and true 0)", "false"},
                                         Vector{"$(or off 1)", "true"}));

INSTANTIATE_TEST_SUITE_P(
    Grammar, TemplateText,
    testing::Values(Vector{"", ""}, Vector{"plain 'quotes' \"stay\" (here)", "plain 'quotes' \"stay\" (here)"},
                    Vector{"C:\\dir", "C:dir"}, Vector{"end\\", "end\\"}, Vector{"a\\\nb", "a\\\nb"},
                    Vector{"a)b$", "a)b$"}, Vector{"$(var x)$(var x)-$(var x)", "77-7"}, Vector{"$(var y \"\")", ""},
                    Vector{"$(var y \"a'b\")", "a'b"}, Vector{"$(var y a\tb)", "a\tb"}, Vector{"$(var y a$b$)", "a$b$"},
                    Vector{"$(var y pre$(var x)post)", "pre7post"}, Vector{"$(var y \"$(var z 'a')\")", "'a'"},
                    Vector{R"($(var y '$(var z a\'b)'))", "a'b"}, Vector{R"($(var y '\$(var x)'))", "$(var x)"},
                    Vector{R"($(var y \$\(var\)))", "$(var)"}, Vector{"$(if true $(var x) $(var missing))", "7"},
                    Vector{"$(if false $(var missing) $(var x))", "7"}, Vector{"$(if off a)", ""}));

TEST(Template, PerformsResultsWithoutScanningThemAgain) {
  Scope scope = test_scope();
  scope.configurations["text"] = "$(var x) \\n";
  EXPECT_EQ(parse_template(located("$(var text)")).perform(scope), "$(var x) \\n");
}

TEST(Template, IsLiteralWithoutSubstitutions) {
  EXPECT_TRUE(parse_template(located("")).is_literal());
  EXPECT_TRUE(parse_template(located("a \\$(var x)")).is_literal());
  EXPECT_FALSE(parse_template(located("a $(var x)")).is_literal());
  EXPECT_TRUE(parse_template(located("")).empty());
}

TEST(Template, PartsKnowTheirPlace) {
  const Template parsed = parse_template(located("ab$(var x)$(env HOME)"));
  ASSERT_EQ(parsed.parts().size(), 3U);
  EXPECT_EQ(to_string(parsed.parts()[0]->where()), "t:1:1");
  EXPECT_EQ(to_string(parsed.parts()[1]->where()), "t:1:3");
  EXPECT_EQ(parsed.parts()[1]->where().end, 10U);
  EXPECT_EQ(to_string(parsed.parts()[2]->where()), "t:1:11");
}

TEST(Unescape, DropsEachBackslashThatProtectsACharacter) {
  EXPECT_EQ(unescape(R"(a\b\\c\$(var x))"), R"(ab\c$(var x))");
  EXPECT_EQ(unescape("a\\\nb\\"), "a\\\nb\\");
}

struct Fault {
  const char* text;
  const char* rendered;
};

class TemplateFault : public testing::TestWithParam<Fault> {};

TEST_P(TemplateFault, IsReportedAtItsPlace) {
  std::string expected = GetParam().rendered;
  EXPECT_EQ(parse_error(GetParam().text), expected);
}

INSTANTIATE_TEST_SUITE_P(
    Syntax, TemplateFault,
    testing::Values(Fault{"$(var  x)",
                          "t:1:6: error: two spaces between the arguments of a substitution\n"
                          "    1 | $(var  x)\n"
                          "      |      ^~\n"
                          "      = help: separate them by one space; '' is an empty argument\n"},
                    Fault{"$( var x)",
                          "t:1:3: error: space after '$('\n"
                          "    1 | $( var x)\n"
                          "      |   ^\n"
                          "      = help: write the name directly after '$('\n"},
                    Fault{"$(var x )",
                          "t:1:8: error: space before ')'\n"
                          "    1 | $(var x )\n"
                          "      |        ^\n"
                          "      = help: remove the space; '' is an empty argument\n"},
                    Fault{"a $() b",
                          "t:1:3: error: empty substitution '$()'\n"
                          "    1 | a $() b\n"
                          "      |   ^~~\n"
                          "      = help: write \\$( for the characters themselves\n"},
                    Fault{"$(var 'x'y)",
                          "t:1:10: error: text directly after a quoted argument\n"
                          "    1 | $(var 'x'y)\n"
                          "      |          ^\n"
                          "      = help: put the whole argument inside the quotes\n"},
                    Fault{"$(var y a(b)c)",
                          "t:1:10: error: '(' inside an argument\n"
                          "    1 | $(var y a(b)c)\n"
                          "      |          ^\n"
                          "      = help: quote the argument, or write \\(\n"},
                    Fault{"$(var y a'b')",
                          "t:1:10: error: quote ' in the middle of an argument\n"
                          "    1 | $(var y a'b')\n"
                          "      |          ^\n"
                          "      = help: quote the whole argument, or write \\'\n"},
                    Fault{"see $(var x",
                          "t:1:5: error: the substitution '$(var' is not closed\n"
                          "    1 | see $(var x\n"
                          "      |     ^~~~~\n"
                          "      = help: add ')' at its end\n"},
                    Fault{"$(var y 'a b)",
                          "t:1:9: error: the argument that starts with ' is not closed\n"
                          "    1 | $(var y 'a b)\n"
                          "      |         ^\n"
                          "      = help: add ' at its end\n"},
                    Fault{"cost $(5)",
                          "t:1:8: error: the name of a substitution can't start with '5'\n"
                          "    1 | cost $(5)\n"
                          "      |        ^\n"
                          "      = help: write \\$( for the characters themselves\n"},
                    Fault{"$(var.x)",
                          "t:1:6: error: unexpected '.' in the name of a substitution\n"
                          "    1 | $(var.x)\n"
                          "      |      ^\n"
                          "      = help: one space separates the name from its arguments: $(var ...)\n"}));

INSTANTIATE_TEST_SUITE_P(
    Names, TemplateFault,
    testing::Values(
        Fault{"$(find-pkg-shar demo)",
              "t:1:3: error: unknown substitution 'find-pkg-shar'\n"
              "    1 | $(find-pkg-shar demo)\n"
              "      |   ^~~~~~~~~~~~~\n"
              "      = help: did you mean 'find-pkg-share'?\n"},
        Fault{"$(arg x)",
              "t:1:3: error: unknown substitution 'arg'\n"
              "    1 | $(arg x)\n"
              "      |   ^~~\n"
              "      = help: in ROS 2 it is $(var NAME)\n"},
        Fault{"$(xyzzy)",
              "t:1:3: error: unknown substitution 'xyzzy'\n"
              "    1 | $(xyzzy)\n"
              "      |   ^~~~~\n"},
        Fault{"$(eval 1 + 2)",
              "t:1:1: error: substitution 'eval' takes 1 or 2 arguments, got 3\n"
              "    1 | $(eval 1 + 2)\n"
              "      | ^~~~~~~~~~~~~\n"
              "      = help: usage: $(eval 'EXPRESSION' ['MODULE, ...']); quote an argument that has spaces\n"},
        Fault{"$(var)",
              "t:1:1: error: substitution 'var' takes 1 or 2 arguments, got 0\n"
              "    1 | $(var)\n"
              "      | ^~~~~~\n"
              "      = help: usage: $(var NAME [DEFAULT])\n"},
        Fault{"$(dirname x)",
              "t:1:1: error: substitution 'dirname' takes no arguments, got 1\n"
              "    1 | $(dirname x)\n"
              "      | ^~~~~~~~~~~~\n"
              "      = help: usage: $(dirname)\n"},
        Fault{"$(var x my default)",
              "t:1:1: error: substitution 'var' takes 1 or 2 arguments, got 3\n"
              "    1 | $(var x my default)\n"
              "      | ^~~~~~~~~~~~~~~~~~~\n"
              "      = help: usage: $(var NAME [DEFAULT]); quote an argument that has spaces\n"},
        Fault{"$(string-join)",
              "t:1:1: error: substitution 'string-join' takes at least 2 arguments, got 0\n"
              "    1 | $(string-join)\n"
              "      | ^~~~~~~~~~~~~~\n"
              "      = help: usage: $(string-join SEPARATOR A...)\n"}));

TEST(TemplateParser, RefusesWhatTheReferenceRefuses) {
  for (const char* text :
       {"$(eval 1 + 2)", "$(var \\$(var x))", "$(var 'a' 'b", "$(", "$(var", "$(var ", "$(var \"x\"'y')", "$(var x)$(",
        "$(not)", "$(not a b)", "$(and a)", "$(if a)", "$(if a b c d)", "$(equals a)"}) {
    EXPECT_NE(parse_error(text), "") << text;
  }
}

TEST(TemplateParser, LimitsNestingInsteadOfExhaustingTheStack) {
  std::string text;
  for (int i = 0; i < 100'000; ++i) {
    text += "$(var ";
  }
  EXPECT_NE(parse_error(text).find("substitutions are nested more than 200 levels deep"), std::string::npos);
}

TEST(TemplateParser, PointsIntoDecodedText) {
  // <let value="&quot;$(vra x)"/>: the entity takes six bytes of the file and one of the text.
  const auto file = std::make_shared<const SourceFile>("f.xml", "v=\"&quot;$(vra x)\"");
  LocatedText text({}, {file, 3, 3});
  text.append("\"", 3, 9);
  text.append("$(vra x)", 9, 17);
  try {
    parse_template(text);
    FAIL() << "no error";
  } catch (const LaunchError& error) {
    EXPECT_STREQ(error.what(),
                 "f.xml:1:12: error: unknown substitution 'vra'\n"
                 "    1 | v=\"&quot;$(vra x)\"\n"
                 "      |            ^~~\n"
                 "      = help: did you mean 'var'?");
  }
}

}  // namespace
}  // namespace launch
