// SPDX-License-Identifier: Apache-2.0
// <fault process="…" do="kill|stop|slow|limit">: what a test does to a process of the system, and
// <fault topic|service="…" do="drop|duplicate|corrupt|delay">: what it does to messages, and <fault group="…"
// do="partition|lose|delay">: what it does to the network, and <fault clock="…" do="stop|skew|jump">: to simulated
// time, and <fault path="…" do="fill_disk">: to a disk. The random parts are drawn here, so that a run has nothing left
// to chance.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>

#include "actions/process/depends_on.hpp"
#include "actions/process/resource_settings.hpp"
#include "actions/test/fault_kinds.hpp"
#include "actions/values/range_field.hpp"
#include "actions/values/ros_condition.hpp"
#include "launcher/language/exit_code_filter.hpp"
#include "launcher/language/setting.hpp"
#include "launcher/visit/launch_context.hpp"

namespace launch {

namespace {

enum class Kind {
  kKill,
  kStop,
  kSlow,
  kLimit,
  kDrop,
  kDuplicate,
  kCorrupt,
  kDelay,
  kPartition,
  kLose,
  kSkew,
  kJump,
  kFillDisk
};
const std::vector<std::string> kKinds = {"kill",  "stop",      "slow", "limit", "drop", "duplicate", "corrupt",
                                         "delay", "partition", "lose", "skew",  "jump", "fill_disk"};

std::optional<NetworkFault::Kind> network_kind(Kind kind, const Fields& fields) {
  switch (kind) {
    case Kind::kPartition:
      return NetworkFault::Kind::kPartition;
    case Kind::kLose:
      return NetworkFault::Kind::kLose;
    case Kind::kDelay:
      return fields.has("group") ? std::optional(NetworkFault::Kind::kDelay) : std::nullopt;
    default:
      return std::nullopt;
  }
}

std::optional<ClockFault::Kind> clock_kind(Kind kind, const Fields& fields) {
  switch (kind) {
    case Kind::kSkew:
      return ClockFault::Kind::kSkew;
    case Kind::kJump:
      return ClockFault::Kind::kJump;
    case Kind::kStop:
      return fields.has("clock") ? std::optional(ClockFault::Kind::kStop) : std::nullopt;
    default:
      return std::nullopt;
  }
}

std::optional<MessageFault::Kind> message_kind(Kind kind) {
  switch (kind) {
    case Kind::kDrop:
      return MessageFault::Kind::kDrop;
    case Kind::kDuplicate:
      return MessageFault::Kind::kDuplicate;
    case Kind::kCorrupt:
      return MessageFault::Kind::kCorrupt;
    case Kind::kDelay:
      return MessageFault::Kind::kDelay;
    default:
      return std::nullopt;
  }
}

// An attribute that only some faults have.
struct OwnAttribute {
  const char* name;
  std::vector<Kind> kinds;
  const char* with;
};

unsigned percent(const Template& given, Scope& scope) {
  const std::string text = given.perform(scope);
  unsigned value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  constexpr unsigned kAll = 100;
  if (error != std::errc() || std::string_view(end, text.data() + text.size()) != "%" || value == 0 || value >= kAll) {
    throw LaunchError(fmt::format("'{}' is no part of the processor", text), given.where(), "write 1% to 99%",
                      Finding::kWrongValue);
  }
  return value;
}

// What the attributes of all faults, and of those of a process, say in a scope.
struct FaultSettings {
  NumberRange at = {};
  std::optional<NumberRange> lasts = {};
  double probability = 1;
  int signal = SIGKILL;
  unsigned percent = 0;
  LimitFault limit = {};
  std::string name = {};
};

void perform_probability(const Fields& fields, Scope& scope, FaultSettings& settings) {
  NumberField probability = *fields.number("probability");
  probability.require_not_negative();
  settings.probability = probability.perform(scope);
  if (settings.probability > 1) {
    throw LaunchError(fmt::format("a probability is at most 1, got {:g}", settings.probability),
                      fields.where("probability"), {}, Finding::kWrongValue);
  }
}

// Rows without a place are read by the action.
const std::vector<Setting<FaultSettings>>& fault_settings() {
  using Type = AttributeType;
  static const std::vector<Setting<FaultSettings>> rows = {
      {.attribute = {"process", Type::kText, false, "",
                     "name of the process or of its node; all processes of that name are meant. With topic and "
                     "service: each process",
                     true}},
      {.attribute = {"do", Type::kLiteral, true, "",
                     "kill: sends it a signal; stop: it stands still; slow: it runs for a part of the time; limit: it "
                     "gets no more memory or descriptors; drop, duplicate, corrupt, delay: messages of a topic or "
                     "service are lost, come twice, with other bytes, or late; partition, lose, delay: packets "
                     "between processes are lost or late; stop, skew, jump: simulated time stands still, is faster or "
                     "slower, or jumps; fill_disk: a disk is full",
                     true}},
      range_row({"at", Type::kText, false, "0",
                 "seconds from the begin of the test, or from when all depends_on hold; a range such as 1..5, "
                 "from which the seed draws",
                 true},
                &FaultSettings::at),
      range_row(
          {"for", Type::kText, false, "until the end", "not with kill and jump: seconds, or a range of them", true},
          &FaultSettings::lasts),
      {.attribute = {"probability", Type::kFloat, false, "1", "in how many runs it happens, from 0 to 1", true},
       .place = [](FaultSettings& settings) -> SettingPlace { return NumberFromZero{&settings.probability}; },
       .perform = perform_probability},
      {.attribute = {"signal", Type::kText, false, "SIGKILL", "with kill: the name or number of the signal", true},
       .perform =
           [](const Fields& fields, Scope& scope, FaultSettings& settings) {
             settings.signal = signal_of(fields.text("signal").perform(scope), fields.where("signal"));
           },
       .checks_literal = true},
      {.attribute = {"to", Type::kText, false, "", "with slow: the part of the time in which it runs, such as 25%",
                     true},
       .perform = [](const Fields& fields, Scope& scope,
                     FaultSettings& settings) { settings.percent = percent(fields.text("to"), scope); },
       .checks_literal = true},
      {.attribute = {"memory", Type::kText, false, "none", "with limit: its address space in bytes, or with K, M or G",
                     true},
       .perform =
           [](const Fields& fields, Scope& scope, FaultSettings& settings) {
             settings.limit.memory = parse_bytes(fields.text("memory").perform(scope), fields.where("memory"));
           },
       .checks_literal = true},
      {.attribute = {"files", Type::kInteger, false, "none", "with limit: its open descriptors", true},
       .place = place_of(&FaultSettings::limit, &LimitFault::files)},
      {.attribute = {"name", Type::kText, false, "all attributes", "what tells its draws from those of other faults",
                     true},
       .place = place_of(&FaultSettings::name)},
  };
  return rows;
}

class Fault : public Action {
 public:
  explicit Fault(const Fields& fields)
      : Action(fields.where(), fields.condition()),
        kind_(static_cast<Kind>(choice(fields, "do", kKinds))),
        fields_(fields) {
    check_attributes(fields);
    check_settings(fault_settings(), fields);
    for (const Fields* const item : fields.items("depends_on")) {
      dependencies_.emplace_back(*item);
    }
    if (const auto network = network_kind(kind_, fields_)) {
      perform_ = network_fault(fields_, *network);
    } else if (const auto clock = clock_kind(kind_, fields_)) {
      perform_ = clock_fault(fields_, *clock);
    } else if (const auto messages = message_kind(kind_)) {
      perform_ = message_fault(fields_, *messages);
    } else if (kind_ == Kind::kFillDisk) {
      perform_ = disk_fault(fields_);
    }
  }

