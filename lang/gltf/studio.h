// Where a file has no light, or hardly any: a photographer's studio, or the light of a picture.
#pragma once

#include <string>

#include "dspm/lang/gltf/translation.h"
#include "dspm/lang/gltf/view.h"

namespace dspm::gltf {

/// Softboxes and a sky around the subject. A white surface that faces a softbox is about 1 at the strength 1. `sky`:
/// the name of a file with the bytes of sky_picture().
std::string softboxes_around(const Subject& subject, const std::string& sky, double strength);

/// Brighter at and below the horizon, as if a ground went on for ever, than overhead. A PFM.
std::string sky_picture();

/// The light of the picture `hdr`, so strong that a white ground is 1 at the strength 1.
std::string light_of_picture(const std::string& hdr, Backdrop backdrop, double strength);

/// A matte ground under the subject, which fades into whatever is behind. Empty if there is no subject.
std::string ground_for(const Subject& subject);

}  // namespace dspm::gltf
