// Makes the plain query of a scene's shapes from their trees, and owns what it points to but for the trees' own nodes and
// triangles. See plain_query.h.
#pragma once

#include <deque>
#include <map>
#include <vector>

#include "dspm/accel/plain_query.h"
#include "dspm/accel/tree.h"

namespace dspm {

class TwoLevel;

class PlainTrees {
 public:
  /// `trees` and its shapes must outlive this. All of them must be plain, see first_not_plain().
  explicit PlainTrees(const TwoLevel& trees);
  PlainTrees(const PlainTrees&) = delete;
  PlainTrees& operator=(const PlainTrees&) = delete;

  const PlainQuery& query() const { return query_; }

 private:
  PlainTree plain(const Tree& tree);
  const PlainTree* mesh(const Tree& tree);

  std::map<const Tree*, PlainTree> meshes_;  // lookups only; their addresses stay
  std::deque<std::vector<PlainTree::Placed>> placed_;
  std::deque<std::vector<PlainTree::Crowd>> crowds_;
  std::vector<PlainTree> of_frame_;
  PlainQuery query_;
};

/// Returns the number of the first shape that has no plain form, so that a plain query does not know it; -1 if there is
/// none.
int first_not_plain(std::span<const PlacedShape> shapes);

}  // namespace dspm
