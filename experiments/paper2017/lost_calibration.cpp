// SPDX-License-Identifier: Apache-2.0
#include "lost_calibration.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include <Eigen/Dense>
#include <fmt/format.h>

namespace semview::paper2017 {
namespace {

using observation::LostFeatures;
using observation::LostModel;

constexpr int kTerms = static_cast<int>(LostFeatures::kCount) + 1;
constexpr std::size_t kBins = 10;

using Terms = Eigen::Matrix<double, kTerms, 1>;

Terms terms_of(const LostFeatures& features) {
  Terms terms;
  terms(0) = 1.0;
  const auto values = features.values();
  for (std::size_t i = 0; i < values.size(); ++i) terms(static_cast<int>(i) + 1) = values[i];
  return terms;
}

/// Which of one drive's stops was the first after the robot was carried away, and what became of
/// it.
struct Kidnap {
  bool lost = false;
  bool flagged = false;
};

}  // namespace

std::string_view name(Situation situation) {
  switch (situation) {
    case Situation::kKnownStart:
      return "known";
    case Situation::kWrongStart:
      return "wrong";
    case Situation::kGlobal:
      return "global";
    case Situation::kKidnapped:
      return "kidnapped";
  }
  return "";
}

/// Newton's method (iteratively reweighted least squares).
LostModel fit_lost_model(std::span<const LostStop> stops) {
  constexpr int kIterations = 50;
  constexpr double kPull = 1.0;  // of the quadratic penalty; one stop in thousands
  Terms weights = Terms::Zero();
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    Terms gradient = -kPull * weights;
    Eigen::Matrix<double, kTerms, kTerms> hessian =
        kPull * Eigen::Matrix<double, kTerms, kTerms>::Identity();
    gradient(0) = 0.0;  // the intercept is free
    hessian(0, 0) = 1e-9;
    for (const LostStop& stop : stops) {
      const Terms terms = terms_of(stop.features);
      const double probability = 1.0 / (1.0 + std::exp(-weights.dot(terms)));
      gradient += ((stop.lost() ? 1.0 : 0.0) - probability) * terms;
      hessian += probability * (1.0 - probability) * terms * terms.transpose();
    }
    const Terms step = hessian.ldlt().solve(gradient);
    weights += step;
    if (step.norm() < 1e-10) break;
  }
  LostModel model;
  model.intercept = weights(0);
  for (std::size_t i = 0; i < model.weights.size(); ++i) {
    model.weights[i] = weights(static_cast<int>(i) + 1);
  }
  return model;
}

LostQuality measure_quality(std::span<const LostStop> stops, const LostModel& model) {
  LostQuality quality;
  quality.bins.resize(kBins);
  quality.stops = stops.size();
  bool in_kidnap = false;
  Kidnap kidnap;
  for (const LostStop& stop : stops) {
    const double probability = observation::lost_probability(stop.features, model);
    const bool alarm = probability > kAlarm;
    ReliabilityBin& bin =
        quality.bins[std::min(kBins - 1, static_cast<std::size_t>(probability * kBins))];
    ++bin.stops;
    bin.mean_probability += probability;
    bin.lost_share += stop.lost() ? 1.0 : 0.0;
    quality.lost += stop.lost() ? 1 : 0;
    quality.good += stop.lost() ? 0 : 1;
    quality.false_alarms += alarm && !stop.lost() ? 1 : 0;
    if (stop.since_kidnap == 1) {
      in_kidnap = true;
      kidnap = {stop.lost(), alarm};
    } else if (stop.since_kidnap == 2 && in_kidnap) {
      // One that finds itself in between was not lost for two observations.
      quality.kidnaps += kidnap.lost && stop.lost() ? 1 : 0;
      quality.flagged += kidnap.lost && stop.lost() && (kidnap.flagged || alarm) ? 1 : 0;
      in_kidnap = false;
    }
  }
  for (ReliabilityBin& bin : quality.bins) {
    if (bin.stops == 0) continue;
    const auto count = static_cast<double>(bin.stops);
    bin.mean_probability /= count;
    bin.lost_share /= count;
    quality.calibration_error += count / static_cast<double>(quality.stops) *
                                 std::abs(bin.mean_probability - bin.lost_share);
  }
  return quality;
}

std::string reliability_svg(const LostQuality& quality, const std::string& title) {
  constexpr double kLeft = 60.0;
  constexpr double kTop = 40.0;
  constexpr double kSide = 320.0;
  const auto x = [](double probability) { return kLeft + kSide * probability; };
  const auto y = [](double share) { return kTop + kSide * (1.0 - share); };
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"420\" height=\"430\" "
      "font-family=\"sans-serif\" font-size=\"12\">\n"
      "<rect width=\"420\" height=\"430\" fill=\"white\"/>\n"
      "<text x=\"{}\" y=\"22\" font-size=\"14\">{}</text>\n"
      "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"none\" stroke=\"#888\"/>\n"
      "<line x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\" stroke=\"#bbb\" stroke-dasharray=\"4\"/>\n",
      kLeft,
      title,
      kLeft,
      kTop,
      kSide,
      kSide,
      x(0),
      y(0),
      x(1),
      y(1));
  for (const double tick : {0.0, 0.5, 1.0}) {
    svg += fmt::format(
        "<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">{:g}</text>\n"
        "<text x=\"{}\" y=\"{}\" text-anchor=\"end\">{:g}</text>\n",
        x(tick),
        y(0) + 18.0,
        tick,
        x(0) - 6.0,
        y(tick) + 4.0,
        tick);
  }
  for (const ReliabilityBin& bin : quality.bins) {
    if (bin.stops == 0) continue;
    const double radius = 2.0 + 1.2 * std::log(static_cast<double>(bin.stops));
    svg += fmt::format(
        "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\" fill=\"#3060a0\" fill-opacity=\"0.7\">"
        "<title>{} stops</title></circle>\n",
        x(bin.mean_probability),
        y(bin.lost_share),
        radius,
        bin.stops);
  }
  svg += fmt::format(
      "<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">probability of being lost</text>\n"
      "<text x=\"16\" y=\"{}\" text-anchor=\"middle\" transform=\"rotate(-90 16 {})\">share that "
      "was (more than 1 m off)</text>\n"
      "<text x=\"{}\" y=\"{}\">calibration error {:.3f}, {} stops</text>\n</svg>\n",
      x(0.5),
      y(0) + 38.0,
      y(0.5),
      y(0.5),
      x(0.04),
      y(0.94),
      quality.calibration_error,
      quality.stops);
  return svg;
}

std::string lost_stops_csv(std::span<const LostStop> stops, const LostModel& model) {
  std::string text =
      "world,noise_level,situation,run,stop,since_kidnap,error_m,advantage,advantage_before,"
      "mode_weight,log_sigma,log_effective_share,lost_probability\n";
  for (const LostStop& stop : stops) {
    const LostFeatures& features = stop.features;
    fmt::format_to(std::back_inserter(text),
                   "{},{:g},{},{},{},{},{:.4f},{:.5f},{:.5f},{:.5f},{:.5f},{:.5f},{:.5f}\n",
                   stop.world,
                   stop.noise_level,
                   name(stop.situation),
                   stop.run,
                   stop.stop,
                   stop.since_kidnap,
                   stop.error_m,
                   features.advantage,
                   features.advantage_before,
                   features.mode_weight,
                   features.log_sigma,
                   features.log_effective_share,
                   observation::lost_probability(features, model));
  }
  return text;
}

}  // namespace semview::paper2017
