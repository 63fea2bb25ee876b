#include "dspm/lang/gltf/meshopt.h"

#ifdef DSPM_MESHOPTIMIZER
#include <fmt/format.h>
#include <meshoptimizer.h>
#endif

namespace dspm::gltf {

#ifdef DSPM_MESHOPTIMIZER
namespace {

constexpr std::size_t kMostRatio = 1024, kOnTrust = std::size_t{1} << 26;  // a hostile count would fill the memory

void filter(const Value& how, std::string& data, std::size_t count, std::size_t stride) {
  const std::string name = how["filter"].text("NONE");
  if (name == "OCTAHEDRAL" && (stride == 4 || stride == 8))
    meshopt_decodeFilterOct(data.data(), count, stride);
  else if (name == "QUATERNION" && stride == 8)
    meshopt_decodeFilterQuat(data.data(), count, stride);
  else if (name == "EXPONENTIAL" && stride % 4 == 0)
    meshopt_decodeFilterExp(data.data(), count, stride);
  else if (name != "NONE")
    how.fail("dspm does not know the filter " + name + " of vertices of that size");
}

}  // namespace

bool reads_meshopt() { return true; }

std::string expand_meshopt(const Value& how, std::string_view bytes) {
  const std::size_t count = how["count"].count(0), stride = how["byteStride"].count(0);
  const std::string mode = how["mode"].text("");
  if (stride == 0 || stride > 256 || count > std::max(kOnTrust, kMostRatio * bytes.size()) / stride)
    how.fail("its size is not plausible");
  std::string data(count * stride, '\0');
  const auto* from = reinterpret_cast<const unsigned char*>(bytes.data());
  int error = -1;
  if (mode == "ATTRIBUTES" && stride % 4 == 0)
    error = meshopt_decodeVertexBuffer(data.data(), count, stride, from, bytes.size());
  else if (mode == "TRIANGLES" && (stride == 2 || stride == 4) && count % 3 == 0)
    error = meshopt_decodeIndexBuffer(data.data(), count, stride, from, bytes.size());
  else if (mode == "INDICES" && (stride == 2 || stride == 4))
    error = meshopt_decodeIndexSequence(data.data(), count, stride, from, bytes.size());
  if (error != 0)
    how.fail(fmt::format("its data cannot be expanded: it is damaged, or newer than meshoptimizer {}.{}",
                         MESHOPTIMIZER_VERSION / 1000, MESHOPTIMIZER_VERSION / 10 % 100));
  filter(how, data, count, stride);
  return data;
}
#else
bool reads_meshopt() { return false; }

std::string expand_meshopt(const Value& how, std::string_view) {
  how.fail("this dspm was built without meshoptimizer (libmeshoptimizer-dev)");
}
#endif

}  // namespace dspm::gltf
