// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "tests/unit/substitution/template_test.hpp"

namespace launch {
namespace {

std::vector<std::string> split(const std::string& text) {
  Scope scope = test_scope();
  std::vector<std::string> words;
  for (const Template& word : split_command_line(parse_template(located(text)))) {
    words.push_back(word.perform(scope));
  }
  return words;
}

using Words = std::vector<std::string>;

TEST(CommandLine, NeverSplitsTheResultOfASubstitution) {
  EXPECT_EQ(split("$(var sp) z"), (Words{"a b", "z"}));
  EXPECT_EQ(split("pre$(var sp)post"), (Words{"prea bpost"}));
  EXPECT_EQ(split("--x=$(var x) $(var x)"), (Words{"--x=7", "7"}));
  EXPECT_EQ(split("$(var x)$(var x)"), (Words{"77"}));
  EXPECT_EQ(split("a $(var empty) b"), (Words{"a", "", "b"})) << "an empty result is an argument";
}

TEST(CommandLine, SplitsLiteralTextAsAShellDoes) {
  EXPECT_EQ(split("'q r' s"), (Words{"q r", "s"}));
  EXPECT_EQ(split("--o=''"), (Words{"--o="}));
  EXPECT_EQ(split("\"\" x"), (Words{"", "x"}));
  EXPECT_EQ(split("a'b c'\"d e\""), (Words{"ab cd e"}));
  EXPECT_EQ(split(" a \t\n b "), (Words{"a", "b"}));
  EXPECT_EQ(split(""), Words{});
  EXPECT_EQ(split("  "), Words{});
  EXPECT_EQ(split("$HOME ~ *"), (Words{"$HOME", "~", "*"})) << "no expansion";
}

TEST(CommandLine, SeesTextAfterTheTemplateHasUnescapedIt) {
  EXPECT_EQ(split(R"(a\ b)"), (Words{"a", "b"}));
  EXPECT_EQ(split(R"(a\\ b)"), (Words{"a b"}));
  EXPECT_EQ(split(R"("a\\"b")"), (Words{"a\"b"}));
}

TEST(CommandLine, MakesNoEmptyArgumentOfALeadingBlank) {
  EXPECT_EQ(split(" $(var x)"), (Words{"7"}));
  EXPECT_EQ(split("\n  $(var x)\n  b\n"), (Words{"7", "b"}));
}

TEST(CommandLine, RefusesAQuoteAroundASubstitution) {
  try {
    split("echo '$(var sp)'");
    FAIL() << "no error";
  } catch (const LaunchError& error) {
    EXPECT_STREQ(error.what(),
                 "t:1:1: error: no closing quotation in the command line\n"
                 "    1 | echo '$(var sp)'\n"
                 "      | ^~~~~~\n"
                 "      = help: quotes can't enclose a substitution; its result is never split, so it needs none");
  }
}

TEST(CommandLine, WordsKnowTheirPlace) {
  const std::vector<Template> words = split_command_line(parse_template(located("$(var x) b$(var x)")));
  ASSERT_EQ(words.size(), 2U);
  EXPECT_EQ(words[0].where().begin, 0U);
  EXPECT_EQ(words[1].where().end, 18U);
}

TEST(ShellWords, AreSplitWithQuotesAndBackslashes) {
  EXPECT_EQ(split_shell_words(R"(gdb -ex 'run it' --args a\ b "c \"d\" \e")", {}),
            (Words{"gdb", "-ex", "run it", "--args", "a b", R"(c "d" \e)"}));
  EXPECT_THROW(split_shell_words("'open", {}), LaunchError);
  EXPECT_THROW(split_shell_words("end\\", {}), LaunchError);
}

}  // namespace
}  // namespace launch
