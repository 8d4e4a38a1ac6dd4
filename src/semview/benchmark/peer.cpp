// SPDX-License-Identifier: Apache-2.0
#include "semview/benchmark/peer.hpp"

#include <filesystem>

#include <dlfcn.h>
#include <fmt/format.h>

namespace semview::benchmark {
namespace {

/// The address of `symbol` in the library of a peer, which stays loaded.
Result<void*> load(const std::string& name, const char* symbol, const char* packages) {
  const std::string file = peers_folder() + "/" + name + ".so";
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored)) {
    return fail(ErrorCode::kNotFound,
                fmt::format("not installed: apt-get install {}, then build with "
                            "-DSEMVIEW_BUILD_BENCH=ON",
                            packages));
  }
  // A peer's own definitions come before those of libraries that the program has loaded already.
  void* library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_DEEPBIND);
  void* address = library == nullptr ? nullptr : dlsym(library, symbol);
  if (address == nullptr) {
    return fail(ErrorCode::kNotFound, fmt::format("{}: {}", file, dlerror()));
  }
  return address;
}

}  // namespace

std::string peers_folder() {
  std::error_code error;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
  return (program.parent_path() / "peers").string();
}

Result<std::unique_ptr<CasterPeer>> open_caster_peer(const map::TriangleMesh& mesh) {
  SEMVIEW_TRY(void* const make, load("open3d", kCasterPeerSymbol, "libopen3d-dev"));
  return std::unique_ptr<CasterPeer>(reinterpret_cast<MakeCasterPeer>(make)(mesh));
}

Result<std::unique_ptr<MatchPeer>> open_match_peer(const WeightImages& weights) {
  SEMVIEW_TRY(void* const make, load("opencv", kMatchPeerSymbol, "libopencv-imgproc-dev"));
  return std::unique_ptr<MatchPeer>(reinterpret_cast<MakeMatchPeer>(make)(weights));
}

}  // namespace semview::benchmark
