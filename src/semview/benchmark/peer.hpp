// SPDX-License-Identifier: Apache-2.0
/// Other people's programs to compare with, each a small library of bench/peers that is loaded only
/// when it is asked for: the programs of semview need none of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "semview/core/result.hpp"
#include "semview/map/triangle_mesh.hpp"
#include "semview/view/column_view.hpp"

namespace semview::benchmark {

/// Casts rays at a mesh.
class CasterPeer {
 public:
  virtual ~CasterPeer() = default;

  /// Six numbers a ray: origin, direction. Returns the images' number, for `cast`.
  virtual std::size_t add_rays(std::span<const float> rays) = 0;
  /// Casts the rays of one image in the calling thread and keeps what they hit.
  virtual void cast(std::size_t image) = 0;
  /// What `cast` kept, one a ray: the triangle (past the mesh for none), and the parameter.
  virtual std::vector<std::uint32_t> triangles(std::size_t image) const = 0;
  virtual std::vector<float> parameters(std::size_t image) const = 0;
};

/// Scores views at all headings.
class MatchPeer {
 public:
  virtual ~MatchPeer() = default;
  /// The numerators of equation (1) at all 120 headings; `view` at heading 0.
  virtual std::vector<float> headings(const LabelImage& view) const = 0;
};

/// One image a map class, class 0 first: the weight of that class under each observed pixel.
using WeightImages = std::vector<Image<float>>;

// What a peer's library exports, one of the two.
using MakeCasterPeer = CasterPeer* (*)(const map::TriangleMesh&);
using MakeMatchPeer = MatchPeer* (*)(const WeightImages&);
inline constexpr const char* kCasterPeerSymbol = "semview_make_caster_peer";
inline constexpr const char* kMatchPeerSymbol = "semview_make_match_peer";

/// `open3d`: RaycastingScene of Debian's Open3D.
/// @errors kNotFound: its library is not beside the program; the message says how to get it.
Result<std::unique_ptr<CasterPeer>> open_caster_peer(const map::TriangleMesh& mesh);

/// `opencv`: matchTemplate.
/// @errors as above
Result<std::unique_ptr<MatchPeer>> open_match_peer(const WeightImages& weights);

/// The folder `peers` beside the running program, where bench/ builds them.
std::string peers_folder();

}  // namespace semview::benchmark
