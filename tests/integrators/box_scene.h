// Changes to the text of testing/scenes.h's box.
#pragma once

#include <string>

namespace dspm::test {

inline void replace(std::string& text, const std::string& part, const std::string& by) {
  text.replace(text.find(part), part.size(), by);
}

inline void remove_lamp(std::string& text) {
  const std::size_t begin = text.find("AttributeBegin"),
                    end = text.find("Material \"diffuse\" \"rgb reflectance\" [.7");
  text.erase(begin, end - begin);
}

}  // namespace dspm::test
