// The outputs of what the camera sees first, and of what it sees in and through that, by name.
#pragma once

#include <string>
#include <vector>

#include "dspm/integrators/output_info.h"

namespace dspm {

/// Each kind is one output, except a Cryptomatte, which is as many as it has ranks.
enum class SurfaceKind {
  normal,
  position,
  depth,
  albedo,
  uv,
  object,
  material,
  alpha,
  crypto_object,
  crypto_material,
  catcher,
  motion_forward,
  motion_backward,
  denoising_normal,
  denoising_depth,
  denoising_albedo,
};
inline constexpr int kSurfaceKinds = 16;
inline bool is_id(SurfaceKind kind) { return kind == SurfaceKind::object || kind == SurfaceKind::material; }
inline bool is_crypto(SurfaceKind kind) {
  return kind == SurfaceKind::crypto_object || kind == SurfaceKind::crypto_material;
}
inline bool is_motion(SurfaceKind kind) {
  return kind == SurfaceKind::motion_forward || kind == SurfaceKind::motion_backward;
}
/// Returns whether the kind belongs to the first rough surface after smooth ones.
inline bool is_for_denoising(SurfaceKind kind) { return kind >= SurfaceKind::denoising_normal; }

inline constexpr const char* kAlphaOutput = "alpha";
inline constexpr const char* kCatcherOutput = "catcher";
inline constexpr const char* kDenoisingNormal = "denoisingN";
inline constexpr const char* kDenoisingDepth = "denoisingZ";
inline constexpr const char* kDenoisingAlbedo = "denoisingalbedo";

/// Returns the outputs of a kind. Those of ids do not have the names yet, which only scenes know.
const std::vector<OutputInfo>& outputs_of(SurfaceKind kind);
/// Returns the outputs of all kinds.
const std::vector<OutputInfo>& surface_outputs();
/// Returns the outputs of Film "gbuffer", which are pbrt's.
std::vector<std::string> gbuffer_outputs();
/// Returns the outputs that together are "motion", "cryptoobject" or "cryptomaterial"; none for other names.
std::vector<std::string> parts_of_output(const std::string& name);
/// Returns whether vectors of motion are among them, which need Scene::nearby.
bool has_motion(const std::vector<std::string>& names);

}  // namespace dspm
