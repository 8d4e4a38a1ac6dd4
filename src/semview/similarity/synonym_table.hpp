// SPDX-License-Identifier: Apache-2.0
/// Which class names mean the same, nearly the same, or the opposite.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "semview/core/result.hpp"

namespace semview::similarity {

/// Groups of class names and the relations between groups, from which weights are proposed by the
/// three concepts of the paper. The file form is described in docs/formats/weights.md#synonyms.
///
/// @source Neubert et al. 2017, section III-C: soft class matching (degrees, positive relations),
/// weighted class significance (of a group), class matching penalty (negative relations)
class SynonymTable {
 public:
  /// @errors kInvalidArgument: with the line and what was expected there.
  static Result<SynonymTable> parse(std::string_view text, std::string_view name);

  /// The table built into the program, vocabularies/synonyms.tsv.
  static const SynonymTable& shipped();

  bool contains(std::string_view class_name) const;

  /// The significance of the group to which a name belongs most; 1 in none.
  double significance(std::string_view class_name) const;

  /// The weight of two names, equal or not; 0 when the table knows no tie between them. Of several
  /// ties (a name may be in several groups) the highest positive one counts, else the lowest.
  double score(std::string_view a, std::string_view b) const;

  /// The degree in which a name belongs to the group of `example`; 0 if to none of its groups.
  double degree_beside(std::string_view class_name, std::string_view example) const;

 private:
  struct Member {
    std::string name;
    double degree = 1.0;
  };
  struct Group {
    std::string name;
    double significance = 1.0;
    std::vector<Member> members;

    double degree(std::string_view class_name) const;
  };

  Status add_group(const std::vector<std::string>& cells);
  Status add_relation(const std::vector<std::string>& cells);
  Result<std::size_t> group_index(const std::string& name) const;

  std::vector<Group> groups_;
  std::vector<std::vector<double>> relations_;  ///< symmetric; own significance on the diagonal
};

}  // namespace semview::similarity
