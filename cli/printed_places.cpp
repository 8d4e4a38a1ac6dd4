// SPDX-License-Identifier: Apache-2.0
#include "printed_places.hpp"

#include <array>

#include <fmt/format.h>

namespace semview::cli {
namespace {

struct Printed {
  const char* method;
  const char* input;
  const char* result;
};
constexpr const char* kNoSource = "not printed here: no source at hand";
constexpr std::array<Printed, 5> kPrinted = {{
    {"LaLaLoc (2021)",
     "RGB panorama; Structured3D; the storey's layout with its ceiling height",
     "\"to within 8.3 cm\""},
    {"LASER (2022)",
     "RGB panorama; ZInD; 2D floor map",
     "97 % recall, median error 5 cm and 0.47 deg (readme of its repository)"},
    {"SPVLoc (2024)",
     "RGB perspective image, 6 degrees of freedom (harder); Structured3D; model with doors and "
     "windows",
     "33.5 / 81.6 / 84.2 % within 0.1 m / 0.5 m / 1 m and 30 deg"},
    {"F3Loc (2024)", "RGB perspective images; Gibson; floor plan", kNoSource},
    {"SemRayLoc (2025)",
     "RGB perspective image; Structured3D and ZInD; floor plan with doors and windows",
     kNoSource},
}};

}  // namespace

std::string printed_by_others() {
  std::string text = "\nPrinted by others, on their own pictures and buildings:\n";
  for (const Printed& printed : kPrinted) {
    text += fmt::format(
        "  {:<16} {}\n  {:<16} {}\n", printed.method, printed.result, "", printed.input);
  }
  return text;
}

}  // namespace semview::cli
