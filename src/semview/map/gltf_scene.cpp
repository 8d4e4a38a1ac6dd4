// SPDX-License-Identifier: Apache-2.0
#include "semview/map/gltf_scene.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "semview/map/gltf_accessor.hpp"

namespace semview::map::detail {
namespace {

constexpr double kMaxCoordinate_m = 1.0e6;
constexpr std::size_t kMaxNameBytes = 200;

std::optional<std::string> class_of_extras(const tinygltf::Value& extras) {
  if (!extras.IsObject() || !extras.Has("semview")) return std::nullopt;
  const tinygltf::Value& ours = extras.Get("semview");
  if (!ours.IsObject() || !ours.Has("class") || !ours.Get("class").IsString()) return std::nullopt;
  return ours.Get("class").Get<std::string>();
}

/// Places in a list of `count`, as triangles: `emit(a, b, c)`.
template <typename Emit>
void for_each_triangle(int mode, std::size_t count, const Emit& emit) {
  if (mode == TINYGLTF_MODE_TRIANGLES) {
    for (std::size_t k = 0; k + 2 < count; k += 3) emit(k, k + 1, k + 2);
  } else if (mode == TINYGLTF_MODE_TRIANGLE_STRIP) {
    for (std::size_t k = 0; k + 2 < count; ++k) emit(k, k + 1 + k % 2, k + 2 - k % 2);
  } else if (mode == TINYGLTF_MODE_TRIANGLE_FAN) {
    for (std::size_t k = 1; k + 1 < count; ++k) emit(k, k + 1, std::size_t{0});
  }
}

Result<Eigen::Matrix4d> parent_from_node(const tinygltf::Node& node) {
  const auto damaged = [] {
    return fail(ErrorCode::kDataLoss, "a transform of the wrong length or without meaning");
  };
  const auto fits = [](const std::vector<double>& values, std::size_t size) {
    return (values.empty() || values.size() == size) &&
           std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
  };
  if (!fits(node.matrix, 16) || !fits(node.translation, 3) || !fits(node.rotation, 4) ||
      !fits(node.scale, 3)) {
    return damaged();
  }
  if (!node.matrix.empty())
    return Eigen::Matrix4d(Eigen::Map<const Eigen::Matrix4d>(node.matrix.data()));
  Eigen::Affine3d transform = Eigen::Affine3d::Identity();
  if (!node.translation.empty()) transform.translate(Eigen::Vector3d(node.translation.data()));
  if (!node.rotation.empty()) {
    const Eigen::Quaterniond q(
        node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]);
    if (!(q.norm() > 1e-6)) return damaged();
    // A quarter turn written as a quaternion must not smear zero coordinates.
    transform.rotate(Eigen::Matrix3d(q.normalized().toRotationMatrix().unaryExpr(
        [](double v) { return std::abs(v - std::round(v)) < 1e-12 ? std::round(v) : v; })));
  }
  if (!node.scale.empty()) transform.scale(Eigen::Vector3d(node.scale.data()));
  return transform.matrix();
}

class SceneReader {
 public:
  SceneReader(const tinygltf::Model& model, std::string_view name) : model_(model), name_(name) {}

  Result<LabelledMesh> read() {
    Eigen::Matrix4d z_up_from_y_up;
    z_up_from_y_up << 1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1;
    SEMVIEW_TRY(const std::vector<int> roots, root_nodes());
    std::vector<std::pair<int, Eigen::Matrix4d>> open;
    for (const int root : roots) open.emplace_back(root, z_up_from_y_up);
    std::reverse(open.begin(), open.end());
    std::vector<bool> seen(model_.nodes.size(), false);
    while (!open.empty()) {
      const auto [index, map_from_parent] = open.back();
      open.pop_back();
      if (index < 0 || static_cast<std::size_t>(index) >= seen.size()) {
        return damaged(fmt::format("there is no node {}", index));
      }
      const auto place = static_cast<std::size_t>(index);
      if (seen[place]) return damaged(fmt::format("node {} has two parents", index));
      seen[place] = true;
      const tinygltf::Node& node = model_.nodes[place];
      Result<Eigen::Matrix4d> step = parent_from_node(node);
      if (!step) return with_context(std::move(step), fmt::format("{}: node {}", name_, index));
      const Eigen::Matrix4d map_from_node = map_from_parent * *step;
      if (node.mesh >= 0) SEMVIEW_TRY_STATUS(add_mesh(node, map_from_node));
      for (auto child = node.children.rbegin(); child != node.children.rend(); ++child) {
        open.emplace_back(*child, map_from_node);
      }
    }
    if (result_.mesh.triangles.empty()) {
      return fail(ErrorCode::kInvalidArgument,
                  fmt::format("{}: there is no triangle in it", name_));
    }
    sort_names();
    return std::move(result_);
  }

