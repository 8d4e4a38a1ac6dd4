// SPDX-License-Identifier: Apache-2.0
#include "semview/raycast/column_scene.hpp"

namespace semview::raycast {

ColumnScene::ColumnScene(const map::ColumnMap& plan)
    : plan_(plan), grid_(build_column_grid(plan)) {}

ColumnScene ColumnScene::build(const map::ColumnMap& plan) { return ColumnScene(plan); }

}  // namespace semview::raycast
