#include "dspm/output/denoised.h"

#include <string>

#include "dspm/base/colour/rgb.h"
#include "dspm/image/denoise/joint_filter.h"
#include "dspm/integrators/beside/surface_output_list.h"
#include "dspm/integrators/beside/variance_output.h"
#include "dspm/output/oidn.h"

namespace dspm {

const char* name_of(Denoiser denoiser) { return denoiser == Denoiser::oidn ? "oidn" : "joint filter"; }

Image denoised(Denoiser denoiser, const Image& radiance, const Integrator& integrator, Frame frame,
               const std::filesystem::path& file) {
  const auto finite = [&](const std::string& output) {
    Image image = integrator.estimate(frame, output);
    for (Rgb& pixel : image.pixels)
      if (!is_finite(pixel)) pixel = Rgb();
    return image;
  };
  if (denoiser == Denoiser::oidn)
    return denoised_by_oidn(file, radiance, finite(kDenoisingAlbedo), finite(kDenoisingNormal));
  return joint_filtered(
      {radiance, finite(kVarianceOutput), finite(kDenoisingAlbedo), finite(kDenoisingNormal), finite(kDenoisingDepth)});
}

std::size_t images_while_denoising(Denoiser denoiser) {
  constexpr std::size_t kInputs = 4, kWithoutVarianceAndDepth = 2, kResult = 1;
  return denoiser == Denoiser::oidn ? 2 * (kWithoutVarianceAndDepth + kResult) : kInputs + kImagesOfJointFilter;
}

}  // namespace dspm
