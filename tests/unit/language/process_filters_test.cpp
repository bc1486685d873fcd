// SPDX-License-Identifier: Apache-2.0
// Exit codes and lines, in the form of launch files.
#include <gmock/gmock.h>
#include <signal.h>

#include "base/diagnostics/diagnostic.hpp"
#include "launcher/language/exit_code_filter.hpp"
#include "launcher/language/output_pattern.hpp"

namespace launch {
namespace {

const SourceRange kPlace{std::make_shared<SourceFile>("/test/x.xml", "<a code='7'/>"), 9, 10};

std::string message_of(const std::function<void()>& step) {
  try {
    step();
  } catch (const LaunchError& error) {
    const Diagnostic& diagnostic = error.diagnostics().front();
    return diagnostic.message + "; " + diagnostic.help;
  }
  return {};
}

TEST(ExitCodeFilter, TakesListsOfCodesAndSignals) {
  const ExitCodeFilter listed(" 0, 3,SIGSEGV , -9", kPlace);
  for (const int code : {0, 3, -SIGSEGV, -9}) {
    EXPECT_TRUE(listed.matches(code)) << code;
  }
  for (const int code : {1, SIGSEGV, 9, -2}) {
    EXPECT_FALSE(listed.matches(code)) << code;
  }
}

TEST(ExitCodeFilter, KnowsAnyAndNonzero) {
  EXPECT_TRUE(ExitCodeFilter("any", kPlace).matches(0));
  EXPECT_TRUE(ExitCodeFilter().matches(-9));
  EXPECT_TRUE(ExitCodeFilter("nonzero", kPlace).matches(-9));
  EXPECT_FALSE(ExitCodeFilter("nonzero", kPlace).matches(0));
}

TEST(ExitCodeFilter, SaysWhatIsWrong) {
  const auto error = [](const char* text) { return message_of([&] { ExitCodeFilter(text, kPlace); }); };
  const std::string help =
      "write any, nonzero, or numbers from 0 to 255 and signals such as SIGSEGV, separated by commas";
  EXPECT_EQ(error("256"), "'256' is no exit code; " + help);
  EXPECT_EQ(error("-99"), "'-99' is no exit code; " + help);
  EXPECT_EQ(error("0,,1"), "'' is no exit code; " + help);
  EXPECT_EQ(error("SIGSEG"), "'SIGSEG' is no exit code; did you mean 'SIGSEGV'?");
  EXPECT_EQ(error("non-zero"), "'non-zero' is no exit code; did you mean 'nonzero'?");
}

TEST(SignalNumber, TakesNamesAndNumbers) {
  EXPECT_EQ(signal_number("SIGUSR1"), SIGUSR1);
  EXPECT_EQ(signal_number("TERM"), SIGTERM);
  EXPECT_EQ(signal_number("9"), SIGKILL);
  EXPECT_EQ(signal_number("SIGNOTHING"), 0);
  EXPECT_EQ(signal_number("0"), 0);
  EXPECT_EQ(signal_number("-9"), 0);
}

TEST(OutputPattern, FindsAnExpressionInALineOfTheStream) {
  const OutputPattern pattern("port [0-9]+", kPlace, "stderr", kPlace);
  EXPECT_TRUE(pattern.matches(OutputStream::kErr, "listening on port 80."));
  EXPECT_FALSE(pattern.matches(OutputStream::kErr, "listening on port"));
  EXPECT_FALSE(pattern.matches(OutputStream::kOut, "listening on port 80."));
  EXPECT_EQ(pattern.describe(), "a line that matches 'port [0-9]+' on stderr");
}

TEST(OutputPattern, LooksAtTheBeginningOfLongLinesOnly) {
  const OutputPattern pattern("^(a|b)*c", kPlace, "both", kPlace);
  EXPECT_FALSE(pattern.matches(OutputStream::kOut, std::string(1'000'000, 'a') + "c"));
}

TEST(OutputPattern, SaysWhatIsWrong) {
  EXPECT_THAT(message_of([] { OutputPattern("ready (", kPlace, "both", kPlace); }),
              testing::StartsWith("'ready (' is not a regular expression: "));
  EXPECT_EQ(message_of([] { OutputPattern("x", kPlace, "stdot", kPlace); }),
            "'stdot' is no stream of a process, expected stdout, stderr or both; did you mean 'stdout'?");
}

}  // namespace
}  // namespace launch