 protected:
  void execute(LaunchContext& context) const override {
    if (!context.tests().is_in_test()) {
      throw LaunchError("a fault belongs in a <test>", where(),
                        "there it may be in groups, loops and included files; at and depends_on say when it happens",
                        Finding::kWrongPlace);
    }
    Scope& scope = context.scope();
    std::vector<FaultRequest>& others = context.requests().faults;
    FaultRequest fault;
    fault.number = others.size() + 1;
    if (const char* const process = clock_kind(kind_, fields_) ? "clock" : "process"; fields_.has(process)) {
      fault.process = fields_.text(process).perform(scope);
      fault.process_where = fields_.where(process);
    }
    fault.where = where();
    FaultSettings settings;
    perform_settings(fault_settings(), fields_, scope, settings);
    const NumberRange at = settings.at;
    const double probability = settings.probability;
    const NumberRange lasts = settings.lasts.value_or(NumberRange{});
    set_what(fault, settings);
    const FaultRanges ranges = perform_ ? perform_(fault.process, scope) : FaultRanges();
    const std::string what = perform_ ? ranges.identity : describe(fault);
    fault.identity = fields_.has("name")
                         ? settings.name
                         : fmt::format("{} {}..{} {}..{} {}", what, at.from, at.to, lasts.from, lasts.to, probability);
    const auto equal = std::count_if(others.begin(), others.end(),
                                     [&](const FaultRequest& other) { return other.identity == fault.identity; });

    const FaultDraw draw(context.tests().fault_choice().seed, fmt::format("{} {}", fault.identity, equal));
    fault.at = as_duration(draw.number("at", at));
    if (settings.lasts) {
      fault.lasts = as_duration(draw.number("for", lasts));
    }
    fault.is_random = at.is_random() || lasts.is_random() || probability < 1 || ranges.is_random;
    if (ranges.draw) {
      fault.what = ranges.draw(draw);
    }
    for (std::size_t i = 0; i < dependencies_.size(); ++i) {
      fault.is_random = fault.is_random || dependencies_[i].is_random(scope);
      if (std::optional<Dependency> dependency = dependencies_[i].perform(context, draw, i)) {
        fault.dependencies.push_back(std::move(*dependency));
      }
    }
    const auto& chosen = context.tests().fault_choice().numbers;
    if (draw.share("probability") >= probability) {
      fault.left_out = "not drawn";
    } else if (chosen && !chosen->contains(fault.number)) {
      fault.left_out = "not chosen";
    }
    others.push_back(std::move(fault));
  }

