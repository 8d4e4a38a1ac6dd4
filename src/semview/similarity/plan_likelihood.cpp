// SPDX-License-Identifier: Apache-2.0
#include "semview/similarity/plan_likelihood.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "semview/similarity/weight_proposal.hpp"

namespace semview::similarity {
namespace {

constexpr std::size_t kParts = 7;

struct Example {
  std::string_view name;
  BuildingPart part;
};
/// One name of each group of synonyms that is a part of buildings.
constexpr std::array<Example, kParts - 1> kExamples = {{{"wall", BuildingPart::kWall},
                                                        {"floor", BuildingPart::kFloor},
                                                        {"ceiling", BuildingPart::kCeiling},
                                                        {"windowpane", BuildingPart::kWindow},
                                                        {"door", BuildingPart::kDoor},
                                                        {"sky", BuildingPart::kOpen}}};

/// P(observed | plan): a row a part of the plan, in the order of `BuildingPart`. The diagonal is a
/// network's measured recall on photographs against plans; the rest says what it takes parts for.
constexpr std::array<std::array<double, kParts>, kParts> kObservedGivenPlan = {{
    //  wall   floor  ceil.  window door   open   thing
    {{0.870, 0.010, 0.015, 0.020, 0.020, 0.003, 0.062}},  // wall
    {{0.050, 0.770, 0.003, 0.005, 0.010, 0.002, 0.160}},  // floor
    {{0.160, 0.005, 0.770, 0.010, 0.005, 0.010, 0.040}},  // ceiling
    {{0.130, 0.010, 0.010, 0.710, 0.030, 0.050, 0.060}},  // window
    {{0.500, 0.040, 0.020, 0.050, 0.290, 0.005, 0.095}},  // door
    {{0.150, 0.100, 0.050, 0.200, 0.050, 0.350, 0.100}},  // open
    {{0.150, 0.120, 0.010, 0.020, 0.020, 0.000, 0.680}},  // thing
}};
/// How much of a panorama is what, in the plans of dwellings and offices.
constexpr std::array<double, kParts> kShareOfPlan = {0.50, 0.20, 0.16, 0.05, 0.05, 0.01, 0.03};

/// Share of pixels that say nothing: no pixel says more than ln 0.1 against a place.
constexpr double kMeaningless = 0.1;

/// A thing where the plan has this very thing.
constexpr double kSameThing = 2.2;
/// A thing where the plan has another one, which networks mix up.
constexpr double kOtherThing = 0.8;

std::size_t index(BuildingPart part) { return static_cast<std::size_t>(part); }

double likelihood_ratio(BuildingPart observed, BuildingPart plan) {
  double anywhere = 0.0;
  for (std::size_t j = 0; j < kParts; ++j) {
    anywhere += kShareOfPlan[j] * kObservedGivenPlan[j][index(observed)];
  }
  return (1.0 - kMeaningless) * kObservedGivenPlan[index(plan)][index(observed)] / anywhere +
         kMeaningless;
}

/// How alike two things are, in [0, 1].
double likeness(const NamedClass& a, const NamedClass& b, const SynonymTable& synonyms) {
  if (share_a_name(a, b)) return 1.0;
  return std::clamp(synonyms.score(known_name(a, synonyms), known_name(b, synonyms)), 0.0, 1.0);
}

double weight_of(const NamedClass& observed, const NamedClass& map, const SynonymTable& synonyms) {
  const PartOfClass seen = part_of(observed, synonyms);
  const PartOfClass drawn = part_of(map, synonyms);
  if (seen.part == BuildingPart::kThing && drawn.part == BuildingPart::kThing) {
    return kOtherThing + (kSameThing - kOtherThing) * likeness(observed, map, synonyms);
  }
  return seen.degree * drawn.degree * std::log(likelihood_ratio(seen.part, drawn.part));
}

}  // namespace

PartOfClass part_of(const NamedClass& named, const SynonymTable& synonyms) {
  const std::string& name = known_name(named, synonyms);
  PartOfClass best{BuildingPart::kThing, 0.0};
  for (const Example& example : kExamples) {
    const double degree = synonyms.degree_beside(name, example.name);
    if (degree > best.degree) best = {example.part, degree};
  }
  return best.degree > 0.0 ? best : PartOfClass{};
}

Result<WeightMatrix> plan_likelihood_weights(std::span<const NamedClass> observed,
                                             std::span<const NamedClass> map,
                                             const SynonymTable& synonyms) {
  std::vector<NamedClass> columns(map.begin(), map.end());
  columns.push_back({std::string(kNoneColumn)});
  std::vector<NamedClass> rows(observed.begin(), observed.end());
  for (const NamedClass& named : map) {
    if (std::ranges::find(observed, named.name, &NamedClass::name) == observed.end()) {
      rows.push_back(named);
    }
  }
  WeightMatrix::Band band;
  std::vector<std::string> observed_names;
  std::vector<std::string> map_names;
  for (const NamedClass& column : columns) map_names.push_back(column.name);
  for (const NamedClass& row : rows) {
    observed_names.push_back(row.name);
    for (const NamedClass& column : columns) {
      // To thousandths: the file is for people.
      band.weights.push_back(std::round(weight_of(row, column, synonyms) * 1e3) / 1e3);
    }
  }
  return WeightMatrix::build(std::move(observed_names), std::move(map_names), {std::move(band)});
}

}  // namespace semview::similarity
