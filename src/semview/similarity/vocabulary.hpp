// SPDX-License-Identifier: Apache-2.0
/// The class names that a segmentation network knows: the rows of a weight matrix.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "semview/core/result.hpp"
#include "semview/semantics/class_table.hpp"

namespace semview::similarity {

/// A class by its name and by what else it is called.
struct NamedClass {
  std::string name;
  std::vector<std::string> aliases = {};

  bool operator==(const NamedClass&) const = default;
};

using Vocabulary = std::vector<NamedClass>;

/// The names in id order.
ClassTable class_table(const Vocabulary& vocabulary);

/// Text of one class a line, in id order: its name, then, after a tab, other names with `;` between
/// them. Lines that start with # and empty ones are skipped. `name` stands in messages.
/// @errors kInvalidArgument: a name that is empty, repeated, longer than 64 bytes or holds control
/// characters, ',' or ';'; no class, or more than 254.
Result<Vocabulary> parse_vocabulary(std::string_view text, std::string_view name);

/// A vocabulary built into the program: `ade20k150`, or `ade20k32` of the shipped network.
/// @errors kNotFound: none of that id.
Result<Vocabulary> shipped_vocabulary(std::string_view id);

/// `id_or_file`: the id of a shipped vocabulary, or else a file.
/// @errors kNotFound: neither; as `parse_vocabulary`.
Result<Vocabulary> load_vocabulary(const std::string& id_or_file);

}  // namespace semview::similarity
