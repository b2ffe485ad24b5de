#include "base/base64.h"

#include <OpenImageIO/strutil.h>

namespace shadowbench {

std::string base64(std::string_view bytes) {
    return OIIO::Strutil::base64_encode(OIIO::string_view(bytes.data(), bytes.size()));
}

} // namespace shadowbench
