// SPDX-License-Identifier: Apache-2.0
#include "programs/serve/metrics.hpp"

#include <gmock/gmock.h>

namespace {

using namespace launch::serve;
using Json = nlohmann::ordered_json;
using testing::HasSubstr;
using testing::Not;

Json launch_of(int pid, const std::string& file, Json processes) {
  return {{"launch", {{"pid", pid}, {"state", "running"}, {"files", {"/opt/" + file}}, {"running_for", 2.5}}},
          {"processes", std::move(processes)}};
}

TEST(Metrics, OfALaunchAndItsProcesses) {
  const Json runs = {{"name", "talker-1"}, {"state", "running"}, {"pid", 77},      {"running_for", 2.25},
                     {"restarts", 3},      {"cpu", 0.5},         {"memory", 4096}, {"health", "unhealthy"}};
  const Json ended = {{"name", "say \"hi\"-2"},
                      {"state", "ended: SIGSEGV"},
                      {"pid", 0},
                      {"restarts", 0},
                      {"last_end", {{"signal", "SIGSEGV"}, {"ran_for", 1.0}}}};
  EXPECT_EQ(launch_metrics({launch_of(5, "robot.launch.xml", {runs, ended})}),
            R"(# TYPE launch_info gauge
# HELP launch_info 1 for each launch that runs, with its number.
launch_info{launch="robot.launch.xml",pid="5",state="running"} 1
# TYPE launch_running_seconds gauge
# UNIT launch_running_seconds seconds
# HELP launch_running_seconds For how long the launch has been running.
launch_running_seconds{launch="robot.launch.xml"} 2.5
# TYPE launch_process_state gauge
# HELP launch_process_state 1 for the state in which the process is.
launch_process_state{launch="robot.launch.xml",process="talker-1",state="running"} 1
launch_process_state{launch="robot.launch.xml",process="say \"hi\"-2",state="ended: SIGSEGV"} 1
# TYPE launch_process_up gauge
# HELP launch_process_up Whether the process runs.
launch_process_up{launch="robot.launch.xml",process="talker-1"} 1
launch_process_up{launch="robot.launch.xml",process="say \"hi\"-2"} 0
# TYPE launch_process_running_seconds gauge
# UNIT launch_process_running_seconds seconds
# HELP launch_process_running_seconds For how long the process has been running.
launch_process_running_seconds{launch="robot.launch.xml",process="talker-1"} 2.25
# TYPE launch_process_restarts counter
# HELP launch_process_restarts Starts after the first one.
launch_process_restarts_total{launch="robot.launch.xml",process="talker-1"} 3
launch_process_restarts_total{launch="robot.launch.xml",process="say \"hi\"-2"} 0
# TYPE launch_process_cpu_seconds counter
# UNIT launch_process_cpu_seconds seconds
# HELP launch_process_cpu_seconds Time of processors since the start of the process.
launch_process_cpu_seconds_total{launch="robot.launch.xml",process="talker-1"} 0.5
# TYPE launch_process_resident_memory_bytes gauge
# UNIT launch_process_resident_memory_bytes bytes
# HELP launch_process_resident_memory_bytes Memory that is resident.
launch_process_resident_memory_bytes{launch="robot.launch.xml",process="talker-1"} 4096
# TYPE launch_process_healthy gauge
# HELP launch_process_healthy Whether the watches say that the process is healthy.
launch_process_healthy{launch="robot.launch.xml",process="talker-1"} 0
# TYPE launch_process_last_exit_code gauge
# HELP launch_process_last_exit_code Exit code of the last end of the process; 128+N if signal N ended it.
launch_process_last_exit_code{launch="robot.launch.xml",process="say \"hi\"-2"} 139
)");
}

TEST(Metrics, TwoLaunchesOfOneFileAreToldApart) {
  const std::string text =
      launch_metrics({launch_of(5, "a.launch.xml", Json::array()), launch_of(6, "a.launch.xml", Json::array()),
                      launch_of(7, "b.launch.xml", Json::array())});
  EXPECT_THAT(text, HasSubstr("launch_info{launch=\"a.launch.xml 5\",pid=\"5\",state=\"running\"} 1\n"));
  EXPECT_THAT(text, HasSubstr("launch_info{launch=\"a.launch.xml 6\",pid=\"6\",state=\"running\"} 1\n"));
  EXPECT_THAT(text, HasSubstr("launch_info{launch=\"b.launch.xml\",pid=\"7\",state=\"running\"} 1\n"));
}

TEST(Metrics, OfControlGroups) {
  const Json group = {{"name", "arm"}, {"memory", 100}, {"memory_max", 200}, {"throttled", 1.5}, {"out_of_memory", 2}};
  const Json process = {{"name", "a-1"}, {"state", "running"}, {"pid", 7}, {"control_groups", {group}}};
  const std::string text = launch_metrics({launch_of(5, "a.launch.xml", {process})});
  const std::string labels = "{launch=\"a.launch.xml\",process=\"a-1\",group=\"arm\"} ";
  EXPECT_THAT(text, HasSubstr("launch_control_group_memory_bytes" + labels + "100\n"));
  EXPECT_THAT(text, HasSubstr("launch_control_group_memory_max_bytes" + labels + "200\n"));
  EXPECT_THAT(text, HasSubstr("launch_control_group_throttled_seconds_total" + labels + "1.5\n"));
  EXPECT_THAT(text, HasSubstr("launch_control_group_out_of_memory_kills_total" + labels + "2\n"));
}

TEST(Metrics, HaveTheFormatThatAClientReads) {
  EXPECT_EQ(metrics_format_for("application/openmetrics-text;version=1.0.0;q=0.75,text/plain;version=0.0.4;q=0.5"),
            MetricsFormat::kOpenMetrics);
  EXPECT_EQ(metrics_format_for("*/*"), MetricsFormat::kPrometheusText);
  const std::string families =
      "# TYPE launch_x_seconds counter\n# UNIT launch_x_seconds seconds\n# HELP launch_x_seconds So long.\n"
      "launch_x_seconds_total{a=\"b c\"} 1\n# TYPE launch_y gauge\n# HELP launch_y So much.\nlaunch_y 2\n";
  EXPECT_EQ(metrics_text(families, MetricsFormat::kOpenMetrics), families + "# EOF\n");
  EXPECT_EQ(metrics_text(families, MetricsFormat::kPrometheusText),
            "# TYPE launch_x_seconds_total counter\n# HELP launch_x_seconds_total So long.\n"
            "launch_x_seconds_total{a=\"b c\"} 1\n# TYPE launch_y gauge\n# HELP launch_y So much.\nlaunch_y 2\n");
}

}  // namespace