 private:
  tl::unexpected<Error> damaged(std::string_view what) const {
    return fail(ErrorCode::kDataLoss, fmt::format("{}: {}", name_, what));
  }

  Result<std::vector<int>> root_nodes() const {
    if (!model_.scenes.empty()) {
      const int scene = std::max(model_.defaultScene, 0);
      if (static_cast<std::size_t>(scene) >= model_.scenes.size()) {
        return damaged(fmt::format("there is no scene {}", scene));
      }
      return model_.scenes[static_cast<std::size_t>(scene)].nodes;
    }
    std::vector<bool> is_child(model_.nodes.size(), false);
    for (const tinygltf::Node& node : model_.nodes) {
      for (const int child : node.children) {
        if (child >= 0 && static_cast<std::size_t>(child) < is_child.size()) {
          is_child[static_cast<std::size_t>(child)] = true;
        }
      }
    }
    std::vector<int> roots;
    for (std::size_t k = 0; k < is_child.size(); ++k) {
      if (!is_child[k]) roots.push_back(static_cast<int>(k));
    }
    return roots;
  }

  Result<Elements> elements_of(int accessor, int type, const std::string& what) const {
    return accessor_elements(model_, accessor, type, fmt::format("{}: {}", name_, what));
  }

  Status add_mesh(const tinygltf::Node& node, const Eigen::Matrix4d& map_from_node) {
    if (static_cast<std::size_t>(node.mesh) >= model_.meshes.size()) {
      return damaged(fmt::format("there is no mesh {}", node.mesh));
    }
    const tinygltf::Mesh& mesh = model_.meshes[static_cast<std::size_t>(node.mesh)];
    for (std::size_t p = 0; p < mesh.primitives.size(); ++p) {
      const tinygltf::Primitive& primitive = mesh.primitives[p];
      const int mode = primitive.mode;
      if (mode >= TINYGLTF_MODE_POINTS && mode <= TINYGLTF_MODE_LINE_STRIP) continue;
      const std::string what = fmt::format("mesh {} primitive {}", node.mesh, p);
      if (mode < 0 || mode > TINYGLTF_MODE_TRIANGLE_FAN) {
        return damaged(fmt::format("{}: there is no mode {}", what, mode));
      }
      SEMVIEW_TRY(const ClassId label, label_of(node, mesh, primitive, what));
      SEMVIEW_TRY_STATUS(add_primitive(primitive, map_from_node, label, what));
    }
    return {};
  }

