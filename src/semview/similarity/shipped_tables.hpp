// SPDX-License-Identifier: Apache-2.0
/// The files of vocabularies/ as built into the library, so that an installed program needs no
/// folder beside it.
#pragma once

#include <string_view>

namespace semview::similarity {

extern const std::string_view kAde20k150Names;  ///< vocabularies/ade20k150/names.tsv
extern const std::string_view kAde20k32Names;   ///< vocabularies/ade20k32/names.tsv
extern const std::string_view kSynonyms;        ///< vocabularies/synonyms.tsv

}  // namespace semview::similarity
