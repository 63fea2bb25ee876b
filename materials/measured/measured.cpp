// measured: a surface whose reflection has been measured, as in RGL's database of materials.
//
//   Material "measured" "string filename" "cc_nothern_aurora_spec.bsdf"
//
//   filename   file   required   a .bsdf file of RGL, with spectra or with RGB values
//
// The file tabulates the distribution D of facet normals, the area sigma that facets show in a direction, and, over a
// square that is stretched where facets matter, what they reflect, r: f = r D(m) / (4 sigma(wo) cos(wi)), with m
// halfway between both directions. The square is warped twice to sample m, by the file's luminance and its visible
// normals; both warps have exact densities. wo is the direction towards the camera; measured tables are reciprocal up
// to noise, so light that photons bring is looked up as camera paths would. Both sides reflect. Each spectrum is turned
// into its colour under D65 when the file is read. The surface counts as rough as GGX with as high a peak of D.
// [Dupuy and Jakob 2018, An Adaptive Parameterization for Efficient Material Acquisition and Rendering;
// https://rgl.epfl.ch/materials]
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/vec.h"
#include "dspm/base/params/params.h"
#include "dspm/base/system/read_file.h"
#include "dspm/materials/material.h"
#include "dspm/materials/measured/measured_file.h"
#include "dspm/materials/microfacet.h"
#include "dspm/materials/shading_frame.h"

namespace dspm {
namespace {

class Measured final : public Bsdf {
 public:
  Measured(const SurfacePoint& point, const MeasuredFile& file)
      : frame_(point), file_(&file), palette_(point.palette) {}

  LobeSet lobes(float least_alpha) const override { return file_->alpha() >= least_alpha ? 1 : 0; }

  Spectrum evaluate(const Vec3& wo, const Vec3& wi, Transport transport, LobeSet lobes) const override {
    const LocalPair w(frame_, wo, wi, transport);
    if (!(lobes & 1) || !w.reflection()) return {};
    return f(w.wo, w.wi, transport);
  }

  float pdf_w(const Vec3& wo, const Vec3& wi, Transport transport, LobeSet lobes) const override {
    const LocalPair w(frame_, wo, wi, transport);
    return (lobes & 1) && w.reflection() ? w.share * file_->density(w.wo, w.wi) : 0;
  }

  std::optional<BsdfSample> sample(const Vec3& wo, const Vec3& u, Transport transport, LobeSet lobes) const override {
    const float side = frame_.side(wo);
    const auto arriving = frame_.arrive(wo, side, transport);
    if (!(lobes & 1) || !arriving) return std::nullopt;
    const Vec3 o = *arriving;
    const Vec3 i = file_->sample(o, {u.x, u.y});
    if (!(i.z > 0)) return std::nullopt;
    const auto leaving = frame_.leave(i, side, transport, u.x);
    const float pdf = leaving ? leaving->share * file_->density(o, i) : 0;
    if (!(pdf > 0)) return std::nullopt;
    return BsdfSample{leaving->wi, f(o, i, transport) * (i.z / pdf), pdf, false};
  }

  float lobe_probability(const Vec3&, LobeSet lobes) const override { return lobes & 1 ? 1.f : 0.f; }

 private:
  Spectrum f(const Vec3& o, const Vec3& i, Transport transport) const {
    return transport == Transport::radiance ? file_->f(o, i, *palette_) : file_->f(i, o, *palette_);
  }

  ShadingFrame frame_;
  const MeasuredFile* file_;
  const Palette* palette_;
};

class MeasuredMaterial final : public Material {
 public:
  explicit MeasuredMaterial(MeasuredFile file) : file_(std::move(file)) {}
  const Bsdf& bsdf(const SurfacePoint& point, BsdfSlot& slot) const override {
    return slot.emplace<Measured>(point, file_);
  }

 private:
  MeasuredFile file_;
};

}  // namespace

std::unique_ptr<Material> make_measured(ParamReader& reader, const MaterialContext&) {
  const std::filesystem::path path = reader.file("filename", "a .bsdf file of RGL's database of materials");
  reader.finish();
  if (path.empty()) return nullptr;
  try {
    return std::make_unique<MeasuredMaterial>(MeasuredFile(decode_tensors(read_bytes(path))));
  } catch (const std::runtime_error& problem) {
    reader.error("filename", path.string() + ": " + problem.what());
    return nullptr;
  }
}

}  // namespace dspm
