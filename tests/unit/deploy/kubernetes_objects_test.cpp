// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "tests/unit/deploy/deployment_text.hpp"

namespace {

using launch::as_kubernetes_objects;
using test_support::exported;
using test_support::left_out;
using testing::ElementsAre;
using testing::HasSubstr;

TEST(KubernetesObjects, AreAPodForAProcessThatRunsOnce) {
  EXPECT_EQ(exported(as_kubernetes_objects, R"xml(
<set_env name="MODE" value="\$(HOME) costs $$5"/>
<executable cmd="/bin/echo $HOME" name="Says_It" cwd="/srv" memory_max="100M" cpu_quota="25%"/>)xml"),
            R"(== robot-says-it.yaml
apiVersion: "v1"
kind: "Pod"
metadata:
  name: "robot-says-it"
  labels:
    app.kubernetes.io/name: "robot-says-it"
    app.kubernetes.io/part-of: "robot"
spec:
  hostNetwork: true
  hostIPC: true
  terminationGracePeriodSeconds: 10
  containers:
    - name: "says-it"
      image: "robot:1"
      args:
        - "/bin/echo"
        - "$HOME"
      workingDir: "/srv"
      env:
        - name: "MODE"
          value: "$$(HOME) costs $$$5"
      resources:
        limits:
          memory: "104857600"
          cpu: "250m"
  restartPolicy: "Never"
)");
}

TEST(KubernetesObjects, AreADeploymentForAProcessThatRespawns) {
  const std::string text = exported(as_kubernetes_objects, R"(<executable cmd="true" name="a" respawn="true"/>)");
  EXPECT_THAT(text, HasSubstr("kind: \"Deployment\"\n"));
  EXPECT_THAT(text,
              HasSubstr("spec:\n  replicas: 1\n  strategy:\n    type: \"Recreate\"\n  selector:\n    matchLabels:\n"
                        "      app.kubernetes.io/name: \"robot-a\"\n"));
}

TEST(KubernetesObjects, TwoOfOneNameAreToldApart) {
  const std::string text =
      exported(as_kubernetes_objects, R"(<executable cmd="true" name="a_b"/><executable cmd="true" name="a-b"/>)");
  EXPECT_THAT(text, HasSubstr("== robot-a-b.yaml\n"));
  EXPECT_THAT(text, HasSubstr("== robot-a-b-2.yaml\n"));
}

TEST(KubernetesObjects, HaveProbesForWatches) {
  const std::string xml = R"xml(
<executable cmd="true" name="a" respawn="true">
  <watch kind="command" cmd="test $(env HOME)" interval="2.5" timeout="1" failures="4" start_period="3" on_unhealthy="restart"/>
  <watch kind="port" port="8080"/>
</executable>
<executable cmd="true" name="b"><watch kind="memory" max_memory="1M" on_unhealthy="restart"/></executable>)xml";
  const std::string text = exported(as_kubernetes_objects, xml);
  EXPECT_THAT(
      text, HasSubstr("livenessProbe:\n            exec:\n              command:\n                - \"test\"\n"
                      "                - \"/home/user\"\n            periodSeconds: 3\n            timeoutSeconds: 1\n"
                      "            failureThreshold: 4\n            initialDelaySeconds: 3\n"));
  EXPECT_THAT(text, HasSubstr("readinessProbe:\n            tcpSocket:\n              host: \"localhost\"\n"
                              "              port: 8080\n"));
  EXPECT_THAT(left_out(as_kubernetes_objects, xml),
              ElementsAre("'b' is healthy while it does not have more than 1.0 MiB of memory for 5 s; else restart"));
}

TEST(KubernetesObjects, WhatTheyCantSayIsListed) {
  EXPECT_THAT(left_out(as_kubernetes_objects, R"(
<executable cmd="true" name="a" cpus="0" open_files_limit="5" pids_max="9"/>
<executable cmd="true" name="b" respawn="true" respawn_max_retries="2"><depends_on process="a"/></executable>)"),
              ElementsAre("the set of processors of 'a'", "the resource limits of 'a'", "pids_max of 'a'",
                          "'b' waits until 'a' has started", "the limit of respawns of 'b'"));
}

}  // namespace
