// SPDX-License-Identifier: Apache-2.0
/// A GetViews request, read and checked.
#pragma once

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "semview/core/result.hpp"
#include "semview/geometry/pose_grid.hpp"
#include "semview/raycast/panorama_renderer.hpp"
#include "semview/raycast/pinhole_renderer.hpp"
#include "semview/service/limits.hpp"
#include "semview/service/site.hpp"
#include "semview/v1/views.pb.h"

namespace semview::server {

struct ViewEncoding {
  bool runs = true;
  bool packed = false;  ///< runs as one string of bytes; never without `runs`
  bool ranges = false;
};

/// What views are wanted: either those of grid cells, or exact panoramas, or pinhole images.
struct ViewRequest {
  std::shared_ptr<service::Site> site;
  ViewEncoding encoding;
  std::size_t views = 0;
  int rows = 0;
  int columns = 0;

  /// A view of the answer that comes from a cell.
  struct Use {
    std::size_t view = 0;
    int heading = 0;
  };
  std::vector<CellIndex> cells;        ///< distinct, in the order of first use
  std::vector<std::vector<Use>> uses;  ///< of each cell
  std::vector<raycast::PanoramaRequest> panoramas;
  std::vector<raycast::PinholeRequest> pinholes;
};

/// @errors kInvalidArgument, kResourceExhausted, with the message's field.
Result<ViewRequest> read_view_request(std::shared_ptr<service::Site> site,
                                      const v1::GetViewsRequest& wire,
                                      const service::Limits& limits);

}  // namespace semview::server
