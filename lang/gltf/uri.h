// The names of files within glTF files.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace dspm::gltf {

/// Returns the bytes of "data:image/png;base64,iVBOR..."; nullopt if the URI is not of that kind. Letter case counts in the data
/// alone.
/// Throws std::runtime_error.
std::optional<std::string> data_of_uri(std::string_view uri);
/// Returns its media type in lower case: "image/png"; nullopt if the URI is not of that kind.
std::optional<std::string> type_of_data_uri(std::string_view uri);

std::string lower_case(std::string_view text);

/// Unescapes a name: "a%20chair.bin" becomes "a chair.bin".
std::string unescaped(std::string_view uri);

}  // namespace dspm::gltf
