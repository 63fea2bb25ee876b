#include "accel/static_tree.h"

namespace dspm {

StaticTree::StaticTree(std::span<const PlacedShape> shapes, std::span<const int> which, FrameSet all) : all_(shapes, which, all){}
StaticTree::~StaticTree(){}
  void StaticTree::find(const Ray& ray, NearestHit& query) const {all_.find(ray,query);}
  bool StaticTree::occluded(const Ray& ray) const { Unblocked u(FrameSet::single(0),ray.t_max); all_.find(ray,u); return u.frames().empty();}
  std::size_t StaticTree::memory() const {return all_.memory();}

}  // namespace dspm