 private:
  void check_attributes(const Fields& fields) const {
    static const std::vector<Kind> kOfMessages = {Kind::kDrop, Kind::kDuplicate, Kind::kCorrupt, Kind::kDelay};
    static const char* const kWithMessages = "do=\"drop\", do=\"duplicate\", do=\"corrupt\" and do=\"delay\"";
    static const std::vector<Kind> kOfNetwork = {Kind::kPartition, Kind::kLose, Kind::kDelay};
    static const char* const kWithNetwork = "do=\"partition\", do=\"lose\" and do=\"delay\"";
    static const std::array<OwnAttribute, 19> kOwn = {
        {{"signal", {Kind::kKill}, "do=\"kill\""},
         {"topic", kOfMessages, kWithMessages},
         {"service", kOfMessages, kWithMessages},
         {"node", kOfMessages, kWithMessages},
         {"on", kOfMessages, kWithMessages},
         {"occurrence", kOfMessages, kWithMessages},
         {"every", kOfMessages, kWithMessages},
         {"count", kOfMessages, kWithMessages},
         {"by", {Kind::kDelay, Kind::kJump}, "do=\"delay\" and do=\"jump\""},
         {"clock", {Kind::kStop, Kind::kSkew, Kind::kJump}, "do=\"stop\", do=\"skew\" and do=\"jump\""},
         {"rate", {Kind::kSkew}, "do=\"skew\""},
         {"group", kOfNetwork, kWithNetwork},
         {"from", kOfNetwork, kWithNetwork},
         {"share", {Kind::kLose}, "do=\"lose\""},
         {"path", {Kind::kFillDisk}, "do=\"fill_disk\""},
         {"free", {Kind::kFillDisk}, "do=\"fill_disk\""},
         {"to", {Kind::kSlow}, "do=\"slow\""},
         {"memory", {Kind::kLimit}, "do=\"limit\""},
         {"files", {Kind::kLimit}, "do=\"limit\""}}};
    for (const OwnAttribute& own : kOwn) {
      if (fields.has(own.name) && std::find(own.kinds.begin(), own.kinds.end(), kind_) == own.kinds.end()) {
        throw LaunchError(fmt::format("{} goes with {} only", own.name, own.with), fields.where(own.name), {},
                          Finding::kExclusive);
      }
    }
    if (kind_ == Kind::kKill && fields.has("for")) {
      throw LaunchError("for does not go with do=\"kill\": a kill is over at once", fields.where("for"), {},
                        Finding::kExclusive);
    }
    const bool is_of_network = network_kind(kind_, fields).has_value();
    if (is_of_network) {
      for (const char* const other : {"process", "topic", "service", "node", "on", "occurrence", "every", "count"}) {
        if (fields.has(other)) {
          throw LaunchError(fmt::format("{} does not go with a fault of the network", other), fields.where(other),
                            "group and from name the processes", Finding::kExclusive);
        }
      }
    }
    const bool is_of_clock = clock_kind(kind_, fields).has_value();
    if (is_of_clock && fields.has("process")) {
      throw LaunchError("either a process or a clock suffers", fields.where("process"), {}, Finding::kExclusive);
    }
    if (kind_ == Kind::kFillDisk && fields.has("process")) {
      throw LaunchError("process does not go with do=\"fill_disk\": all processes of the test share the disk",
                        fields.where("process"), {}, Finding::kExclusive);
    }
    const bool has_process = !is_of_network && !is_of_clock && !message_kind(kind_) && kind_ != Kind::kFillDisk;
    if (!fields.has("process") && has_process) {
      throw LaunchError("it is not said which process suffers", fields.where(),
                        "process=\"…\": the name of the process or of its node", Finding::kMissingAttribute);
    }
    if (kind_ == Kind::kSlow && !fields.has("to")) {
      throw LaunchError("it is not said how slow the process is", fields.where(), "to=\"25%\": a quarter of the time",
                        Finding::kMissingAttribute);
    }
    if (kind_ == Kind::kLimit && !fields.has("memory") && !fields.has("files")) {
      throw LaunchError("it is not said what is limited", fields.where(), "give memory, files or both",
                        Finding::kMissingAttribute);
    }
  }

