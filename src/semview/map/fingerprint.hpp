// SPDX-License-Identifier: Apache-2.0
/// The identity of a map's content.
#pragma once

#include "semview/core/hash.hpp"
#include "semview/map/semantic_map.hpp"

namespace semview::map {

/// Hashes what decides the map's views, in this order: class names, ground, ceiling, then the
/// columns (resolution, origin, size, profiles, pixels) or the mesh (vertices, triangles, labels).
/// Id, name, colours, `movable`, aliases and how files encode all this are not part of it. The
/// exact bytes stand in docs/formats/map_bundle.md.
Fingerprint fingerprint_of(const SemanticMap& map);

}  // namespace semview::map
