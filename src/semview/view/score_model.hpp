// SPDX-License-Identifier: Apache-2.0
/// Which model compares an observation with the map.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>

namespace semview {

enum class ScoreModel : std::uint8_t {
  kViews,  ///< label panoramas against views of the map: Neubert et al. 2017
  kSdf,    ///< depth images: distance to the nearest surface. Gomez et al. 2023, as all that follow
  kSem,    ///< distance to the nearest thing of a pixel's class
  kSdfSem,  ///< both
};

inline constexpr std::array<std::pair<ScoreModel, std::string_view>, 4> kScoreModels{
    {{ScoreModel::kViews, "views"},
     {ScoreModel::kSdf, "sdf"},
     {ScoreModel::kSem, "sem"},
     {ScoreModel::kSdfSem, "sdf_sem"}}};

constexpr std::string_view name(ScoreModel model) {
  return kScoreModels[static_cast<std::size_t>(model)].second;
}

constexpr std::optional<ScoreModel> score_model(std::string_view name) {
  for (const auto& [model, its_name] : kScoreModels) {
    if (its_name == name) return model;
  }
  return std::nullopt;
}

constexpr bool scores_depth(ScoreModel model) { return model != ScoreModel::kViews; }

/// How depth images are scored; the defaults are those of section 4.1 of the 2023 paper.
struct DepthScoring {
  ScoreModel model = ScoreModel::kSdfSem;  ///< not `kViews`
  double z_sdf = 0.5;                      ///< z_sdf of equation (3); z_sem is 1 less it
  double sigma_sdf_m = 2.0;                ///< of equation (4)
  double sigma_sem_m = 1.5;                ///< of equation (5)
  /// z_sem of a pixel is the map's `movable` of its class, and z_sdf 1 less it.
  bool by_movable = false;

  auto operator<=>(const DepthScoring&) const = default;
};

}  // namespace semview
