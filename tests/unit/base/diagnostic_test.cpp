// SPDX-License-Identifier: Apache-2.0
#include "base/diagnostics/diagnostic.hpp"

#include <gtest/gtest.h>

namespace launch {
namespace {

constexpr const char* kSystem =
    "<launch>\n"
    "\n"
    "\n"
    "  <node pkg=\"demo\" exce=\"talker\"/>\n"
    "</launch>\n";

SourceRange find(const std::shared_ptr<const SourceFile>& file, std::string_view what) {
  const std::size_t begin = file->text().find(what);
  return {file, static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(begin + what.size())};
}

TEST(Diagnostic, ShowsPlaceLineCaretHelpAndIncluder) {
  const auto main = std::make_shared<const SourceFile>("main.launch.xml", "<launch>\n\n  <include file=\"x\"/>\n");
  const auto file = std::make_shared<const SourceFile>("system.launch.xml", kSystem, find(main, "<include"));
  const Diagnostic diagnostic{Severity::kError, "unknown attribute 'exce' of <node>", find(file, "exce"),
                              "did you mean 'exec'?"};
  EXPECT_EQ(render(diagnostic),
            "system.launch.xml:4:20: error: unknown attribute 'exce' of <node>\n"
            "    4 |   <node pkg=\"demo\" exce=\"talker\"/>\n"
            "      |                    ^~~~\n"
            "      = help: did you mean 'exec'?\n"
            "      = included from main.launch.xml:3:3\n");
}

TEST(Diagnostic, ShowsTheWholeChainOfIncludes) {
  const auto top = std::make_shared<const SourceFile>("top.xml", "<include/>");
  const auto middle = std::make_shared<const SourceFile>("middle.xml", "\n<include/>", find(top, "include"));
  const auto inner = std::make_shared<const SourceFile>("inner.xml", "bad", find(middle, "include"));
  EXPECT_EQ(render(Diagnostic{Severity::kError, "bad", find(inner, "bad"), {}}),
            "inner.xml:1:1: error: bad\n"
            "    1 | bad\n"
            "      | ^~~\n"
            "      = included from middle.xml:2:2\n"
            "      = included from top.xml:1:2\n");
}

TEST(Diagnostic, WithoutAPlaceIsMessageAndHelp) {
  EXPECT_EQ(render(Diagnostic{Severity::kWarning, "nothing to do", {}, "name a file"}),
            "warning: nothing to do\n"
            "      = help: name a file\n");
  EXPECT_EQ(render(Diagnostic{Severity::kWarning, "nothing to do", {}, "name a file"}, false, "launch check"),
            "launch check: warning: nothing to do\n"
            "      = help: name a file\n");
}

TEST(Diagnostic, ColoursSeverityMessageAndCaret) {
  const auto file = std::make_shared<const SourceFile>("a.xml", "abc");
  EXPECT_EQ(render(Diagnostic{Severity::kError, "bad", find(file, "b"), "fix it"}, true),
            "\x1b[1ma.xml:1:2:\x1b[0m \x1b[1;31merror:\x1b[0m \x1b[1mbad\x1b[0m\n"
            "\x1b[34m    1 |\x1b[0m abc\n"
            "\x1b[34m      |\x1b[0m  \x1b[1;31m^\x1b[0m\n"
            "      \x1b[1;36m= help:\x1b[0m fix it\n");
}

TEST(Diagnostic, TurnsTabsIntoSpacesAndKeepsTheCaretInPlace) {
  const auto file = std::make_shared<const SourceFile>("a.xml", "\tab\tcd");
  EXPECT_EQ(render(Diagnostic{Severity::kError, "bad", find(file, "cd"), {}}),
            "a.xml:1:5: error: bad\n"
            "    1 |     ab    cd\n"
            "      |           ^~\n");
}

TEST(Diagnostic, CountsCharactersOfUtf8AndColumnsOfWideOnes) {
  const auto file = std::make_shared<const SourceFile>("a.xml", "\xC3\xA4\xE6\xBC\xA2x");  // ä 漢 x
  EXPECT_EQ(render(Diagnostic{Severity::kError, "bad", find(file, "x"), {}}),
            "a.xml:1:3: error: bad\n"
            "    1 | \xC3\xA4\xE6\xBC\xA2x\n"
            "      |    ^\n");
}

TEST(Diagnostic, ReplacesWhatWouldSteerTheTerminal) {
  const auto file = std::make_shared<const SourceFile>("a.xml", "\x1b[2Jx\xFF");
  EXPECT_EQ(render(Diagnostic{Severity::kError, "bad", find(file, "x"), {}}),
            "a.xml:1:5: error: bad\n"
            "    1 | \xEF\xBF\xBD[2Jx\xEF\xBF\xBD\n"
            "      |     ^\n");
}

TEST(Diagnostic, CutsALongLineAroundTheCaret) {
  const auto file = std::make_shared<const SourceFile>("a.xml", std::string(500, 'a') + "HERE" + std::string(500, 'b'));
  EXPECT_EQ(render(Diagnostic{Severity::kError, "bad", find(file, "HERE"), {}}),
            "a.xml:1:501: error: bad\n"
            "    1 | ..." +
                std::string(40, 'a') + "HERE" + std::string(56, 'b') +
                "...\n"
                "      |    " +
                std::string(40, ' ') + "^~~~\n");
}

TEST(Diagnostic, CutsTheEndOfALongLineWhenTheCaretIsAtItsStart) {
  const auto file = std::make_shared<const SourceFile>("a.xml", "HERE" + std::string(500, 'b'));
  EXPECT_EQ(render(Diagnostic{Severity::kError, "bad", find(file, "HERE"), {}}),
            "a.xml:1:1: error: bad\n"
            "    1 | HERE" +
                std::string(96, 'b') +
                "...\n"
                "      | ^~~~\n");
}

TEST(Diagnostic, UnderlinesOnlyTheFirstLineOfALongerRange) {
  const auto file = std::make_shared<const SourceFile>("a.xml", "one two\nthree");
  EXPECT_EQ(render(Diagnostic{Severity::kError, "bad", {file, 4, 12}, {}}),
            "a.xml:1:5: error: bad\n"
            "    1 | one two\n"
            "      |     ^~~\n");
}

TEST(Diagnostic, PointsBehindTheLastCharacter) {
  const auto file = std::make_shared<const SourceFile>("a.xml", "abc");
  EXPECT_EQ(render(Diagnostic{Severity::kError, "bad", {file, 3, 3}, {}}),
            "a.xml:1:4: error: bad\n"
            "    1 | abc\n"
            "      |    ^\n");
}

TEST(LaunchError, HoldsAllDiagnosticsAndTheirPlainTextWithoutTheLastLineEnd) {
  const LaunchError error({{Severity::kError, "one", {}, {}}, {Severity::kError, "two", {}, "help"}});
  EXPECT_EQ(error.diagnostics().size(), 2U);
  EXPECT_STREQ(error.what(), "error: one\nerror: two\n      = help: help");
}

}  // namespace
}  // namespace launch
