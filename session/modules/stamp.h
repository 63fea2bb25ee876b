// A stamp holds what a module and the dspm that loads it must agree on: dspm's version, the compiler's ABI, the headers
// of the interface, and the sizes of the types that both use. A module carries its stamp as an ELF note, so that it is
// compared before any code of the module runs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include "dspm/accel/accel.h"
#include "dspm/base/math/ray.h"
#include "dspm/base/params/params.h"
#include "dspm/base/system/version.h"
#include "dspm/cameras/camera.h"
#include "dspm/image/film/pixel_filter.h"
#include "dspm/image/image.h"
#include "dspm/integrators/integrator.h"
#include "dspm/lights/light.h"
#include "dspm/materials/material.h"
#include "dspm/session/modules/interface.h"
#include "dspm/shapes/triangle_mesh.h"
#include "dspm/textures/plugins.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

struct StampedType {
  std::string_view name;
  std::size_t size;
};

/// Types that modules and dspm pass to each other, or that contain such types.
inline constexpr StampedType kStampedTypes[] = {
    {"std::string", sizeof(std::string)},
    {"std::vector", sizeof(std::vector<int>)},
    {"dspm::Diagnostics", sizeof(Diagnostics)},
    {"dspm::ParamReader", sizeof(ParamReader)},
    {"dspm::Transform", sizeof(Transform)},
    {"dspm::Ray", sizeof(Ray)},
    {"dspm::SurfacePoint", sizeof(SurfacePoint)},
    {"dspm::PlacedShape", sizeof(PlacedShape)},
    {"dspm::MadeShape", sizeof(MadeShape)},
    {"dspm::TriangleMesh", sizeof(TriangleMesh)},
    {"dspm::BsdfSlot", sizeof(BsdfSlot)},
    {"dspm::BsdfSample", sizeof(BsdfSample)},
    {"dspm::TextureContext", sizeof(TextureContext)},
    {"dspm::TexturePoint", sizeof(TexturePoint)},
    {"dspm::Emission", sizeof(Emission)},
    {"dspm::Illumination", sizeof(Illumination)},
    {"dspm::LightContext", sizeof(LightContext)},
    {"dspm::CameraContext", sizeof(CameraContext)},
    {"dspm::RayHit", sizeof(RayHit)},
    {"dspm::HitPartition", sizeof(HitPartition)},
    {"dspm::Scene", sizeof(Scene)},
    {"dspm::SceneLight", sizeof(SceneLight)},
    {"dspm::Image", sizeof(Image)},
    {"dspm::PixelFilter", sizeof(PixelFilter)},
    {"dspm::RenderSettings", sizeof(RenderSettings)},
    {"dspm::Statistics", sizeof(Statistics)},
    {"dspm::Rejections", sizeof(Rejections::Entry)},
    {"dspm::OutputInfo", sizeof(OutputInfo)},
    {"dspm::Sighting", sizeof(Sighting)},
    {"dspm::Iteration", sizeof(Iteration)},
    {"dspm::IntegratorPlugin", sizeof(IntegratorPlugin)},
};

// dspm::dspm of the installed package defines it: a digest of the headers that are there when a module is built.
#ifndef DSPM_HEADERS
#define DSPM_HEADERS ::dspm::kInterface
#endif

/// The note as stored in the file: an ELF header, then the stamp. The fields before `sizes` never change.
struct ModuleStamp {
  std::uint32_t name_bytes = 5, content_bytes = 0, type = 1;
  char name[8] = {'d', 's', 'p', 'm'};
  std::uint32_t version[3] = {version_part(0), version_part(1), version_part(2)};
  std::uint32_t interface = DSPM_HEADERS;
  std::uint32_t cxx_abi = 0;      // thousands of __GXX_ABI_VERSION: g++ and clang agree in them
  std::uint32_t new_strings = 0;  // _GLIBCXX_USE_CXX11_ABI
  std::uint32_t type_count = std::size(kStampedTypes);
  std::uint32_t sizes[std::size(kStampedTypes)] = {};
};

/// Returns the stamp of the code that includes this header.
constexpr ModuleStamp current_stamp() {
  ModuleStamp stamp;
  stamp.content_bytes = sizeof(ModuleStamp) - offsetof(ModuleStamp, version);
  stamp.cxx_abi = __GXX_ABI_VERSION / 1000;
  stamp.new_strings = _GLIBCXX_USE_CXX11_ABI;
  for (std::size_t i = 0; i < std::size(kStampedTypes); ++i)
    stamp.sizes[i] = static_cast<std::uint32_t>(kStampedTypes[i].size);
  return stamp;
}

/// Returns why a module whose note holds these bytes cannot be loaded, and what to do; empty if it can.
std::string why_unfit(std::string_view note);

}  // namespace dspm
