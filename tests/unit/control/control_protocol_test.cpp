// SPDX-License-Identifier: Apache-2.0
#include "launcher/control/control_protocol.hpp"

#include <gmock/gmock.h>
#include <signal.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "launcher/process/fake/fake_event_loop.hpp"
#include "launcher/process/fake/fake_process_runner.hpp"

namespace launch {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using Kind = ControlRequest::Kind;

std::string refusal(std::string_view line) {
  try {
    parse_control_request(line);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST(ControlProtocol, ReadsRequests) {
  EXPECT_EQ(parse_control_request(R"({"version": 1, "do": "info"})").kind, Kind::kInfo);
  const ControlRequest ps = parse_control_request(R"({"version": 1, "do": "ps", "a new key": [1]})");
  EXPECT_EQ(ps.kind, Kind::kPs);
  EXPECT_THAT(ps.processes, IsEmpty());
  const ControlRequest request =
      parse_control_request(R"({"version": 1, "do": "signal", "processes": ["a", "b*"], "signal": "USR1"})");
  EXPECT_EQ(request.kind, Kind::kSignal);
  EXPECT_THAT(request.processes, ElementsAre("a", "b*"));
  EXPECT_EQ(request.signal, SIGUSR1);
  EXPECT_THAT(parse_control_request(R"({"version": 1, "do": "stop", "groups": ["arm"]})").groups, ElementsAre("arm"));
  const ControlRequest reload = parse_control_request(R"({"version": 1, "do": "reload", "dry_run": true})");
  EXPECT_TRUE(reload.dry_run);
  EXPECT_FALSE(reload.restart);
  EXPECT_EQ(parse_control_request(R"({"version": 1, "do": "scale", "processes": ["a"], "count": 3})").count, 3U);
  const ControlRequest attach = parse_control_request(
      R"({"version": 1, "do": "attach", "processes": ["a"], "columns": 80, "lines": 24, "read_only": true})");
  EXPECT_EQ(attach.size.columns, 80U);
  EXPECT_EQ(attach.size.lines, 24U);
  EXPECT_TRUE(attach.read_only);
  EXPECT_EQ(parse_control_request(R"({"version": 1, "do": "attach", "processes": ["a"]})").size.lines, 0U);
  EXPECT_EQ(parse_control_request(R"({"version": 1, "do": "input", "data": "bHMN"})").text, "ls\r");
}

TEST(ControlProtocol, SaysWhatIsWrongWithARequest) {
  const std::string no_object = "a request is a JSON object on one line, such as {\"version\": 1, \"do\": \"ps\"}";
  EXPECT_EQ(refusal(""), no_object);
  EXPECT_EQ(refusal("[1]"), no_object);
  EXPECT_EQ(refusal("{\"version\": 1"), no_object);
  EXPECT_EQ(refusal("\xff\xfe\x00"), no_object);
  EXPECT_EQ(refusal(R"({"do": "ps"})"), "\"version\" must be 1");
  EXPECT_EQ(refusal(R"({"version": 2, "do": "ps"})"), "\"version\" must be 1");
  EXPECT_EQ(refusal(R"({"version": 1})"), "\"do\" is missing, it names what to do");
  EXPECT_EQ(refusal(R"({"version": 1, "do": "fly"})"),
            "\"do\": \"fly\" is unknown; there are info, ps, stop, start, restart, signal, shutdown, events, output, "
            "reload, scale, attach, input, resize");
  EXPECT_EQ(refusal(R"({"version": 1, "do": "reload", "dry_run": 1})"), "\"dry_run\" must be true or false");
  EXPECT_EQ(refusal(R"({"version": 1, "do": "scale", "processes": ["a"], "count": 0})"),
            "\"processes\" must hold one name, and \"count\" be a number from 1 to 1000");
  EXPECT_EQ(refusal(R"({"version": 1, "do": "attach", "processes": ["a", "b"]})"), "\"processes\" must hold one name");
  EXPECT_EQ(refusal(R"({"version": 1, "do": "attach", "processes": ["a"], "read_only": "yes"})"),
            "\"read_only\" must be true or false");
  EXPECT_EQ(refusal(R"({"version": 1, "do": "resize", "lines": -1})"), "\"lines\" must be a number up to 10000");
  EXPECT_EQ(refusal(R"({"version": 1, "do": "input"})"), "\"data\" must be Base64");
  EXPECT_EQ(refusal(R"({"version": 1, "do": "input", "data": "ls"})"), "\"data\" must be Base64");
  EXPECT_EQ(refusal(R"({"version": 1, "do": "stop", "groups": "a"})"), "\"groups\" must be a list of names");
  EXPECT_EQ(refusal(R"({"version": 1, "do": "stop"})"), "\"processes\" is missing, it names the processes");
  EXPECT_EQ(refusal(R"({"version": 1, "do": "ps", "processes": "a"})"), "\"processes\" must be a list of names");
  EXPECT_EQ(refusal(R"({"version": 1, "do": "ps", "processes": [1]})"), "\"processes\" must be a list of names");
  EXPECT_EQ(refusal(R"({"version": 1, "do": "signal", "processes": ["a"], "signal": "FLY"})"),
            "\"signal\" must be the name of a signal, such as \"SIGUSR1\"");
}

TEST(ControlProtocol, ManyBracketsAreNoRequest) {
  EXPECT_NE(refusal(std::string(60'000, '[')), "");
  EXPECT_NE(refusal(std::string(30'000, '[') + std::string(30'000, ']')), "");
}

TEST(ControlProtocol, AnAnswerIsOneLineWhateverNamesHold) {
  const std::string line = output_line("a\nb", OutputStream::kErr, "\xff \"quoted\"\n");
  EXPECT_THAT(line, Not(HasSubstr("\n")));
  const nlohmann::json json = nlohmann::json::parse(line);
  EXPECT_EQ(json["process"], "a\nb");
  EXPECT_EQ(json["stream"], "stderr");
  EXPECT_EQ(json["line"], "\xef\xbf\xbd \"quoted\"\n");
}

TEST(ControlProtocol, ListsProcesses) {
  FakeEventLoop loop;
  FakeProcessRunner runner(loop);
  OutputRouter output({.screen_fd = -1});
  ProcessSupervisor supervisor(loop, runner, output);
  runner.script("talker", {{.dies_after = std::chrono::seconds(1), .exit_code_on_signal = 3}});
  ProcessSpec spec;
  spec.name = "talker";
  spec.argv = {"/bin/talker"};
  const auto file = std::make_shared<SourceFile>("/a \"b\".xml", "<launch>\n  <node/>");
  const std::vector<SteeredProcess> processes = {
      {.id = supervisor.start(spec), .name = "talker-1", .names = {"talker", "/ta\xfflker"}, .origin = {file, 11, 18}},
      {.name = "later", .names = {}, .waits = true}};
  loop.advance(std::chrono::milliseconds(1500));
  const auto list = [&] { return nlohmann::json::parse(ps_line({.pid = 5}, false, processes, supervisor)); };
  nlohmann::json json = list();
  EXPECT_EQ(json["launch"]["pid"], 5);
  EXPECT_EQ(json["launch"]["state"], "running");
  EXPECT_EQ(json["processes"], nlohmann::json::parse(R"([
      {"name": "talker-1", "names": ["talker", "/ta\ufffdlker"], "state": "running", "pid": 1000001, "running_for": 1.5,
       "restarts": 0, "place": {"file": "/a \"b\".xml", "line": 2, "column": 3}},
      {"name": "later", "names": [], "state": "waiting", "place": null}])"));
  // Whatever becomes of the clock: `started` is of no use for that.
  const auto before = std::chrono::steady_clock::now() - std::chrono::seconds(90);
  json = nlohmann::json::parse(ps_line({.started = 1, .started_at = before}, false, processes, supervisor));
  EXPECT_GE(json["launch"]["running_for"], 90);
  EXPECT_LT(json["launch"]["running_for"], 10000);
  supervisor.shutdown();
  loop.advance(std::chrono::seconds(1));
  json = list();
  EXPECT_EQ(json["processes"][0]["state"], "ended");
  EXPECT_EQ(json["processes"][0]["last_end"], nlohmann::json::parse(R"({"exit_code": 3, "ran_for": 2.5})"));
  EXPECT_FALSE(json["processes"][0].contains("pid"));
  EXPECT_EQ(nlohmann::json::parse(ps_line({}, true, {}, supervisor))["processes"], nlohmann::json::array());
}

TEST(ControlProtocol, TellsHowAProcessHasEnded) {
  ProcessSpec spec;
  const std::string label = "a-1";
  ProcessExited exited{.pid = 7,
                       .exit = {.code = -SIGSEGV, .ran_for = std::chrono::milliseconds(1500)},
                       .expected = false,
                       .will_respawn = true};
  exited.exit.usage.ru_utime = {1, 250'000};
  exited.exit.usage.ru_stime = {0, 250'000};
  nlohmann::json json = nlohmann::json::parse(event_line({1, label, spec, exited}));
  json.erase("time");
  EXPECT_EQ(json, nlohmann::json::parse(R"({"event": "exited", "process": "a-1", "pid": 7, "signal": "SIGSEGV",
                                            "ran_for": 1.5, "expected": false, "will_respawn": true, "cpu": 1.5})"));
}

TEST(ControlProtocol, AnErrorHasTheSuggestionBesideIt) {
  SteeringOutcome outcome;
  outcome.error = "no process is named 'talkr'";
  outcome.help = "did you mean 'talker'?";
  EXPECT_EQ(outcome_line(outcome),
            R"({"version":1,"ok":false,"error":"no process is named 'talkr'","help":"did you mean 'talker'?"})");
}

}  // namespace
}  // namespace launch