  Status add_primitive(const tinygltf::Primitive& primitive,
                       const Eigen::Matrix4d& map_from_node,
                       ClassId label,
                       const std::string& what) {
    const auto position = primitive.attributes.find("POSITION");
    if (position == primitive.attributes.end()) return damaged(what + ": it has no positions");
    SEMVIEW_TRY(const Elements points, elements_of(position->second, TINYGLTF_TYPE_VEC3, what));
    Elements order;
    order.count = points.count;
    if (primitive.indices >= 0) {
      SEMVIEW_TRY(order, elements_of(primitive.indices, TINYGLTF_TYPE_SCALAR, what));
    }
    TriangleMesh& mesh = result_.mesh;
    if (points.count > kMaxMeshVertices - mesh.vertices.size() ||
        order.count > kMaxMeshTriangles - mesh.triangles.size()) {
      return fail(ErrorCode::kResourceExhausted,
                  fmt::format("{}: more than 50 million vertices or triangles", name_));
    }
    const auto base = static_cast<std::uint32_t>(mesh.vertices.size());
    for (std::size_t k = 0; k < points.count; ++k) {
      const Eigen::Vector4d point(
          points.get<float>(k, 0), points.get<float>(k, 1), points.get<float>(k, 2), 1.0);
      const Eigen::Vector3d point_map = (map_from_node * point).head<3>();
      if (!(point_map.cwiseAbs().maxCoeff() <= kMaxCoordinate_m)) {
        return fail(
            ErrorCode::kInvalidArgument,
            fmt::format("{}: {}: vertex {} is not finite or beyond 1000 km", name_, what, k));
      }
      mesh.vertices.push_back(point_map.cast<float>());
    }
    for (std::size_t k = 0; primitive.indices >= 0 && k < order.count; ++k) {
      if (order.index(k) >= points.count) {
        return damaged(fmt::format("{}: index {} is {}, but there are {} vertices",
                                   what,
                                   k,
                                   order.index(k),
                                   points.count));
      }
    }
    const bool mirrored = map_from_node.topLeftCorner<3, 3>().determinant() < 0.0;
    for_each_triangle(
        primitive.mode, order.count, [&](std::size_t i, std::size_t j, std::size_t k) {
          const auto vertex = [&](std::size_t place) {
            return base + (primitive.indices >= 0 ? order.index(place)
                                                  : static_cast<std::uint32_t>(place));
          };
          const std::array<std::uint32_t, 3> corners{
              vertex(i), vertex(mirrored ? k : j), vertex(mirrored ? j : k)};
          if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0])
            return;
          mesh.triangles.push_back(corners);
          mesh.labels.push_back(label);
        });
    return {};
  }

  Result<ClassId> label_of(const tinygltf::Node& node,
                           const tinygltf::Mesh& mesh,
                           const tinygltf::Primitive& primitive,
                           const std::string& what) {
    const tinygltf::Material* material = nullptr;
    if (primitive.material >= 0) {
      if (static_cast<std::size_t>(primitive.material) >= model_.materials.size()) {
        return damaged(fmt::format("{}: there is no material {}", what, primitive.material));
      }
      material = &model_.materials[static_cast<std::size_t>(primitive.material)];
    }
    std::optional<std::string> found;
    if (material != nullptr) found = class_of_extras(material->extras);
    if (!found) found = class_of_extras(mesh.extras);
    if (!found) found = class_of_extras(node.extras);
    std::string class_name = found.value_or("");
    for (const std::string* other :
         {material != nullptr ? &material->name : nullptr, &node.name, &mesh.name}) {
      if (class_name.empty() && other != nullptr) class_name = *other;
    }
    if (class_name.empty() || class_name.size() > kMaxNameBytes) {
      return fail(ErrorCode::kInvalidArgument,
                  fmt::format("{}: {}: no class: name its material, node or mesh after one "
                              "(at most {} bytes)",
                              name_,
                              what,
                              kMaxNameBytes));
    }
    const auto next = static_cast<ClassId>(names_.size() + 1);
    const auto [place, is_new] = names_.try_emplace(class_name, next);
    if (is_new && names_.size() > static_cast<std::size_t>(kMaxClasses)) {
      return fail(ErrorCode::kInvalidArgument,
                  fmt::format("{}: more than {} classes", name_, kMaxClasses));
    }
    return place->second;
  }

  void sort_names() {
    std::array<bool, 256> used{};
    for (const ClassId label : result_.mesh.labels) used[label] = true;
    std::array<ClassId, 256> sorted{};
    for (const auto& [class_name, label] : names_) {  // a map: already in order
      if (!used[label]) continue;
      result_.class_names.push_back(class_name);
      sorted[label] = static_cast<ClassId>(result_.class_names.size());
    }
    for (ClassId& label : result_.mesh.labels) label = sorted[label];
  }

  const tinygltf::Model& model_;
  std::string_view name_;
  std::map<std::string, ClassId> names_;  // ids in order of appearance
  LabelledMesh result_;
};

}  // namespace

Result<LabelledMesh> read_scene(const tinygltf::Model& model, std::string_view name) {
  return SceneReader(model, name).read();
}

}  // namespace semview::map::detail
