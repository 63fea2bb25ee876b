// Finds out which channels of an OpenEXR file are its picture.
#pragma once

#include <ImfChannelList.h>

#include <string>
#include <vector>

namespace dspm {

/// Returns red, green and blue, or one that is grey, or Y, RY and BY (luminance and chroma). Throws std::runtime_error,
/// naming the channels, if there are several and none of these.
std::vector<std::string> colour_channels(const Imf::ChannelList& channels);

}  // namespace dspm
