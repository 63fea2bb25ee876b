// The names of files within glTF files.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace dspm::gltf {

/// "data:image/png;base64,iVBOR..." as bytes; nullopt if the URI is not of that kind. Throws std::runtime_error.
std::optional<std::string> data_of_uri(std::string_view uri);

/// "a%20chair.bin" is "a chair.bin".
std::string unescaped(std::string_view uri);

}  // namespace dspm::gltf
