// SPDX-License-Identifier: Apache-2.0
#include "picture_set.hpp"

#include <cctype>
#include <cmath>
#include <sstream>
#include <utility>

#include <fmt/format.h>

#include "semview/core/log.hpp"
#include "semview/geometry/angle.hpp"
#include "semview/io/observation_folder.hpp"
#include "semview/io/text_file.hpp"
#include "semview/map/semantic_map.hpp"
#include "semview/raycast/panorama_renderer.hpp"
#include "semview/raycast/scene.hpp"
#include "semview/simulation/photograph.hpp"
#include "semview/view/observation_resampler.hpp"
#include "verb.hpp"

namespace semview::cli {
namespace {

constexpr std::size_t kMaxListBytes = std::size_t{16} << 20U;
/// Photographs are finer than the views that they are compared with.
constexpr int kFiner = 2;

Observation take_picture(const raycast::Scene& scene,
                         const raycast::PanoramaRequest& request,
                         const std::vector<simulation::ClassFate>& fates,
                         const PanoramaCamera& profile,
                         Rng& rng) {
  const raycast::Panorama truth = raycast::render_panorama(scene, request);
  const simulation::LabelGeometry geometry{
      kTwoPi / request.camera.columns,
      (request.camera.elevation_max_rad - request.camera.elevation_min_rad) / request.camera.rows,
      true};
  const LabelImage seen = simulation::photograph(truth.labels, geometry, fates, {}, rng);
  PartialPanorama camera;
  camera.columns = request.camera.columns;
  camera.rows = request.camera.rows;
  camera.elevation_min_rad = request.camera.elevation_min_rad;
  camera.elevation_max_rad = request.camera.elevation_max_rad;
  return {ClassTable(simulation::photograph_classes()), resample(seen, camera, profile), 0.0, {}};
}

/// A photograph's name, where there is no folder of that name: "a.jpg" or "left.png;right.png".
bool names_photographs(const std::filesystem::path& folder, const std::string& name) {
  if (std::filesystem::is_directory(folder / name)) return false;
  std::string ending = std::filesystem::path(name).extension().string();
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return ending == ".jpg" || ending == ".jpeg" || ending == ".png";
}

Result<Observation> read_picture(const std::filesystem::path& folder,
                                 const std::string& name,
                                 const PanoramaCamera& profile,
                                 const PhotoLabeller* labeller) {
  if (!names_photographs(folder, name)) return io::read_observation(folder / name, profile);
  if (labeller == nullptr) {
    return fail(ErrorCode::kInvalidArgument,
                fmt::format("{} is a photograph; expected the folder of an observation, which "
                            "`semview observe` makes of it",
                            name));
  }
  std::vector<std::filesystem::path> files;
  std::istringstream names(name);
  for (std::string file; std::getline(names, file, ';');) files.push_back(folder / file);
  log_info(fmt::format("labelling {}", name));
  return labeller->observe(files, 0.0, profile);
}

}  // namespace

Result<std::vector<KnownPicture>> read_picture_list(const std::filesystem::path& path,
                                                    const map::CellGrid& cells,
                                                    const PanoramaCamera& profile,
                                                    const PhotoLabeller* labeller) {
  SEMVIEW_TRY(const std::string text, io::read_text_file(path, kMaxListBytes));
  std::vector<KnownPicture> pictures;
  std::istringstream lines(text);
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (line.empty() || line.starts_with('#')) continue;
    const std::size_t comma = line.find(',');
    const auto numbers =
        parse_numbers("", comma == std::string::npos ? std::string() : line.substr(comma + 1), 3);
    if (!numbers) {
      if (number == 1) continue;  // names of the columns
      return fail(
          ErrorCode::kInvalidArgument,
          fmt::format(
              "{}:{}: expected picture,x_m,y_m,yaw_deg, found '{}'", path.string(), number, line));
    }
    const auto cell = PoseGrid::cell((*numbers)[0], (*numbers)[1]);
    if (!cell || !cells.contains(*cell)) {
      return fail(ErrorCode::kInvalidArgument,
                  fmt::format("{}:{}: ({:g}, {:g}) is not on the map; expected its metres",
                              path.string(),
                              number,
                              (*numbers)[0],
                              (*numbers)[1]));
    }
    const std::string name = line.substr(0, comma);
    Result<Observation> observation = read_picture(path.parent_path(), name, profile, labeller);
    if (!observation) {
      return with_context(std::move(observation), fmt::format("{}:{}", path.string(), number));
    }
    pictures.push_back({name,
                        {(*numbers)[0], (*numbers)[1], wrap_angle(rad_from_deg((*numbers)[2]))},
                        *std::move(observation)});
  }
  if (pictures.empty()) {
    return fail(
        ErrorCode::kInvalidArgument,
        fmt::format("{}: no pictures, expected lines of picture,x_m,y_m,yaw_deg", path.string()));
  }
  return pictures;
}

Result<std::vector<KnownPicture>> simulate_pictures(const SimulatedPictures& config,
                                                    const map::CellGrid& cells,
                                                    const PanoramaCamera& profile) {
  SEMVIEW_TRY(const map::SemanticMap world, map::load_map(config.world));
  if (world.fingerprint == config.searched) {
    return fail(Error{ErrorCode::kFailedPrecondition,
                      fmt::format("--world {}: is the map itself: finding a map's own views in it "
                                  "proves nothing; expected another model of the same building",
                                  config.world),
                      "--world"});
  }
  SEMVIEW_TRY(const raycast::Scene scene, raycast::Scene::build(world));
  const std::vector<simulation::ClassFate> fates =
      simulation::photograph_fates({world.classes.names().begin(), world.classes.names().end()});
  const std::vector<CellIndex> free_cells = cells.free_cells();
  std::vector<KnownPicture> pictures;
  for (int k = 0; k < config.pictures; ++k) {
    Rng place(config.seed, "picture place", static_cast<std::uint64_t>(k));
    Pose2 pose = PoseGrid::center(free_cells[place.below(free_cells.size())]);
    pose.x_m += place.uniform(-0.5, 0.5) * PoseGrid::kCellSize_m;
    pose.y_m += place.uniform(-0.5, 0.5) * PoseGrid::kCellSize_m;
    pose.yaw_rad = place.uniform(-kPi, kPi);
    raycast::PanoramaRequest request;
    request.map_from_robot = pose;
    request.eye_z_m = config.world_ground_m + config.eye_height_m + place.uniform(-0.05, 0.05);
    request.camera = profile;
    request.camera.columns *= kFiner;
    request.camera.rows *= kFiner;
    Rng network(config.seed, "picture labels", static_cast<std::uint64_t>(k));
    pictures.push_back(
        {fmt::format("{:04}", k), pose, take_picture(scene, request, fates, profile, network)});
  }
  return pictures;
}

Observation cropped(const Observation& observation, double turn_rad, double width_rad) {
  Observation part = observation;
  PanoramaCamera camera;
  camera.columns = part.labels.columns();
  for (int c = 0; c < part.labels.columns(); ++c) {
    if (std::abs(wrap_angle(camera.azimuth_rad(c) - turn_rad)) <= width_rad / 2.0) continue;
    for (int r = 0; r < part.labels.rows(); ++r) part.labels.at(r, c) = kUnknown;
  }
  return part;
}

}  // namespace semview::cli
