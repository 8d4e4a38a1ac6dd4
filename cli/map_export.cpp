// SPDX-License-Identifier: Apache-2.0
/// `semview map export`.
#include <array>
#include <filesystem>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "map_verbs.hpp"
#include "semview/io/output_path.hpp"
#include "semview/map/extrusion.hpp"
#include "semview/map/gltf_write.hpp"
#include "semview/map/semantic_map.hpp"
#include "verb.hpp"

namespace semview::cli {
namespace {

struct Options {
  std::string map;
  std::string output;
  map::LoadOptions load;
};

Status export_map(const Options& options) {
  if (std::filesystem::path(options.output).extension() != ".glb") {
    return fail(ErrorCode::kInvalidArgument,
                fmt::format("OUT: {}: expected a name that ends in .glb", options.output));
  }
  SEMVIEW_TRY_STATUS(io::check_output_file(options.output));
  SEMVIEW_TRY_STATUS(io::check_is_no_input(options.output, std::array{options.map}));
  SEMVIEW_TRY(const map::SemanticMap map, map::load_map(options.map, options.load));
  const map::TriangleMesh mesh =
      map.columns() != nullptr ? map::extrude(*map.columns()) : map.mesh()->mesh;
  SEMVIEW_TRY_STATUS(map::write_glb(map, mesh, options.output));
  fmt::print("{}: {} triangles, {} vertices\n",
             options.output,
             mesh.triangles.size(),
             mesh.vertices.size());
  return {};
}

}  // namespace

void add_map_export(CLI::App& map, int& exit_code) {
  CLI::App* verb = map.add_subcommand(
      "export",
      "Write a map as a labelled 3D mesh, binary glTF 2.0 (.glb): one mesh and material a class, "
      "named after it and in its colour. Any 3D viewer shows it, and semview reads it as a map.");
  const auto options = std::make_shared<Options>();
  verb->add_option("MAP", options->map, "Map folder, map.yaml, .glb or .vdb")->required();
  verb->add_option("OUT", options->output, "The .glb file to write")->required();
  add_nearest_colour(*verb, options->load);
  verb->footer("Example: semview map export maps/duplex_level1 duplex.glb");
  verb->callback([options, &exit_code] { exit_code = report(export_map(*options)); });
}

}  // namespace semview::cli
