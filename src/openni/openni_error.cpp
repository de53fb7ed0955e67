#include "openni/openni_error.hpp"

#include <OpenNI.h>

namespace credo {

std::string openni_error() {
  std::string text = openni::OpenNI::getExtendedError();
  std::erase_if(text, [](char c) { return c == '\n' || c == '\t' || c == '\r'; });
  return text.empty() ? "OpenNI2 does not say why" : text;
}

}  // namespace credo
