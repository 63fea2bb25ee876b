// The kinds of photons.
#pragma once

namespace dspm {

/// Photons by their history before they are stored.
enum PhotonKinds : unsigned {
  kDirectPhotons = 1,   // not scattered: they come straight from the light
  kCausticPhotons = 2,  // scattered only by lobes smoother than least_alpha
  kDiffusePhotons = 4,  // scattered by a rougher lobe at least once
  kAllPhotons = 7,
};

/// Returns the kind that a photon is after it was scattered by a rough lobe or by a smoother one.
constexpr unsigned kind_after(unsigned kind, bool rough) {
  return rough || kind == kDiffusePhotons ? kDiffusePhotons : kCausticPhotons;
}

}  // namespace dspm
