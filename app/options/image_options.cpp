#include "dspm/app/options/image_options.h"

#include <string_view>
#include <vector>

#include "dspm/app/options/option_values.h"

namespace dspm {
namespace {

constexpr int kMaxTile = 4096;
constexpr std::string_view kAll = "all";  // that has no precision of its own
constexpr std::string_view kOwn = "own";

void add_precision(CLI::App& app, const char* name, bool half, std::vector<std::string>& outputs, Options& o,
                   const std::string& sentence) {
  app.add_flag(name, sentence)->type_name("[=NAMES]")->each([&o, &outputs, half](const std::string& text) {
    if (text == kAll)
      o.half = half;
    else
      for (std::string& output : parse_names(half ? "--half" : "--float", text)) outputs.push_back(std::move(output));
  });
}

Denoiser denoiser_of(const std::string& name) {
  if (name == kOwn) return Denoiser::own;
  if (name == "oidn") return Denoiser::oidn;
  throw UsageError("--denoise=" + name + ": it is oidn, or nothing for dspm's own filter");
}

}  // namespace

void add_image_options(CLI::App& app, Options& o) {
  app.add_flag("--transparent", o.transparent,
               "images with alpha, without lights infinitely far away behind the scene: EXR, PNG, WebP");
  add_precision(app, "--half{all}", true, o.halves, o, "16-bit EXR (the default), or only these outputs");
  add_precision(app, "--float{all}", false, o.singles, o, "32-bit EXR, or only these outputs");
  app.add_option_function<std::string>(
         "--compression", [&o](const std::string& name) { o.compress(name); },
         "of EXR files: zip (the default), zips, piz, rle, none; with a little loss dwaa, dwab")
      ->type_name("NAME");
  app.add_option("--tiles", o.exr.tile, "EXR files in tiles of N x N pixels; 0: in rows (the default)")
      ->check(CLI::Range(0, kMaxTile).description(""))
      ->type_name("N");
  app.add_option_function<std::vector<std::string>>(
         "--aov",
         [&o](const std::vector<std::string>& texts) {
           for (const std::string& text : texts)
             for (std::string& name : parse_names("--aov", text)) o.outputs.push_back(std::move(name));
         },
         "also write these outputs as layers of the EXR: N,P,Z,albedo,uv,object,material,alpha,motion,cryptoobject,"
         "cryptomaterial,lights,radius,photons")
      ->allow_extra_args(false)
      ->type_name("NAMES");
  app.add_flag("--aov-files", o.aov_files, "them in files of their own: ball.N.0001.exr");
  const std::string denoise = "also write images with less noise, ball.denoised.0001.exr; oidn: by oidnDenoise";
  app.add_flag("--denoise{own}", denoise)->type_name(" [oidn]")->each([&o](const std::string& name) {
    o.denoiser = denoiser_of(name);
  });
}

}  // namespace dspm
