// SPDX-License-Identifier: Apache-2.0
/// tinygltf without pictures and without files. Inside the module only; `gltf_read.cpp` holds its
/// implementation.
#pragma once

#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
#define TINYGLTF_NO_FS
#include <fstream>  // tinygltf needs it and does not say so without its file access

#include <nlohmann/json.hpp>
#include <tiny_gltf.h>
