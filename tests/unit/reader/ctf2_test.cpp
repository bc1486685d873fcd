// SPDX-License-Identifier: Apache-2.0
// The metadata of CTF 2: the same packets, described in both languages, hold the same events.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/support/trace_writer/temporary_directory.hpp"
#include "tests/support/trace_writer/trace_text.hpp"
#include "tests/support/trace_writer/trace_writer.hpp"
#include "tracing/decode/ctf/ctf2_metadata.hpp"
#include "tracing/decode/ctf/trace_class.hpp"

namespace tracing {
namespace {

using Json = nlohmann::ordered_json;
using testing::TemporaryDirectory;
using testing::Thread;
using testing::TraceWriter;

Json integer(int bits, const char* role = "", bool is_signed = false) {
  Json type{{"type", is_signed ? "fixed-length-signed-integer" : "fixed-length-unsigned-integer"},
            {"length", bits},
            {"byte-order", "little-endian"},
            {"alignment", 8}};
  if (*role != '\0') {
    type["roles"] = {role};
  }
  return type;
}

Json field(const char* name, const Json& type) {
  return {{"name", name}, {"field-class", type}};
}

Json structure(const std::vector<Json>& members) {
  return {{"type", "structure"}, {"member-classes", members}};
}

Json string() {
  return {{"type", "null-terminated-string"}};
}

Json pointer() {
  Json type = integer(64);
  type["preferred-display-base"] = 16;
  return type;
}

Json event(const char* name, int id, const std::vector<Json>& members) {
  return {{"type", "event-record-class"}, {"name", name}, {"id", id}, {"payload-field-class", structure(members)}};
}

// What TraceWriter writes, beginning with the packet's header.
std::vector<Json> fragments() {
  const Json time = integer(64, "default-clock-timestamp");
  Json id = integer(16, "event-record-class-id");
  const Json location = {{"path", {"id"}}};
  const Json variant = {{"type", "variant"},
                        {"selector-field-location", location},
                        {"options",
                         {{{"name", "compact"},
                           {"selector-field-ranges", {{0, 65534}}},
                           {"field-class", structure({field("timestamp", time)})}},
                          {{"name", "extended"},
                           {"selector-field-ranges", {{65535, 65535}}},
                           {"field-class", structure({field("id", integer(32, "event-record-class-id")),
                                                      field("timestamp", "time alias")})}}}}};
  Json header = structure({field("id", id), field("v", variant)});
  header["minimum-alignment"] = 8;
  const Json handles = {{"type", "dynamic-length-array"},
                        {"element-field-class", pointer()},
                        {"length-field-location", {{"path", {"_subs_length"}}}}};
  const Json others = {{"type", "dynamic-length-array"},
                       {"element-field-class", pointer()},
                       {"length-field-location", {{"path", {"_pubs_length"}}}}};
  return {
      {{"type", "preamble"},
       {"version", 2},
       {"uuid", {0x11, 0x11, 0x11, 0x11, 0x11, 0x11, 0x11, 0x11, 0x11, 0x11, 0x11, 0x11, 0x11, 0x11, 0x11, 0}}},
      {{"type", "field-class-alias"}, {"name", "time alias"}, {"field-class", time}},
      {{"type", "trace-class"},
       {"environment",
        {{"hostname", "box"},
         {"domain", "ust"},
         {"tracer_name", "lttng-ust"},
         {"tracer_major", 2},
         {"tracer_minor", 13}}},
       {"packet-header-field-class",
        structure({field("magic", integer(32, "packet-magic-number")),
                   field("uuid", {{"type", "static-length-blob"}, {"length", 16}, {"roles", {"metadata-stream-uuid"}}}),
                   field("class", integer(32, "data-stream-class-id")),
                   field("stream", integer(64, "data-stream-id"))})}},
      {{"type", "clock-class"},
       {"id", "monotonic"},
       {"frequency", 1'000'000'000},
       {"offset-from-origin", {{"seconds", 0}, {"cycles", 0}}}},
      {{"type", "data-stream-class"},
       {"default-clock-class-id", "monotonic"},
       {"event-record-header-field-class", header},
       {"packet-context-field-class",
        structure(
            {field("begin", time), field("end", integer(64, "packet-end-default-clock-timestamp")),
             field("content", integer(64, "packet-content-length")), field("size", integer(64, "packet-total-length")),
             field("number", integer(64, "packet-sequence-number")),
             field("lost", integer(64, "discarded-event-record-counter-snapshot")), field("cpu_id", integer(32))})},
       {"event-record-common-context-field-class",
        structure({field("vpid", integer(32, "", true)), field("vtid", integer(32, "", true)),
                   field("procname", {{"type", "static-length-string"}, {"length", 17}})})}},
      event("ros2:rcl_node_init", 0,
            {field("node_handle", pointer()), field("rmw_handle", pointer()), field("node_name", string()),
             field("namespace", string())}),
      event("ros2:message_link_partial_sync", 1,
            {field("_subs_length", integer(64)), field("subs", handles), field("_pubs_length", integer(64)),
             field("pubs", others)}),
      event("own:values", 2,
            {field("ratio", {{"type", "fixed-length-floating-point-number"},
                             {"length", 64},
                             {"byte-order", "little-endian"},
                             {"alignment", 8}}),
             field("bytes", {{"type", "static-length-array"}, {"length", 3}, {"element-field-class", integer(8)}}),
             field("pair", structure({field("inner", integer(8, "", true))}))}),
  };
}

std::string sequence(const std::vector<Json>& texts) {
  std::string result;
  for (const Json& text : texts) {
    result += "\x1e" + text.dump() + "\n";
  }
  return result;
}

void write_trace(const std::filesystem::path& directory) {
  constexpr Thread kFirst{71, 72, "ping"};
  TraceWriter writer(directory);
  writer.write(0, 100, kFirst, ros2::RclNodeInit{0xffff800000000001, 2, "talker", "/ns"});
  writer.write(1, 150, {81, 82, "pong"}, ros2::MessageLinkPartialSync{{3, 4}, {5}});
  const std::uint16_t own = writer.declare("own:values",
                                           "floating_point { exp_dig = 11; mant_dig = 53; align = 8; } _ratio;\n"
                                           "integer { size = 8; align = 8; signed = 0; } _bytes[3];\n"
                                           "struct { integer { size = 8; align = 8; signed = 1; } _inner; } _pair;\n");
  const double ratio = 0.5;
  std::string payload(reinterpret_cast<const char*>(&ratio), sizeof ratio);
  payload += "\1\2\3\xfe";
  writer.write_raw(0, 300, kFirst, own, payload);
  writer.end_packet(0);
  writer.discard_events(0, 3);
  writer.write(0, 400, kFirst, ros2::RclNodeInit{6, 7, "other", "/"});
  writer.finish();
}

TEST(Ctf2, DescribesTheSameEvents) {
  const TemporaryDirectory directory;
  write_trace(directory.path());
  const auto expected = testing::trace_text(directory.path(), TraceReader::Decoder::kDirect);
  ASSERT_GT(expected.size(), 4u);
  std::ofstream(directory.path() / "metadata") << sequence(fragments());
  EXPECT_EQ(testing::trace_text(directory.path(), TraceReader::Decoder::kDirect), expected);
}

TEST(Ctf2, MetadataMayEndInTheMiddleOfAText) {
  std::vector<Json> all = fragments();
  const std::string whole = sequence(all);
  EXPECT_FALSE(ctf::translate_ctf2(whole).is_cut);
  const ctf::Ctf2Metadata cut = ctf::translate_ctf2(whole.substr(0, whole.size() - 10));
  EXPECT_TRUE(cut.is_cut);
  EXPECT_EQ(ctf::parse_metadata(cut.text).events.size(), 2u);
}

TEST(Ctf2, SaysWhatItDoesNotKnow) {
  std::vector<Json> all = fragments();
  all.push_back(event("own:optional", 3, {field("maybe", {{"type", "optional"}})}));
  try {
    ctf::translate_ctf2(sequence(all));
    FAIL();
  } catch (const ctf::UnsupportedTrace& unsupported) {
    EXPECT_THAT(unsupported.what(), ::testing::HasSubstr("field class 'optional'"));
  }
  EXPECT_THROW(ctf::translate_ctf2("\x1e{\"type\": \"preamble\", \"version\": 3}"), ctf::UnsupportedTrace);
  EXPECT_THROW(ctf::translate_ctf2("\x1e{\"type\": \"field-class-alias\", \"name\": \"a\"}"), ctf::UnsupportedTrace);
}

TEST(Ctf2, ReadsBigEndianNumbers) {
  Json big = integer(32);
  big["byte-order"] = "big-endian";
  std::vector<Json> all = fragments();
  all.push_back(event("own:big", 3, {field("value", big)}));
  const ctf::TraceClass trace = ctf::parse_metadata(ctf::translate_ctf2(sequence(all)).text);
  EXPECT_TRUE(trace.events.back().payload->members[0].type->is_big_endian);
  EXPECT_FALSE(trace.events.front().payload->members[0].type->is_big_endian);
}

}  // namespace
}  // namespace tracing
