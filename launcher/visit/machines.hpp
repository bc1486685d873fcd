// SPDX-License-Identifier: Apache-2.0
// The machines that a launch file declares, and who connects to them.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/diagnostics/source.hpp"
#include "launcher/process/event_loop.hpp"
#include "launcher/substitution/machine_view.hpp"

namespace launch {

class MachineRecorders;

// The name of this machine.
inline constexpr const char* kLocalMachine = "local";

// What a <machine> says.
struct MachineDeclaration {
  std::string name;
  std::string connect;                           // the command that leads there; kLocalMachine: it is this machine
  std::string launch = "launch";                 // the program there
  std::string setup;                             // a file that is sourced there before anything else
  Duration keepalive = std::chrono::seconds(5);  // a connection that is silent for so long is lost
  Duration connect_timeout = std::chrono::seconds(30);  // until launch must have answered there
  // When the connection is lost: what runs there ends after the grace; or it goes on, the launcher connects again, and
  // what runs ends when that has not worked for `keep_for`.
  bool keep = false;
  Duration grace{0};
  Duration keep_for = std::chrono::minutes(5);
  SourceRange where;  // none: the command line
  SourceRange connect_where;

  bool is_local() const { return connect == kLocalMachine; }
  // Whether both say the same, wherever they stand.
  bool same_as(const MachineDeclaration& other) const;
};

// The connection to a machine has ended before the launch, or is cut for now.
struct LostMachine {
  std::string name;
  std::string reason;     // in one line
  std::string processes;  // what ran there: "talker-1, listener-2"
};

// The connection to a machine was cut and is made again. What ran there has gone on.
struct ReturnedMachine {
  std::string name;
  Duration away{0};
  std::uint64_t dropped = 0;  // lines of output
};

// What an <assign_machine> says: processes that fit all its patterns run on the machine, whatever their launch file
// says.
struct MachineAssignment {
  std::string machine;
  // Patterns of the shell; empty: any. Namespaces below one that fits, fit too.
  std::string package;
  std::string name_space;
  std::string process;  // label without its number, or name of the node
  SourceRange where;
  bool used = false;
};

// What assignments go by.
struct AssignableProcess {
  std::string package;
  std::string name_space;
  std::vector<std::string> names;
};

// Connects to machines. A real one is in launcher/machines; a plan has none.
class MachineConnector {
 public:
  virtual ~MachineConnector() = default;

  // Begins to connect, without waiting.
  virtual void connect(const MachineDeclaration& machine) = 0;
  // Waits until the machine has answered. Throws LaunchError at the place of the declaration.
  virtual std::shared_ptr<MachineView> await(const MachineDeclaration& machine) = 0;
  // For traces of the machines (launcher/traced/machine_recorder.hpp); null if none can be recorded. They live as long
  // as the connector.
  virtual MachineRecorders* recorders() { return nullptr; }
};

class Machines {
 public:
  // The connector must outlive the machines.
  void use_connector(MachineConnector& connector) { connector_ = &connector; }
  // Nobody is asked: what only a machine knows has a text in its place.
  void plan_only() { plan_only_ = true; }
  // Why no machine can be reached by this launch; empty: they can.
  void refuse(std::string reason) { refusal_ = std::move(reason); }

  // `launch --machine NAME=COMMAND`: the command counts instead of the one of the launch file, and the machine needs no
  // declaration.
  void set_commands(std::map<std::string, std::string> commands);

  // Throws LaunchError for a name that another declaration has given to another machine, or that is none.
  void declare(MachineDeclaration machine);
  // Throws LaunchError for a name that no declaration has.
  void require_declared(const std::string& name, const SourceRange& where);
  // What set_commands() named in vain so far, each in a sentence: nothing declares such a machine or runs on it.
  std::vector<std::string> unused_commands() const;
  // The machine of this name, connected; null for this one. Throws LaunchError: at `where` for an unknown name, at the
  // place of its declaration if there is no connection.
  std::shared_ptr<MachineView> find(const std::string& name, const SourceRange& where);

  void assign(MachineAssignment assignment) { assignments_.push_back(std::move(assignment)); }
  bool has_assignments() const { return !assignments_.empty(); }
  // The first assignment that fits, and notes that it was used; null if there is none.
  const MachineAssignment* assigned(const AssignableProcess& process);
  // Those that no process has fit.
  std::vector<const MachineAssignment*> unused_assignments() const;
  std::vector<MachineAssignment> take_assignments() { return std::exchange(assignments_, {}); }
  void put_assignments(std::vector<MachineAssignment> assignments) { assignments_ = std::move(assignments); }

  // A file must be there when the visit is over; all are asked for at once then. Without it the visit fails, or `warn`
  // is called.
  void expect_file(const std::shared_ptr<MachineView>& machine, std::string path, const SourceRange& where,
                   std::function<void()> warn = {});
  void check_files();
  void forget_files() { files_.clear(); }

  // For traces of other machines; null if no machine is asked for anything.
  MachineRecorders* recorders() const { return connector_ == nullptr ? nullptr : connector_->recorders(); }

  // Of other machines, in the order of their names.
  std::vector<const MachineDeclaration*> elsewhere() const;

  // A trace of all machines has a setting, at `where`, that works on this machine only. Throws LaunchError if another
  // machine is in use; from now on find() throws for other machines.
  void require_only_this_machine(const SourceRange& where);
  void forget_trace() { trace_of_all_ = {}; }

 private:
  struct ExpectedFile {
    std::string path;
    SourceRange where;
    std::function<void()> warn;
  };

  MachineConnector* connector_ = nullptr;
  bool plan_only_ = false;
  std::string refusal_;
  std::map<std::string, MachineDeclaration> declared_;
  std::map<std::string, std::string> commands_;  // of the command line
  std::set<std::string> unused_commands_;        // their names
  std::map<std::string, std::shared_ptr<MachineView>> views_;
  std::vector<MachineAssignment> assignments_;
  std::map<std::shared_ptr<MachineView>, std::vector<ExpectedFile>> files_;
  SourceRange trace_of_all_;
};

// Makes the scope one of that machine, for good. `initial` is the environment of this machine before
// a launch file has changed it.
void move_to_machine(Scope& scope, const std::shared_ptr<MachineView>& machine, const Environment& initial);

// In which a request to the graph of ROS 2 is made for a process of this scope: that of this machine, because requests
// are made here, in the domain of the process.
Environment graph_environment(const Scope& scope, const Environment& of_process);

}  // namespace launch
