// SPDX-License-Identifier: Apache-2.0
#include "graph.hpp"

#include <stdexcept>
#include <utility>

namespace reference_system {

namespace {

using std::chrono::milliseconds;

NodeDescription sensor(const std::string& name, int period_ms) {
  return {name, Kind::Sensor, {}, {name}, milliseconds(period_ms)};
}

NodeDescription transform(const std::string& name, const std::string& input) {
  return {name, Kind::Transform, {input}, {name}};
}

NodeDescription fusion(const std::string& name, std::vector<std::string> inputs) {
  return {name, Kind::Fusion, std::move(inputs), {name}};
}

}  // namespace

const std::vector<NodeDescription>& graph() {
  static const std::vector<NodeDescription> nodes = {
      sensor("FrontLidarDriver", 100),
      sensor("RearLidarDriver", 100),
      sensor("PointCloudMap", 120),
      sensor("Visualizer", 60),
      sensor("Lanelet2Map", 100),
      sensor("EuclideanClusterSettings", 25),

      transform("PointsTransformerFront", "FrontLidarDriver"),
      transform("PointsTransformerRear", "RearLidarDriver"),
      transform("VoxelGridDownsampler", "PointCloudFusion"),
      transform("PointCloudMapLoader", "PointCloudMap"),
      transform("RayGroundFilter", "PointCloudFusion"),
      transform("ObjectCollisionEstimator", "EuclideanClusterDetector"),
      transform("MPCController", "BehaviorPlanner"),
      transform("ParkingPlanner", "Lanelet2MapLoader"),
      transform("LanePlanner", "Lanelet2MapLoader"),

      fusion("PointCloudFusion", {"PointsTransformerFront", "PointsTransformerRear"}),
      fusion("NDTLocalizer", {"VoxelGridDownsampler", "PointCloudMapLoader"}),
      fusion("VehicleInterface", {"MPCController", "BehaviorPlanner"}),
      fusion("Lanelet2GlobalPlanner", {"Visualizer", "NDTLocalizer"}),
      fusion("Lanelet2MapLoader", {"Lanelet2Map", "Lanelet2GlobalPlanner"}),

      {"BehaviorPlanner",
       Kind::Cyclic,
       {"ObjectCollisionEstimator", "NDTLocalizer", "Lanelet2GlobalPlanner", "Lanelet2MapLoader", "ParkingPlanner",
        "LanePlanner"},
       {"BehaviorPlanner"},
       milliseconds(100)},

      {"EuclideanClusterDetector",
       Kind::Intersection,
       {"RayGroundFilter", "EuclideanClusterSettings"},
       {"EuclideanClusterDetector", "EuclideanIntersection"}},

      {"VehicleDBWSystem", Kind::Command, {"VehicleInterface"}, {}},
      {"IntersectionOutput", Kind::Command, {"EuclideanIntersection"}, {}},
  };
  return nodes;
}

const NodeDescription& find(const std::string& name) {
  std::string known;
  for (const NodeDescription& node : graph()) {
    if (node.name == name) {
      return node;
    }
    known += (known.empty() ? "" : ", ") + node.name;
  }
  throw std::invalid_argument("there is no node '" + name + "' in the reference system: it has " + known);
}

namespace {

void collect_nodes_before(const std::string& topic, std::set<std::string>& nodes) {
  for (const NodeDescription& node : graph()) {
    for (size_t i = 0; i < node.outputs.size(); ++i) {
      if (node.outputs[i] != topic || !nodes.insert(node.name).second) {
        continue;
      }
      if (node.kind == Kind::Intersection) {
        collect_nodes_before(node.inputs[i], nodes);
      } else {
        for (const std::string& input : node.inputs) {
          collect_nodes_before(input, nodes);
        }
      }
    }
  }
}

}  // namespace

std::set<std::string> nodes_before(const std::string& topic) {
  std::set<std::string> nodes;
  collect_nodes_before(topic, nodes);
  return nodes;
}

}  // namespace reference_system
