// SPDX-License-Identifier: Apache-2.0
#include "programs/read/event_printer.hpp"

#include <gtest/gtest.h>
#include <stdlib.h>

#include "tests/support/trace_writer/temporary_directory.hpp"
#include "tests/support/trace_writer/trace_writer.hpp"
#include "tracing/decode/reader/trace_reader.hpp"

namespace tracing {
namespace {

// The output of a printer for a small trace with a loss.
std::string printed(std::unique_ptr<EventPrinter> (*make)(std::FILE*)) {
  const testing::TemporaryDirectory directory;
  testing::TraceWriter writer(directory.path(), {.vppid = 70});
  constexpr std::int64_t kBegin = 1'767'225'600'000'000'000;
  const testing::Thread thread{71, 72, "ping"};
  writer.write(0, kBegin, thread, ros2::RclNodeInit{0xabc, 2, "say \"hi\"", "/"});
  writer.end_packet(0);
  writer.discard_events(0, 3);
  const std::uint16_t raw = writer.declare("own:values",
                                           "integer { size = 32; align = 8; signed = 1; } _temperature;\n"
                                           "floating_point { exp_dig = 8; mant_dig = 24; align = 8; } _ratio;\n"
                                           "integer { size = 8; align = 8; signed = 0; } _bytes[3];\n");
  std::string payload("\xfe\xff\xff\xff\0\0\0\x3f\1\2\3", 11);
  writer.write_raw(0, kBegin + 1'500'000'000, thread, raw, payload);
  writer.finish();

  char* text = nullptr;
  std::size_t size = 0;
  std::FILE* const out = open_memstream(&text, &size);
  {
    const auto printer = make(out);
    class Sink : public TraceSink {
     public:
      explicit Sink(EventPrinter& printer) : printer_(printer) {}
      void on_event(const Event& event) override { printer_.print(event); }
      void on_loss(const Loss& loss) override { printer_.print(loss); }

     private:
      EventPrinter& printer_;
    } sink(*printer);
    TraceReader(directory.path()).read(sink);
    printer->flush();
  }
  std::fclose(out);
  std::string result(text, size);
  free(text);
  return result;
}

TEST(EventPrinter, WritesText) {
  EXPECT_EQ(
      printed(make_text_printer),
      "2026-01-01 00:00:00.000000000 +0.000000000 ros2:rcl_node_init cpu 0 ping [71/72] {vppid=70} node_handle=0xabc "
      "rmw_handle=0x2 node_name=\"say \\\"hi\\\"\" namespace=\"/\"\n"
      "2026-01-01 00:00:00.000000000 LOST 3 events of ros2_0, within 1.500000000 s\n"
      "2026-01-01 00:00:01.500000000 +1.500000000 own:values cpu 0 ping [71/72] {vppid=70} temperature=-2 ratio=0.5 "
      "bytes=[1 2 3]\n");
}

TEST(EventPrinter, WritesLinesOfJson) {
  EXPECT_EQ(
      printed(make_json_printer),
      R"({"time_ns":1767225600000000000,"event":"ros2:rcl_node_init","cpu_id":0,"vpid":71,"vtid":72,)"
      R"("procname":"ping","contexts":{"vppid":70},"fields":{"node_handle":2748,"rmw_handle":2,"node_name":"say \"hi\"",)"
      R"("namespace":"/"}})"
      "\n"
      R"({"time_ns":1767225600000000000,"lost":"events","count":3,"end_ns":1767225601500000000,"stream":"ros2_0"})"
      "\n"
      R"({"time_ns":1767225601500000000,"event":"own:values","cpu_id":0,"vpid":71,"vtid":72,"procname":"ping",)"
      R"("contexts":{"vppid":70},"fields":{"temperature":-2,"ratio":0.5,"bytes":[1,2,3]}})"
      "\n");
}

TEST(EventPrinter, WritesCsv) {
  ::testing::internal::CaptureStderr();
  EXPECT_EQ(printed([](std::FILE* out) {
              return make_csv_printer(out, {"bytes", "node_name", "ratio", "vppid"});
            }),
            "time_ns,event,cpu_id,vpid,vtid,procname,bytes,node_name,ratio,vppid\n"
            "1767225600000000000,ros2:rcl_node_init,0,71,72,ping,,\"say \"\"hi\"\"\",,70\n"
            "1767225601500000000,own:values,0,71,72,ping,[1 2 3],,0.5,70\n");
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "launch trace read: warning: 3 events of ros2_0 were lost\n");
}

}  // namespace
}  // namespace tracing
