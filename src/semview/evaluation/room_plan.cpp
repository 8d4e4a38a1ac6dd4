// SPDX-License-Identifier: Apache-2.0
#include "semview/evaluation/room_plan.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "semview/core/check.hpp"
#include "semview/io/text_file.hpp"

namespace semview::evaluation {
namespace {

constexpr std::size_t kMaxBytes = std::size_t{1} << 20U;
constexpr std::string_view kHeader = "room,min_x_m,min_y_m,max_x_m,max_y_m";

/// `,1,2,3,4` and nothing more.
bool parse_four(std::string_view text, std::array<double, 4>& numbers) {
  for (double& number : numbers) {
    if (!text.starts_with(',')) return false;
    text.remove_prefix(1);
    const auto [stop, status] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (status != std::errc() || !std::isfinite(number)) return false;
    text.remove_prefix(static_cast<std::size_t>(stop - text.data()));
  }
  return text.empty();
}

double moved(double value, double from_low, double from_high, double to_low, double to_high) {
  return to_low + (value - from_low) / (from_high - from_low) * (to_high - to_low);
}

void visit(std::vector<std::string>& order, const NamedRoom* room) {
  const std::string name = room == nullptr ? std::string() : room->name;
  if (order.empty() || order.back() != name) order.push_back(name);
}

}  // namespace

Result<std::vector<NamedRoom>> read_rooms(const std::filesystem::path& path) {
  SEMVIEW_TRY(const std::string text, io::read_text_file(path, kMaxBytes));
  std::vector<NamedRoom> rooms;
  bool header_read = false;
  std::string_view rest = text;
  for (int line_number = 1; !rest.empty(); ++line_number) {
    std::string_view line = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(std::min(line.size() + 1, rest.size()));
    if (line.ends_with('\r')) line.remove_suffix(1);
    if (line.empty() || line.starts_with('#')) continue;
    const auto wrong = [&](std::string_view what) {
      return fail(ErrorCode::kInvalidArgument,
                  fmt::format("{}:{}: {}", path.string(), line_number, what));
    };
    if (!header_read) {
      if (line != kHeader) return wrong(fmt::format("expected the header {}", kHeader));
      header_read = true;
      continue;
    }
    NamedRoom room;
    room.name = line.substr(0, line.find(','));
    std::array<double, 4> sides{};
    if (room.name.empty() || !parse_four(line.substr(room.name.size()), sides)) {
      return wrong("expected a name and four numbers in m");
    }
    room.min_x_m = sides[0];
    room.min_y_m = sides[1];
    room.max_x_m = sides[2];
    room.max_y_m = sides[3];
    if (!(room.min_x_m < room.max_x_m && room.min_y_m < room.max_y_m)) {
      return wrong("expected each min below its max");
    }
    if (std::ranges::find(rooms, room.name, &NamedRoom::name) != rooms.end()) {
      return wrong(fmt::format("room {} is there already", room.name));
    }
    rooms.push_back(std::move(room));
  }
  if (rooms.empty()) {
    return fail(ErrorCode::kInvalidArgument, fmt::format("{}: has no room", path.string()));
  }
  return rooms;
}

const NamedRoom* room_at(std::span<const NamedRoom> rooms, const Pose2& place) {
  const auto found =
      std::ranges::find_if(rooms, [&](const NamedRoom& room) { return room.holds(place); });
  return found == rooms.end() ? nullptr : &*found;
}

std::optional<Pose2> moved_with_room(std::span<const NamedRoom> from,
                                     std::span<const NamedRoom> to,
                                     const Pose2& place) {
  const NamedRoom* room = room_at(from, place);
  if (room == nullptr) return std::nullopt;
  const auto same = std::ranges::find(to, room->name, &NamedRoom::name);
  if (same == to.end()) return std::nullopt;
  return Pose2{moved(place.x_m, room->min_x_m, room->max_x_m, same->min_x_m, same->max_x_m),
               moved(place.y_m, room->min_y_m, room->max_y_m, same->min_y_m, same->max_y_m),
               place.yaw_rad};
}

RoomScore score_rooms(std::span<const NamedRoom> true_rooms,
                      std::span<const NamedRoom> drawn_rooms,
                      std::span<const Pose2> truth,
                      std::span<const Pose2> found) {
  SEMVIEW_CHECK(truth.size() == found.size());
  RoomScore score;
  std::size_t measured = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const NamedRoom* room = room_at(true_rooms, truth[i]);
    if (room == nullptr) {
      ++score.outside;
      continue;
    }
    const NamedRoom* guess = room_at(drawn_rooms, found[i]);
    ++score.places;
    if (guess != nullptr && guess->name == room->name) ++score.right;
    visit(score.true_order, room);
    visit(score.found_order, guess);
    if (const auto place = moved_with_room(true_rooms, drawn_rooms, truth[i])) {
      ++measured;
      score.mean_error_m += distance_m(*place, found[i]);
    }
  }
  if (measured > 0) score.mean_error_m /= static_cast<double>(measured);
  return score;
}

}  // namespace semview::evaluation
