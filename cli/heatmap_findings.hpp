// SPDX-License-Identifier: Apache-2.0
/// What `semview heatmap` found, in numbers, words and pictures.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "heatmap_source.hpp"
#include "semview/geometry/image.hpp"

namespace semview::cli {

/// What is drawn and written: probabilities if they were asked for, else similarities.
const Image<float>& values_of(const client::HeatMapAnswer& answer);

/// What a heat map says about itself: printed, and written beside the `.npy`.
nlohmann::ordered_json describe(const HeatMapOfMap& made, const client::HeatMapQuestion& question);

/// The best cell in a line, given what `describe` says.
std::string in_words(const HeatMapOfMap& made, const nlohmann::ordered_json& about);

/// One picture, or one beside the other for each model.
RgbImage draw(const std::vector<HeatMapOfMap>& made,
              const std::vector<nlohmann::ordered_json>& about);

}  // namespace semview::cli