  void set_what(FaultRequest& fault, const FaultSettings& settings) const {
    switch (kind_) {
      case Kind::kKill:
        fault.what = KillFault{settings.signal};
        break;
      case Kind::kStop:
        fault.what = StopFault{};
        break;
      case Kind::kSlow:
        fault.what = SlowFault{settings.percent};
        break;
      case Kind::kLimit:
        fault.what = settings.limit;
        break;
      default:
        break;  // of messages
    }
  }

  Kind kind_;
  Fields fields_;
  PerformFault perform_;  // null for a fault of a process
  std::vector<DependsOn> dependencies_;
};

}  // namespace

ActionType fault_action() {
  ActionType type{
      .tag = "fault",
      .help =
          "In a test: does something to a process, to messages, to the network, to simulated time or to a disk, at a "
          "time "
          "or when something is ready.",
      .attributes = declared_attributes(fault_settings()),
      .items = {DependsOn::item_of_fault()},
      .extension = true,
      .make = [](const Fields& fields) { return std::make_shared<Fault>(fields); }};
  for (const std::vector<AttributeSpec>& more :
       {message_fault_attributes(), network_fault_attributes(), clock_fault_attributes(), disk_fault_attributes()}) {
    type.attributes.insert(type.attributes.end(), more.begin(), more.end());
  }
  return type;
}

}  // namespace launch
