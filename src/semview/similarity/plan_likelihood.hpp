// SPDX-License-Identifier: Apache-2.0
/// Weights for any network's photographs against any plan, from class names alone.
#pragma once

#include <span>
#include <string_view>

#include "semview/core/result.hpp"
#include "semview/similarity/synonym_table.hpp"
#include "semview/similarity/vocabulary.hpp"
#include "semview/similarity/weight_matrix.hpp"

namespace semview::similarity {

/// What a class is to a building. Photographs and plans agree on these, whatever names they use.
enum class BuildingPart { kWall, kFloor, kCeiling, kWindow, kDoor, kOpen, kThing };

struct PartOfClass {
  BuildingPart part = BuildingPart::kThing;
  double degree = 1.0;  ///< in (0, 1]: a painting is a wall to 0.6
};

/// By the synonyms; what they do not know is a thing.
PartOfClass part_of(const NamedClass& named, const SynonymTable& synonyms);

/// Logarithms of likelihood ratios, ln P(i observed | j in the plan) - ln P(i observed), from how
/// networks err on photographs of furnished rooms: a wall of the plan is seen as wall in 0.87 of
/// its pixels, floors and ceilings in 0.77, windows in 0.71, doors in 0.29 (as wall in half), and
/// furniture stands before everything and often is in no plan. A tenth of all pixels is taken to
/// say nothing, which bounds what one can say against a place.
///
/// A class that belongs to a part in some degree only says as much less. Furniture of one name
/// speaks for itself where the plan has it, and hardly against a wall or floor behind it.
/// Rows and columns as in `propose_weights`.
/// @errors kInvalidArgument: names that a weight matrix does not take.
Result<WeightMatrix> plan_likelihood_weights(
    std::span<const NamedClass> observed,
    std::span<const NamedClass> map,
    const SynonymTable& synonyms = SynonymTable::shipped());

}  // namespace semview::similarity
