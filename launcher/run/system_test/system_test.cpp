// SPDX-License-Identifier: Apache-2.0
#include "launcher/run/system_test/system_test.hpp"

namespace launch {

void SystemTest::use(Sinks sinks) {
  sinks_ = std::move(sinks);
  faults_.observe(std::exchange(sinks_.fault, nullptr));
}

void SystemTest::begin(std::vector<TestRequest> tests, const std::string& directory) {
  for (TestRequest& test : tests) {
    std::vector<FaultRequest> faults = test.faults;
    if (sinks_.begin) {
      sinks_.begin(std::move(test));
    }
    faults_.start(std::move(faults), directory);
  }
}

void SystemTest::prepare(ProcessSpec& spec, ProcessId id) const {
  if (prepare_) {
    prepare_(spec);
  }
  faults_.prepare(spec, id);
}

void SystemTest::on_line(const ProcessSpec& spec, ProcessId id, const std::string& label, OutputStream stream,
                         std::string_view line) {
  faults_.on_line(id, stream, line);
  if (sinks_.line) {
    sinks_.line(spec, label, stream, line);
  }
}

void SystemTest::on_shutdown() {
  if (sinks_.ending) {
    sinks_.ending();
  }
  faults_.shutdown();
}

}  // namespace launch
