// SPDX-License-Identifier: Apache-2.0
#include "raw_classes.hpp"

namespace semview::paper2017 {

const ClassTable& raw_classes() {
  static const ClassTable kTable(
      {"wall",    "floor",        "ceiling", "door",    "windowpane", "table",
       "desk",    "swivel chair", "chair",   "cabinet", "shelf",      "chest of drawers",
       "sink",    "painting",     "poster",  "light",   "curtain",    "radiator",
       "monitor", "box",          "plant",   "person"});
  return kTable;
}

}  // namespace semview::paper2017
